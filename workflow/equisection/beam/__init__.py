"""The beam in the flow as it is given, and the section that it is reduced to."""
