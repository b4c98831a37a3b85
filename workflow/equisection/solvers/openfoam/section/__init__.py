"""The section on OpenFOAM, rigid and free."""
