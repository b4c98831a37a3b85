"""Equivalent properties and correction factors (Fig. 1): the beam as one section."""
