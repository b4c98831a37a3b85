"""Torsion of plates with clamped ends, by solids and by what beams leave out."""

import math

import pytest

from equisection.beam.beam import Beam
from equisection.structure.modes import modes_of_kinds
from equisection.structure.warping import restrained_warping, warping_warnings


def plate(aspect_ratio: float, **more) -> Beam:
    return Beam(chord=0.1, length=0.1 * aspect_ratio, thickness=0.002, **more)


def torsion(beam: Beam, method: str) -> float:
    """Return the first frequency of torsion (Hz)."""
    elements = {"solid": (8, 24, 1), "beam": (1, 40, 1)}[method]
    return float(modes_of_kinds(beam, method, elements, (1, 1), 12).torsion(1).frequency[0])


@pytest.mark.parametrize(
    ("aspect_ratio", "more"),
    [
        (1.2, {}),
        (3.7, {}),
        (8.0, {}),
        (3.7, {"poisson_ratio": 0.0}),
    ],
)
def test_solids_are_stiffer_than_beams_by_the_restrained_warping(aspect_ratio, more):
    """Within a twelfth of it: the chord of a short plate bends too, which Vlasov's bar does not."""
    beam = plate(aspect_ratio, **more)
    found = (torsion(beam, "solid") / torsion(beam, "beam")) ** 2 - 1
    assert found == pytest.approx(restrained_warping(beam), rel=1 / 12)


def test_it_fades_with_the_length_and_needs_a_clamped_end():
    slow = 2 * 0.1 / math.sqrt(24 * (1 - plate(200.0).poisson_ratio)) / 20.0  # 2/(lambda L)
    assert restrained_warping(plate(200.0)) == pytest.approx(slow, rel=0.005)
    assert restrained_warping(plate(3.7, boundary="pinned-pinned")) == 0.0
    ends = ("clamped-free", "clamped-clamped")
    one, two = (restrained_warping(plate(8.0, boundary=boundary)) for boundary in ends)
    assert two > 2 * one


@pytest.mark.parametrize(("aspect_ratio", "size"), [(1.2, "61 %"), (3.7, "15 %")])
def test_the_warning_names_size_and_remedy_and_spares_solids(aspect_ratio, size):
    (text,) = warping_warnings(plate(aspect_ratio), "beam")
    for part in ("'beam'", f"about {size} larger", "structure.method: solid"):
        assert part in text
    assert warping_warnings(plate(aspect_ratio), "solid") == ()
    assert warping_warnings(plate(30.0), "beam") == ()
