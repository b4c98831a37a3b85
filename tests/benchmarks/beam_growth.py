"""Growth of the embedded section and beam beside the kept releases of the flow solver.

python -m tests.benchmarks.beam_growth            prints the growth of every release
python -m tests.benchmarks.beam_growth --write    writes what is known of the errors
"""

import argparse
import csv
import io
import json
import math
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, fields
from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.cases import UnsteadyCase
from equisection.config.groups import Embedded
from equisection.motion.beams import BeamParameters, beam_system, release_beams
from equisection.motion.release_judgement import release_of
from equisection.motion.sections import section_system
from equisection.motion.steady_states import equilibrium, jacobian, least_stable_eigenvalue
from equisection.results.netcdf import read_dataset
from equisection.results.recorded_history import read_reference_history
from equisection.solvers.embedded.known_errors import FILE
from equisection.solvers.known_error import KnownError
from equisection.solvers.verdicts import Judge, TipMotion, first_modes, growths_of_tips
from equisection.store.judged_again import tip_motion
from equisection.verdict.growth import AFTER_RELEASE, MOST_PERIODS, growth_of
from tests.benchmarks.measure import Row, limit
from tests.workflow.project import ROOT

PLATE = "results/reference/paper-plate-openfoam-3d{}/unsteady/3d"
#: k* of the kept releases of the plate, with the run of those of 100 c/V.
K_STAR = {"5": "", "5.5": "", "6.44": "", "8": "", "10": "-long", "12": "-long", "14": "-long"}
#: Sections on the cells of the plate, whose releases tell the lags of that mesh.
ON_ITS_CELLS = ROOT / "results/reference/paper-reductions/unsteady/2d-consistent"
DEFAULT, SAME_CELLS = "plate_2d_11136", "plate_2d_3132"
#: Lags of the plate's cells: ``identify_lags`` on k5 and k10 of ``ON_ITS_CELLS``.
LAGS_OF_CELLS = SeparationLags(2.37, 0.57, 0.72)
STRIPS = cosine_strips(12)


@dataclass(frozen=True)
class Growth:
    """Growth (V/c) of a release: recorded, released with the model, and of the model's eigenvalue.

    It is fitted to pitch and heave together, that of the plate to its first modes, in which the
    second bending mode beats with the pitch. The plate's eigenvalue is that of the least stable
    motion near the pitch. Growth is that of the last periods of a record, as in a run's summary.
    The eigenvalue of a section is compared with ``recorded_small``, that of the eight periods in
    which the motion is smallest: as it grows its loads cease to be linear. The plate's records are
    hardly longer than that.
    ``wanted_frequency`` and ``frequency`` are omega c/V.
    """

    name: str
    recorded: float
    released: float
    eigenvalue: float
    wanted_frequency: float
    frequency: float
    recorded_small: float


def polar(label: str) -> Polar:
    """Return one of the polars of the plate."""
    return Polar.read(ROOT / f"config/polars/{label}.csv")


def kept(k_star: str) -> tuple[xr.Dataset, dict]:
    """Return a release of the plate by the flow solver, and its case."""
    dataset = read_dataset(ROOT / PLATE.format(K_STAR[k_star]) / f"k{k_star}.nc")
    return dataset, json.loads(dataset.attrs["case"])


def beams(cases: Sequence[dict], finite_span: FiniteSpan) -> BeamParameters:
    """Return the modes of some cases that differ in their frequencies."""
    modes = [case["beam"] for case in cases]
    return BeamParameters.from_modes(
        span=np.array(modes[0]["span"]),
        torsion_shapes=np.array(modes[0]["torsion_shape"]),
        torsion_frequencies=np.array([each["torsion_frequency"] for each in modes]),
        inertia=np.array([each["inertia"] for each in modes]),
        bending_shapes=np.array(modes[0]["bending_shape"]),
        bending_frequencies=np.array([each["bending_frequency"] for each in modes]),
        mass=np.array([each["mass"] for each in modes]),
        stations=STRIPS.stations,
        weights=STRIPS.weights,
        finite_span=finite_span,
    )


