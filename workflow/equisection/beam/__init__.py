"""The object in the flow as it is given: the beam, and the section that stands for it."""
