"""OpenFOAM as a solver of this workflow: the rigid and the free section in a channel.

Everything is computed without dimensions: chord, speed and density are 1, so that time is the
convective time and the Reynolds number is the only parameter of the flow.
"""