@cache
def growth_of_plate(label: str) -> tuple[Growth, ...]:
    """Return the growth of the plate at every k* on one of the polars."""
    lags = IDENTIFIED_LAGS if label == DEFAULT else LAGS_OF_CELLS
    loads = UnsteadyLoads.from_polar(polar(label), lags)
    datasets, cases = zip(*(kept(k_star) for k_star in K_STAR), strict=True)
    geometry = cases[0]["geometry"]
    width = geometry["span"] + geometry["tip_gap"]
    channel = SpanGeometry.of(STRIPS, 1.0, geometry["span"], width, geometry["channel_height"])
    parameters = beams(cases, FiniteSpan.of(channel))
    incidence = math.radians(cases[0]["incidence_deg"])
    system = beam_system(parameters, loads, incidence)
    small_motions = np.linalg.eigvals(jacobian(system, *equilibrium(system)))
    run = release_beams(
        parameters, loads, incidence, max(float(data["time"][-1]) for data in datasets)
    )
    found = []
    for lane, (k_star, data) in enumerate(zip(K_STAR, datasets, strict=True)):
        part = slice(0, min(int(run.samples[lane]), np.searchsorted(run.time, data["time"][-1])))
        modes = (run.torsion_amplitudes[part, lane].T, run.bending_amplitudes[part, lane].T)
        tip = TipMotion(
            run.time[part],
            run.tip_twist[part, lane],
            run.tip_deflection[part, lane],
            first_modes(*modes),
        )
        judge = Judge.of(UnsteadyCase.model_validate_json(data.attrs["case"]))
        recorded, released = (growths_of_tips([judge], [one])[0] for one in (tip_motion(data), tip))
        # not the least stable of all: from k* 8 on that is a fast bending mode
        part_of_pitch = np.abs(small_motions[lane].imag) / (math.tau * recorded.frequency)
        near = (part_of_pitch > 0.5) & (part_of_pitch < 1.5)
        found.append(
            Growth(
                k_star,
                recorded.rate,
                released.rate,
                float(small_motions[lane].real[near].max()),
                math.tau * recorded.frequency,
                math.tau * released.frequency,
                recorded.rate,
            )
        )
    return tuple(found)


@cache
def growth_of_sections() -> tuple[Growth, ...]:
    """Return the growth of the sections that the default lags were not fitted to."""
    loads = UnsteadyLoads.from_polar(polar(DEFAULT), IDENTIFIED_LAGS)
    paths = Embedded().identification.judged_on
    return tuple(_growth_of(read_reference_history(ROOT / path), loads) for path in paths)


def _growth_of(history: ReferenceHistory, loads: UnsteadyLoads) -> Growth:
    section, run = history.section, release_of(history, loads)
    part = slice(0, int(run.samples[0]))
    natural = section.uncoupled_frequencies
    motion = np.stack([history.twist, history.deflection])
    recorded = growth_of(history.time, motion, natural)
    released = growth_of(
        run.time[part], np.stack([run.twist[part, 0], run.deflection[part, 0]]), natural
    )
    small = recorded
    if recorded.rate > 0.0:  # its smallest motions are those at the begin
        first = min(AFTER_RELEASE + MOST_PERIODS / natural[0], float(history.time[-1]))
        small = growth_of(history.time, motion, natural, (AFTER_RELEASE, first))
    system = section_system([section], loads, history.incidence_rad)
    return Growth(
        history.name,
        recorded.rate,
        released.rate,
        float(least_stable_eigenvalue(system)[0].real),
        math.tau * recorded.frequency,
        math.tau * released.frequency,
        small.rate,
    )


