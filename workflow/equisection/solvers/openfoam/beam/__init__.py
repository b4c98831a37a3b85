"""The beam on OpenFOAM, rigid and free."""
