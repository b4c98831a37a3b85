"""Onset of corrected sections from that of the section and the difference of both."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from equisection.paper.mesh_convergence.kept_releases import OWN_RATIOS
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_difference import (
    BY_DIFFERENCE,
    onsets_by_difference,
)
from equisection.paper.mesh_convergence.onset_by_mesh import BY_MODEL, BY_RELEASES, ONSET
from equisection.paper.mesh_convergence.onset_from_equilibrium import BY_EQUILIBRIUM

CELLS = {"coarse": 10_000, "medium": 20_000, "fine": 40_000, "extra-fine": 80_000}


def onset(model: str, basis: str, values: Sequence[float], half: float = 0.1) -> MeshSeries:
    """Return onsets on the coarsest meshes, with intervals."""
    meshes = zip(CELLS.items(), values, strict=False)
    found = tuple(MeshValue(*mesh, value, value - half, value + half) for mesh, value in meshes)
    return MeshSeries(ONSET, model, "", basis, 2, found, common_error=basis == BY_MODEL)


SECTION = onset("2d", BY_EQUILIBRIUM, [8.4, 7.4, 6.9, 6.65], 0.02)
LEARNT_SECTION = onset("2d", BY_MODEL, [8.2, 7.2, 6.7])


def by_difference(
    releases: float, learnt: Sequence[float], half: float = 0.1, model: str = OWN_RATIOS
) -> MeshSeries:
    (found,) = onsets_by_difference(
        [
            SECTION,
            onset("2d", BY_RELEASES, [8.4, 7.4], 0.02),
            LEARNT_SECTION,
            onset(model, BY_RELEASES, [releases], half),
            onset(model, BY_MODEL, learnt, 0.4),
        ]
    )
    assert (found.model, found.basis) == (model, BY_DIFFERENCE)
    return found


@pytest.mark.parametrize("model", ["2d-corrected", OWN_RATIOS])
def test_a_difference_that_no_mesh_changes_moves_the_series_and_its_limit(model: str) -> None:
    """Equal differences have the error of the releases alone, none of the model."""
    found = by_difference(7.9, [7.7, 6.7, 6.2], model=model)
    assert [v.value for v in found.values] == pytest.approx([7.9, 6.9, 6.4, 6.15])
    assert found.limit.value == pytest.approx(SECTION.limit.value - 0.5)
    error = math.hypot(0.1, 0.02)
    assert found.limit.half_width == pytest.approx(math.hypot(SECTION.limit.half_width, error))
    assert found.values[0].half_width == pytest.approx(0.1)  # its own, of the releases
    assert (found.limit.order, found.limit.meshes) == (SECTION.limit.order, 3)


def test_the_change_of_the_difference_is_learnt_and_as_uncertain_as_large() -> None:
    found = by_difference(7.9, [7.7, 6.6, 6.0])  # -0.5, -0.6, -0.7
    assert [v.value for v in found.values] == pytest.approx([7.9, 6.8, 6.2, 5.95])
    halves = [v.half_width for v in found.values]
    error = 0.1**2 + 0.02**2
    assert halves[1:] == pytest.approx(
        [math.sqrt(0.02**2 + error + change**2) for change in (0.1, 0.2, 0.2)]
    )
    width = math.sqrt(SECTION.limit.half_width**2 + error + 0.2**2)
    assert found.limit.half_width == pytest.approx(width)


def test_of_several_meshes_with_releases_the_finest_has_the_difference() -> None:
    """The change up to it is no longer learnt, nor is its error that of the model."""
    learnt = onset(OWN_RATIOS, BY_MODEL, [7.7, 6.5, 6.0])  # from 2d: -0.5, -0.7, -0.7
    of_2d = [SECTION, LEARNT_SECTION]
    finer = onset(OWN_RATIOS, BY_EQUILIBRIUM, [7.9, 6.7], 0.05)
    coarse = onset(OWN_RATIOS, BY_RELEASES, [7.9], 0.05)
    (found,) = onsets_by_difference([*of_2d, coarse, finer, learnt])
    (by_coarse,) = onsets_by_difference([*of_2d, coarse, learnt])
    assert [v.value for v in found.values] == pytest.approx([7.9, 6.7, 6.2, 5.95])
    assert [v.half_width for v in found.values[:2]] == pytest.approx([0.05, 0.05])
    error = math.hypot(0.05, 0.02)
    assert found.limit.half_width == pytest.approx(math.hypot(SECTION.limit.half_width, error))
    wider = math.hypot(found.limit.half_width, 0.2)  # the learnt change from coarse on
    assert by_coarse.limit.half_width == pytest.approx(wider)


def test_a_model_that_misses_the_releases_difference_is_as_uncertain() -> None:
    hits, misses = (by_difference(one, [7.7, 6.7, 6.2]) for one in (7.9, 7.6))
    assert misses.limit.value == pytest.approx(hits.limit.value - 0.3)
    wider = math.hypot(hits.limit.half_width, 0.3)
    assert misses.limit.half_width == pytest.approx(wider)


def test_without_releases_or_models_of_both_nothing_is_told() -> None:
    corrected = [onset(OWN_RATIOS, BY_RELEASES, [7.9]), onset(OWN_RATIOS, BY_MODEL, [7.7, 6.7])]
    assert not list(onsets_by_difference([SECTION, *corrected]))
    assert not list(onsets_by_difference([LEARNT_SECTION, *corrected]))
    assert not list(onsets_by_difference([SECTION, LEARNT_SECTION, corrected[0]]))
    one_mesh = onset("2d", BY_RELEASES, [8.4])
    assert not list(onsets_by_difference([one_mesh, LEARNT_SECTION, *corrected]))