def errors_of(
    growths: Sequence[Growth], dimension: str, label: str, against: str
) -> Iterator[KnownError]:
    """Sum up the differences, of releases and of eigenvalues."""
    for basis, pairs in (
        ("time", [(growth.released, growth.recorded) for growth in growths]),
        ("eigenvalue", [(growth.eigenvalue, growth.recorded_small) for growth in growths]),
    ):
        found, recorded = np.array(pairs).T
        difference = found - recorded
        wrong = int(np.sum((found > 0.0) != (recorded > 0.0)))
        mean, rms = float(difference.mean()), float(np.sqrt(np.mean(difference**2)))
        yield KnownError(
            dimension, label, basis, against, len(growths), wrong, round(mean, 4), round(rms, 4)
        )


def known() -> list[KnownError]:
    """Return all that is known of the errors."""
    plate = "a plate in CFD (85,284 cells)"
    return [
        *errors_of(growth_of_sections(), "2d", DEFAULT, "its sections in CFD (11,136 cells)"),
        *errors_of(growth_of_plate(DEFAULT), "3d", DEFAULT, plate),
        *errors_of(growth_of_plate(SAME_CELLS), "3d", SAME_CELLS, plate),
    ]


def as_csv(errors: Sequence[KnownError]) -> str:
    """Return the table of the package."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(field.name for field in fields(KnownError))
    writer.writerows(astuple(error) for error in errors)
    return text.getvalue()


def rows() -> Iterator[Row]:
    """Compare the signs of the plate's growth, and the cost of a sweep of the beam."""
    for label in (SAME_CELLS, DEFAULT):
        for growth in growth_of_plate(label):
            right = (growth.released > 0.0) == (growth.recorded > 0.0)
            yield Row(
                f"plate at k* {growth.name} on {label}, growth, CFD {growth.recorded:+.4f}",
                f"{growth.released:+.4f} (eigenvalue {growth.eigenvalue:+.4f}) V/c",
                "same sign" if label == SAME_CELLS else "",
                right if label == SAME_CELLS else None,
            )
    for error in known():
        yield Row(f"{error.dimension} on {error.polar}, {error.basis}", str(error))
    yield limit("processor time of 14 k* of the beam, 100 c/V", _cost_of_a_sweep(), 1.1, "s")


def _cost_of_a_sweep() -> float:
    _, case = kept("8")
    frequency = math.sqrt(1.0 / 8.0)
    modes = [
        {
            **case["beam"],
            "torsion_frequency": np.array(case["beam"]["torsion_frequency"]) * frequency * root,
            "bending_frequency": np.array(case["beam"]["bending_frequency"]) * frequency * root,
        }
        for root in np.sqrt(np.linspace(4.0, 21.0, 14))
    ]
    channel = SpanGeometry.of(STRIPS, 1.0, 3.7, 4.0, 4.0)
    parameters = beams([{"beam": each} for each in modes], FiniteSpan.of(channel))
    loads = UnsteadyLoads.from_polar(polar(DEFAULT))
    start = time.process_time()
    release_beams(parameters, loads, math.radians(2.5), 100.0)
    return time.process_time() - start


def main(write: bool) -> None:
    """Print every growth, and write the table of known errors if asked for."""
    print("sections: growth in CFD, where it is smallest, released, eigenvalue")
    for growth in growth_of_sections():
        print(
            f"| {growth.name} | {growth.recorded:+.4f} | {growth.recorded_small:+.4f} "
            f"| {growth.released:+.4f} | {growth.eigenvalue:+.4f} |"
        )
    for label in (SAME_CELLS, DEFAULT):
        print(f"plate, {label}: k*, growth in CFD, released, eigenvalue, frequency in CFD, here")
        for growth in growth_of_plate(label):
            print(
                f"| {growth.name} | {growth.recorded:+.4f} | {growth.released:+.4f} "
                f"| {growth.eigenvalue:+.4f} | {growth.wanted_frequency:.3f} "
                f"| {growth.frequency:.3f} |"
            )
    text = as_csv(known())
    sys.stdout.write(text)
    if write:
        Path(FILE).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.beam_growth")
    parser.add_argument("--write", action="store_true", help=f"write {FILE.name}")
    main(parser.parse_args().write)
