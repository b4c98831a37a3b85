"""A steady and an unsteady case to start from."""

from equisection.cases import (
    Criteria,
    Geometry,
    Medium,
    SectionProperties,
    SolverBlock,
    SteadyCase,
    UnsteadyCase,
)

GEOMETRY = Geometry(
    chord=0.1,
    span=3.7,
    thickness=0.04,
    root_on_wall=True,
    channel_height=4.0,
    tip_gap=0.3,
    upstream=5.0,
    downstream=15.0,
)
MEDIUM = Medium(speed=20.0, density=1.18, dynamic_viscosity=1.86e-5)
SOLVER = SolverBlock(name="embedded", version="1", settings={"strips": 8, "polar": [0.0, 0.5]})
STEADY = SteadyCase(
    dimension="2d",
    incidence_deg=2.5,
    resolution="coarse",
    geometry=GEOMETRY,
    medium=MEDIUM,
    solver=SOLVER,
)
UNSTEADY = UnsteadyCase(
    dimension="2d",
    k_star=6.44,
    incidence_deg=2.5,
    resolution="coarse",
    geometry=GEOMETRY,
    medium=MEDIUM,
    section=SectionProperties(
        torsional_stiffness=6.44,
        flexural_stiffness=0.9,
        inertia=6.7,
        mass=80.0,
        twist_recovery=0.6,
        deflection_recovery=0.4,
    ),
    duration=400.0,
    time_step=0.05,
    output_interval=0.1,
    criteria=Criteria(
        settled_amplitude_deg=0.05, growing_amplitude_deg=6.0, steadiness=0.02, periods=5
    ),
    solver=SOLVER,
)
