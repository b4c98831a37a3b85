"""One section released in a flow, with the verdict on its motion, without a configuration."""

from __future__ import annotations

import math

import xarray as xr

from equisection.aerodynamics.polar import Polar, require_polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.config.groups import Unsteady
from equisection.config.groups.unsteady import MOST_STEPS
from equisection.conventions import STANDARD_AIR
from equisection.errors import ArgumentError
from equisection.keys.arguments import is_finite_number, require_positive
from equisection.solvers.embedded.releases import ReleaseSettings, release_judged
from equisection.solvers.verdicts import WITHOUT_EQUILIBRIUM, Judge
from equisection.verdict import Criteria

#: As the configuration has them.
_DEFAULTS = Unsteady()
#: Fewest time steps in a natural period of the pitch.
STEPS_A_PERIOD = 40
#: Time steps in an interval of the history.
STEPS_A_SAMPLE = 2
#: Fewest intervals of a history.
FEWEST_SAMPLES = 10


def release(
    section: Section,
    polar: Polar,
    *,
    incidence_deg: float,
    speed: float,
    density: float = STANDARD_AIR,
    lags: SeparationLags = IDENTIFIED_LAGS,
    duration: float = _DEFAULTS.duration,
    start_twist_deg: float = 0.0,
    start_heave_rate: float = 0.0,
    from_equilibrium: bool = False,
) -> xr.Dataset:
    """Motion of a section after its release in the steady flow around it.

    It starts at rest and untwisted, unless a start says otherwise. A symmetric section at 0 deg
    needs one: nothing else sets it in motion.

    The run ends when the verdict on it is in. Time step and criteria are those that the
    configuration has by default; of a pitch with fewer than 40 steps in a period the step is
    shorter.

    Parameters
    ----------
    section
        The section (SI).
    polar
        Steady coefficients of the section.
    incidence_deg
        Rigid incidence theta_0 (deg).
    speed
        Speed V (m/s).
    density
        Density of the fluid rho (kg/m^3); by default that of air at sea level.
    lags
        Lags of the separation bubble (:func:`equisection.motion.stability.stability`).
    duration
        The longest that the run may take (c/V).
    start_twist_deg
        Twist (deg) of the tip in which the section is held until the flow is steady.
    start_heave_rate
        Rate of the deflection (over V) of the tip at the release, up.
    from_equilibrium
        Start from the static equilibrium in the flow, which one of the two above has to disturb.
        Where the branch from rest has none the section is released undeformed, and ``reason`` says
        so.

    Returns
    -------
    xarray.Dataset
        Over ``time`` (s) and ``convective_time`` (c/V): ``twist`` (rad) and ``deflection`` (m) of
        the section, ``tip_twist`` (rad) and ``tip_deflection`` (m) of its beam, ``cl``, ``cm``,
        ``incidence`` (rad). The verdict is in the attributes:
        ``regime`` (`settled`, `decaying`, `limit-cycle`, `growing`, `undecided`, `failed`),
        ``reason`` and its numbers.

    Raises
    ------
    ArgumentError
        An argument is not a number that makes sense.
    IncidenceOutOfRangeError
        The polar does not cover the rigid incidence, or that of the start.
    """
    for name, value, units in (
        ("speed", speed, "m/s"),
        ("density", density, "kg/m3"),
        ("duration", duration, "c/V"),
    ):
        require_positive(name, value, units)
    for name, value, most, units in (
        ("incidence_deg", incidence_deg, 180.0, "deg"),
        ("start_twist_deg", start_twist_deg, 90.0, "deg"),
        ("start_heave_rate", start_heave_rate, 1.0, "over V"),
    ):
        if not (is_finite_number(value) and abs(value) <= most):
            raise ArgumentError(
                f"{name} is {value!r}; wanted a number ({units}) from {-most:g} to {most:g}"
            )
    if from_equilibrium and not (start_twist_deg or start_heave_rate):
        raise ArgumentError(
            "from_equilibrium is True; wanted start_twist_deg, such as 0.2, or start_heave_rate "
            "with it: nothing else sets the section in motion"
        )
    require_polar(polar)
    rigid = math.radians(incidence_deg)
    polar.require([rigid, rigid + math.radians(start_twist_deg) * section.twist_recovery])
    flowing = section.in_flow(density, speed)
    judge = Judge.of_section(flowing, Criteria(**_DEFAULTS.verdict.model_dump()))
    step = min(_DEFAULTS.time_step, 1.0 / (STEPS_A_PERIOD * judge.natural_frequency))
    interval = STEPS_A_SAMPLE * step
    if duration < FEWEST_SAMPLES * interval:
        raise ArgumentError(
            f"duration is {duration:g}; wanted {FEWEST_SAMPLES * interval:.3g} c/V or more, ten "
            "samples of the history"
        )
    if duration > MOST_STEPS * step:
        raise ArgumentError(
            f"duration is {duration:g}; wanted up to {MOST_STEPS * step:.3g} c/V, "
            f"{MOST_STEPS:,} time steps of {step:.3g} c/V, which follow the natural motion of the "
            "section at this speed"
        )
    settings = ReleaseSettings(
        incidence_rad=rigid,
        tip_twist=math.radians(start_twist_deg),
        tip_heave_rate=start_heave_rate,
        duration=duration,
        time_step=step,
        output_interval=interval,
    )
    loads = UnsteadyLoads.from_polar(polar, lags)
    result = release_judged([flowing], [judge], loads, settings, from_equilibrium=from_equilibrium)[
        0
    ]
    is_rigid = not from_equilibrium or WITHOUT_EQUILIBRIUM in str(result.verdict["reason"])
    dataset = result.to_dataset(section.chord)
    convective = dataset["time"].variable
    seconds = convective.values * section.chord / speed
    return dataset.assign_coords(
        time=("time", seconds, {"units": "s", "long_name": "time from the release t"}),
        convective_time=convective,
    ).assign_attrs(
        incidence_deg=incidence_deg,
        start_twist_deg=start_twist_deg,
        start_heave_rate=start_heave_rate,
        start_state="rigid" if is_rigid else "equilibrium",
        speed=speed,
        density=density,
        k_star=section.k_star(density, speed),
        time_step=step,
        polar=polar.label,
        lags=lags.provenance,
    )
