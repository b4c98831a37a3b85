"""Every figure draws from good and from poor data, says what made it, and saves reproducibly."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patches import Polygon
from matplotlib.text import Text
from tests.conftest import ROOT
from tests.sample_cases import PAPER

import equisection
from equisection.analysis.bubble import bubble_table
from equisection.analysis.deviations import deviations
from equisection.analysis.grid_study import grid_study
from equisection.analysis.summary import summarise
from equisection.config import load_config
from equisection.figures import (
    courant_number,
    critical_speed,
    flow_at_tip,
    growth_rate,
    hysteresis,
    lift_correction,
    mesh_of_beam,
    mesh_of_section,
    modal_contributions,
    mode_shapes,
    moment_correction,
    response,
    section_and_beam,
    section_polar,
    spanwise_loads,
    surface_loads,
    surface_of_beam,
)
from equisection.figures.drawn_history import extent_from_dataset, history_from_dataset
from equisection.figures.incidences import nearest_incidences
from equisection.figures.load_correction import SteadyData
from equisection.figures.models import LOOKS
from equisection.figures.other_axis import add_other_axis, as_given
from equisection.figures.references import read_references
from equisection.figures.save import FigureFormatError, save_figure
from equisection.figures.style import drawing_style
from equisection.results.modes_dataset import modes_to_dataset
from equisection.results.netcdf import write_dataset
from equisection.results.plate_grid import PlateGrid
from equisection.results.plate_surface import PlateSurface
from equisection.results.polar_dataset import gather_polar
from equisection.results.section_mesh import SectionMesh, no_mesh
from equisection.results.steady_result import SteadyResult
from equisection.results.surface import SectionSurface
from equisection.results.tip_flow import TipFlow
from equisection.results.unsteady_result import UnsteadyResult
from equisection.structure.modes import compute_modes
from equisection.study.axes import INCIDENCE, K_STAR, SPEED, AsGiven

STYLE = ROOT / "envs" / "equisection.mplstyle"
EXAMPLES = sorted((ROOT / "config" / "examples").glob("*.yaml"))
SOLVER = "made-up solver, 5 cells"

NOTHING = read_references([], "bubble")

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture(autouse=True)
def _style():
    with drawing_style(STYLE):
        yield


def words(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(Text))


def stated(at: float, value: float, label: str) -> pd.DataFrame:
    return pd.DataFrame({"quantity": ["some"], "at": [at], "value": [value], "label": [label]})


def lay_out(figure: Figure) -> None:
    """Do all of a drawing but the pixels; a layout that finds no room is a warning."""
    figure.draw_without_rendering()


def polar_data(resolutions=("coarse",), missing=()) -> xr.Dataset:
    incidence = np.linspace(0.0, 10.0, 6)
    lift = np.tile(np.sin(np.radians(5 * incidence)), (len(resolutions), 1))
    lift[:, list(missing)] = np.nan
    over = ("resolution", "incidence_deg")
    return xr.Dataset(
        {
            "cl": (over, lift),
            "cm": (over, 0.1 * lift),
            "cd": (over, 0.1 + 0 * lift),
            "is_run": (over, np.ones(lift.shape, dtype=np.int8)),
        },
        {"resolution": list(resolutions), "incidence_deg": incidence},
        attrs={f"solver_{name}": SOLVER for name in resolutions},
    )


def beam_polar(missing=()) -> xr.Dataset:
    polar = polar_data(missing=missing)
    span = np.linspace(0.05, 0.95, 8)
    for name in ("cl", "cm"):
        polar[f"{name}_section"] = polar[name] * xr.DataArray(1 - span**4, {"span": span})
    return polar


def correction(value=1.2) -> xr.Dataset:
    incidence = np.linspace(0.0, 10.0, 6)
    factor = ("incidence_deg", np.full(6, value))
    return xr.Dataset(
        {"lift_factor": factor, "moment_factor": factor}, {"incidence_deg": incidence}
    )


def section_mesh() -> xr.Dataset:
    """Return squares of 1/2 c around mid-chord, the flow faster in those to the right."""
    across = np.arange(-2, 3) / 2
    points = np.stack(np.meshgrid(across, across), axis=-1).reshape(-1, 2)
    first = np.array([5 * row + column for row in range(4) for column in range(4)])
    corners = first[:, None] + np.array([0, 1, 6, 5])
    quality = {
        "max_aspect_ratio": 1.0,
        "max_non_orthogonality_deg": 0.0,
        "mean_non_orthogonality_deg": 0.0,
        "max_skewness": 0.0,
    }
    mesh = SectionMesh(
        points, corners, 2.5, quality, courant=1.0 + first % 5, time_step=0.02, flow="made up"
    )
    return mesh.to_dataset().assign_attrs(solver_description=SOLVER, resolution="coarse")


def plate_mesh() -> xr.Dataset:
    """Return the section's squares over four layers, the plate in the middle two."""
    mesh = section_mesh()
    points = np.stack([mesh["x"].values, mesh["y"].values], axis=-1)
    quality = {name: mesh.attrs[name] for name in mesh.attrs if name.startswith(("max", "mean"))}
    levels = np.array([0.0, 1.0, 1.8, 2.0, 2.3])
    corners = mesh["corners"].values
    corners = corners[np.abs(points[corners].mean(axis=1)).max(axis=1) > 0.5]  # none in the plate
    grid = PlateGrid(
        points, corners, 0.0, quality, levels=levels, span=2.0, thickness=1.0, cells=64
    )
    return grid.to_dataset().assign_attrs(solver_description=SOLVER, resolution="coarse")


def plate_surface(reattachment=0.5) -> PlateSurface:
    """Return two sides of 10 x 6 faces, c_p falling to the tip, the friction that of a bubble."""
    x, z, side = (
        part.ravel()
        for part in np.meshgrid(
            np.arange(10) / 10 + 0.05, np.arange(6) / 3 + 1 / 6, ["lower", "upper"]
        )
    )
    order = np.lexsort((x, z, side))
    x, z, side, one = x[order], z[order], side[order], np.ones(120)
    y, friction = np.where(side == "upper", 0.02, -0.02), 1e-3 * (x - reattachment)
    return PlateSurface(x, y, z, one / 30, side, -0.1 * z, friction, 1e-4 * z, one)


def on_plate(**reattachments) -> dict[float, surface_of_beam.ShownSurface]:
    return {
        float(name.removeprefix("at")): surface_of_beam.ShownSurface(plate_surface(end), "mean")
        for name, end in reattachments.items()
    }


def tip_result(kind="steady", flow=True) -> xr.Dataset:
    """Return a result with a flow near the tip that turns about a line along the stream."""
    y, z = np.linspace(-0.4, 0.6, 20), np.linspace(3.1, 4.0, 18)
    up, out = np.meshgrid(y, z - 3.7, indexing="ij")
    velocity = np.stack([np.ones_like(up), out, -up], axis=-1)[None].repeat(2, axis=0)
    velocity[0, np.abs(y) < 0.02, :12] = np.nan
    line = np.full((2, 18), np.nan)
    line[0, :12] = 0.0
    near = TipFlow(
        np.array([0.0, 1.0]), y, z, velocity, velocity[..., 1] ** 2, line, 3.7, 0.04, "9 c/V"
    )
    near = near if flow else None
    if kind == "steady":
        made = SteadyResult(0.1, 0.2, 0.3, *[np.empty(0)] * 3, "steady", tip_flow=near).to_dataset()
    else:
        verdict = {"regime": kind, "reason": "it tangled"}
        made = UnsteadyResult(*[np.empty(0)] * 8, verdict, tip_flow=near).to_dataset(0.1)
    return made.assign_attrs(solver_description=SOLVER, resolution="coarse")


def surface(reattachment=0.5) -> SectionSurface:
    """Return a surface of ten faces a side, whose flow is reversed up to a place."""
    x = np.tile(np.linspace(0.05, 0.95, 10), 2)
    side = np.array(["lower"] * 10 + ["upper"] * 10)
    y, one = np.where(side == "upper", 0.02, -0.02), np.ones(20)
    return SectionSurface(x, y, 0.1 * one, side, -y, 1e-3 * (x - reattachment), one - x)


def bubbles(known: dict[tuple[str, float], float], without=()) -> pd.DataFrame:
    """Return ``tables/bubble.csv`` of bubbles by resolution and incidence."""
    results = {}
    for (resolution, angle), length in known.items():
        method = "mean of unsteady over 40 c/V" if angle > 5 else "steady, 9 iterations"
        made = SteadyResult(
            0.1, 0.2, 0.3, *[np.empty(0)] * 3, method,
            surface=None if angle in without else surface(length),
        )  # fmt: skip
        results[resolution, angle] = made.to_dataset().assign_attrs(
            solver_description=SOLVER, case_hash="4f" * 32
        )
    return bubble_table(results)


def modes(count=4) -> xr.Dataset:
    beam = mode_shapes.analytic_shapes(PAPER)
    return xr.Dataset(
        {
            "shape": (("mode", "span"), np.vstack([beam.bending[:count], beam.torsion[:count]])),
            "kind": ("mode", ["bending"] * count + ["torsion"] * count),
        },
        {"span": beam.span},
        attrs={"method": "analytic", "elements": "none"},
    )


def run(k_star=8.0, regime="settled", dimension="2d") -> xr.Dataset:
    """Return a result as a solver leaves it."""
    time = np.linspace(0.0, 40.0, 401)
    wave = 0.01 + 0.004 * np.sin(time) * np.exp({"growing": 0.02}.get(regime, 0.0) * time)
    amplitudes = np.outer([1.0, -0.02, 1e-3, 0.0], wave)
    beam = {"torsion_amplitudes": amplitudes, "bending_amplitudes": amplitudes}
    verdict = {"regime": regime, "reason": "made up", "window_start": 20.0}
    result = UnsteadyResult(
        time, wave, wave, wave, wave, 0.4 + wave, wave, wave, verdict,
        **(beam if dimension == "3d" else {}),
    )  # fmt: skip
    if regime in ("failed", "diverged"):
        nothing = np.empty(0)
        verdict = {"regime": regime, "reason": "it diverges", "window_start": math.nan}
        result = UnsteadyResult(*[nothing] * 8, verdict)
    return result.to_dataset(0.1).assign_attrs(
        k_star=k_star, solver_description=SOLVER, resolution="coarse"
    )


def sweep(folder: Path, runs: dict[str, dict[float, str]]):
    """Write results, and return them with their summary and onset."""
    rows, brackets, paths = [], [], []
    for model, regimes in runs.items():
        for k_star, regime in regimes.items():
            path = folder / model / f"k{k_star:g}.nc"
            write_dataset(path, run(k_star, regime, model[:2]))
            paths.append(path)
            mean = math.nan if regime in ("failed", "diverged") else 5.0 / k_star
            told = regime.replace("diverged", "growing")
            known = int(regime in ("settled", "limit-cycle"))
            rows.append((model, k_star, told, mean, mean, "made-up", "coarse", known))
        stable = [k for k, regime in regimes.items() if regime in ("settled", "limit-cycle")]
        growing = [k for k, regime in regimes.items() if regime in ("growing", "diverged")]
        brackets.append((model, min(stable, default=math.nan), max(growing, default=math.nan)))
    columns = "model k_star regime mean_twist_deg mean_deflection_chords solver resolution"
    summary = pd.DataFrame(rows, columns=[*columns.split(), "mean_known"])
    summary = summary.assign(frequency_strouhal=0.15, growth_rate=0.0)
    onset = pd.DataFrame(brackets, columns=["model", "k_star_stable", "k_star_unstable"])
    return summary, onset, paths


WHOLE = {4.0: "growing", 5.0: "limit-cycle", 6.0: "failed", 8.0: "settled"}
SWEEPS = {
    "all models": {"2d": WHOLE, "2d-corrected": WHOLE, "3d": WHOLE},
    "no beam": {"2d": WHOLE},
    "no section": {"3d": WHOLE},
    "one k*": {"2d-corrected": {21.0: "settled"}, "3d": {21.0: "growing"}},
    "all failed": {"2d": {4.0: "failed", 5.0: "failed"}, "3d": {4.0: "failed"}},
    "diverged": {"2d": {4.0: "diverged", 5.0: "settled", 8.0: "settled"}},
    "all stable": {"2d-corrected": {4.0: "settled", 5.0: "settled"}},
}


def figures_of_data():
    whole = SteadyData(polar_data(), beam_polar(), correction(), "coarse")
    return {
        "section-polar": lambda: section_polar.draw(polar_data(("coarse", "fine", "finest"))),
        "mesh-of-section": lambda: mesh_of_section.draw(section_mesh()),
        "surface-loads": lambda: surface_loads.draw(
            {1.0: surface(0.4), 10.0: surface(2.0)},
            bubbles({("coarse", 1.0): 0.4, ("coarse", 10.0): 2.0, ("fine", 1.0): 0.5}),
            "coarse",
            stated(1.0, 0.5, "stated elsewhere"),
        ),
        "courant-number": lambda: courant_number.draw(section_mesh()),
        "mesh-of-beam": lambda: mesh_of_beam.draw(plate_mesh(), "solid", (4, 8, 1)),
        "surface-of-beam": lambda: surface_of_beam.draw(on_plate(at2=0.3, at10=2.0), [], SOLVER),
        "flow-at-tip": lambda: flow_at_tip.draw(
            [
                flow_at_tip.column_of("rigid", tip_result()),
                flow_at_tip.column_of("flexible", tip_result("settled")),
            ]
        ),
        "spanwise-loads": lambda: spanwise_loads.draw(beam_polar(), "coarse"),
        "lift-correction": lambda: lift_correction.draw(whole),
        "moment-correction": lambda: moment_correction.draw(whole),
        "modal-contributions": lambda: modal_contributions.draw(modes(), run(dimension="3d")),
    }


@pytest.mark.parametrize("name", sorted(figures_of_data()))
def test_says_solver_and_version(name):
    figure = figures_of_data()[name]()
    found = words(figure).replace("\n", " ")
    assert SOLVER in found
    assert f"equisection {equisection.__version__}" in found
    lay_out(figure)


def test_modes_have_no_flow_solver():
    figure = mode_shapes.draw(modes(), mode_shapes.analytic_shapes(PAPER))
    assert "no flow solver" in words(figure)
    lay_out(figure)


@pytest.mark.parametrize("count", [0, 2])
def test_modes_may_be_few(count):
    figure = mode_shapes.draw(modes(count), mode_shapes.analytic_shapes(PAPER))
    assert ("No bending mode was computed." in words(figure)) == (count == 0)
    lay_out(figure)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_modes_of_every_example_are_drawn(example, tmp_path):
    """Whatever holds the beam: free ends, supports and lumped masses along the span."""
    config = load_config(yaml.safe_load(example.read_text(encoding="utf-8")))
    beam = config.beam
    found = compute_modes(beam, "beam", (24, 20, 2), 6)
    write_dataset(tmp_path / "modes.nc", modes_to_dataset(found, [0.0] * 6))
    figure = mode_shapes.from_files(tmp_path / "modes.nc", beam.model_dump())
    assert ("analytic beam" in words(figure)) != beam.has_fittings
    lay_out(figure)


def test_a_long_description_is_wrapped_within_the_page():
    polar = beam_polar()
    polar.attrs["solver_coarse"] = "OpenFOAM v2406 overPimpleDyMFoam kOmegaSST " * 8
    figure = spanwise_loads.draw(polar, "coarse")
    lines = figure.get_supxlabel().split("\n")
    assert 1 < len(lines) < 8
    assert max(map(len, lines)) < 150


def test_polars_may_miss_points():
    figure = section_polar.draw(polar_data(missing=(2,)))
    assert "1 of 6 cases have no result" in words(figure).replace("\n", " ")
    lay_out(figure)


def test_polars_join_the_incidences_that_a_resolution_is_run_at():
    polar = polar_data(("coarse", "fine"))
    for name in ("cl", "cm", "is_run"):
        polar[name] = polar[name].where(
            (polar["resolution"] == "coarse") | polar["incidence_deg"].isin([0.0, 10.0]), 0
        )
    coarse, fine = section_polar.draw(polar).axes[0].get_lines()[:2]
    assert len(coarse.get_xdata()) == 6
    assert list(fine.get_xdata()) == [0.0, 10.0]
    # two points of six would cut the bend of the others
    assert (coarse.get_linestyle(), fine.get_linestyle()) == ("-", "None")
    assert "no result" not in words(section_polar.draw(polar))


@pytest.mark.parametrize(
    ("values", "said"),
    [((1.16, 1.04, 1.01), "monotonic"), ((1.1, 1.0, 1.02), "oscillatory")],
)
def test_polars_of_a_grid_study_show_its_index(values, said):
    polar = polar_data(("coarse", "medium", "fine"))
    for name in ("cl", "cm"):
        polar[name] = polar[name] * xr.DataArray(list(values), dims="resolution")
    study = grid_study(polar, {"coarse": 100, "medium": 400, "fine": 1600})
    figure = section_polar.draw(polar, study)
    assert said in words(figure)
    assert "2.0" in words(figure) or said == "oscillatory"
    lay_out(figure)


def test_index_of_an_order_that_is_chance_is_not_drawn():
    polar = polar_data(("coarse", "medium", "fine"))
    for name in ("cl", "cm"):
        polar[name] = polar[name] * xr.DataArray([1.1, 1.00001, 1.0], dims="resolution")
    study = grid_study(polar, {"coarse": 100, "medium": 400, "fine": 1600})
    assert study["observed_order"].max() > 10.0
    assert "has an observed order" in words(section_polar.draw(polar, study)).replace("\n", " ")


def test_polars_of_a_grid_study_without_an_order_say_so():
    polar = polar_data(("coarse", "medium", "fine"))
    study = grid_study(polar, {"coarse": 100, "medium": 400, "fine": 1600})
    figure = section_polar.draw(polar, study)
    assert "has an observed order" in words(figure).replace("\n", " ")
    lay_out(figure)


def test_surface_shows_the_bubble_of_every_resolution_beside_the_papers():
    figure = figures_of_data()["surface-loads"]()
    lines = {str(line.get_label()): line for line in figure.axes[3].get_lines()}
    np.testing.assert_allclose(lines["coarse"].get_ydata(), [0.4, 1.0])
    np.testing.assert_allclose(lines["fine"].get_ydata(), [0.5])
    assert list(lines["stated elsewhere"].get_xdata()) == [1.0]
    assert "10 deg, mean of unsteady" in words(figure)
    assert "1 deg, mean" not in words(figure)


@pytest.mark.parametrize("without", [(1.0,), (1.0, 5.0)])
def test_surface_says_which_results_have_no_data(without):
    table = bubbles({("coarse", 1.0): 0.4, ("coarse", 5.0): 1.0}, without)
    shown = {angle: surface() for angle in (5.0,) if angle not in without}
    figure = surface_loads.draw(shown, table, "coarse", NOTHING)
    found = words(figure).replace("\n", " ")
    assert f"{len(without)} of 2 cases have no surface data" in found
    assert ("No result has surface data." in found) == (len(without) == 2)
    lay_out(figure)


@pytest.mark.parametrize(
    ("available", "shown"),
    [([0.0, 1.0, 2.5, 5.0, 10.0], [1.0, 2.5, 5.0, 10.0]), ([0.0, 2.0], []), ([0.0, 2.5], [2.5])],
)
def test_incidences_of_the_surface_shown(available, shown):
    assert surface_loads.incidences_shown(available, 2.5) == shown


def test_courant_number_says_how_much_of_the_area_is_below_the_limit():
    figure = courant_number.draw(section_mesh(), 1.5)
    assert "25.0 % of the area below 1.5" in words(figure)
    assert "mean 2.5" in words(figure)


def test_mesh_of_the_plate_has_a_line_for_each_element_and_layer():
    figure = mesh_of_beam.draw(plate_mesh(), "solid", (4, 8, 1))
    counts = [len(axes.collections[0].get_segments()) for axes in figure.axes[:2]]
    # elements and one, along and across; layers and one, points on the plate's upper side
    assert counts == [8 + 1 + 4 + 1, 5 + 3]
    assert "4 x 8 x 1 quadratic hexahedra" in words(figure).replace("\n", " ")


@pytest.mark.parametrize(
    ("method", "said"), [("beam", "8 beam elements"), ("analytic", "the solid has no mesh")]
)
def test_mesh_of_a_plate_whose_solid_has_none(method, said):
    figure = mesh_of_beam.draw(plate_mesh(), method, (4, 8, 1))
    assert said in words(figure).replace("\n", " ")
    lay_out(figure)


def test_plates_surface_on_a_grid_is_linear_where_it_is_linear_over_the_faces():
    side = surface_of_beam.on_grid(plate_surface(0.3).on("upper"), plate_surface(0.3).span)
    z, x = np.meshgrid(side.z, side.x)
    assert (side.z[0], side.z[-1]) == pytest.approx((0.01, 1.99))
    inside = (np.abs(x - 0.5) < 0.44) & (np.abs(z - 1.0) < 1.0 - 1 / 6)
    np.testing.assert_allclose(side.pressure[inside], -0.1 * z[inside], atol=1e-9)
    np.testing.assert_allclose(side.friction[inside], 1e-3 * (x[inside] - 0.3), atol=1e-9)
    np.testing.assert_allclose(side.spanwise_friction[inside], 1e-4 * z[inside], atol=1e-9)
    assert np.isfinite(side.pressure).all()


def test_plates_surface_says_how_long_the_bubble_is_and_what_is_missing():
    figure = surface_of_beam.draw(on_plate(at2=0.3, at10=2.0), ["none at 5 deg"], SOLVER)
    titles = [axes.get_title(loc="left") for axes in figure.axes[:4]]
    assert [title.split("bubble ")[-1] for title in titles[1::2]] == ["0.30 c", "1.00 c"]
    assert "none at 5 deg" in words(figure)


def test_plate_without_surface_data_says_so():
    figure = surface_of_beam.draw({}, ["no surface data at 2.5 deg"], SOLVER)
    found = words(figure).replace("\n", " ")
    assert "No incidence has surface data of the plate." in found
    assert "no surface data at 2.5 deg" in found
    lay_out(figure)


def test_flow_near_the_tip_has_a_plane_for_each_place_and_the_plate_where_it_is():
    figure = figures_of_data()["flow-at-tip"]()
    titles = [axes.get_title(loc="left") for axes in figure.axes[:4]]
    assert titles[0].endswith("rigid, 0.5 c from the leading edge")
    assert titles[3].endswith("flexible, 1.5 c from the leading edge")
    outlines = [[p for p in axes.patches if isinstance(p, Polygon)] for axes in figure.axes[:4]]
    assert [len(found) for found in outlines] == [1, 1, 0, 0]
    np.testing.assert_allclose(outlines[0][0].get_xy().max(axis=0), [3.7, 0.02])


@pytest.mark.parametrize(
    ("kind", "said"), [("settled", "docs/files.md"), ("failed", "it failed (it tangled)")]
)
def test_flow_near_the_tip_that_is_missing_is_told(kind, said):
    missing = flow_at_tip.column_of("flexible", tip_result(kind, flow=False))
    for columns in ([flow_at_tip.column_of("rigid", tip_result()), missing], [missing, missing]):
        figure = flow_at_tip.draw(columns)
        assert said in words(figure).replace("\n", " ")
        lay_out(figure)


def test_loads_along_the_span_are_lines_through_the_stations_of_one_mesh():
    coarse, fine = beam_polar(), beam_polar()
    fine = fine.assign_coords(span=fine["span"] - 0.01, resolution=["fine"])
    both = xr.concat([coarse, fine], "resolution", join="outer", data_vars="all")
    both = both.assign_attrs(solver_coarse=SOLVER, solver_fine=SOLVER)
    figure = spanwise_loads.draw(both, "coarse")
    drawn = [line.get_ydata() for axes in figure.axes for line in axes.lines if line.get_marker()]
    curves = [np.asarray(values) for values in drawn if len(values) == coarse.sizes["span"]]
    assert len(curves) >= 4
    assert all(np.isfinite(values).all() for values in curves)
    correction_figure = lift_correction.draw(SteadyData(polar_data(), both, correction(), "coarse"))
    root = next(line for line in correction_figure.axes[0].lines if "root" in line.get_label())
    assert np.isfinite(np.asarray(root.get_ydata())).all()


def test_loads_that_the_modes_feel_are_shown_where_they_correct():
    felt = correction().assign(beam_cl=("beam_incidence_deg", np.linspace(0.0, 0.7, 6)))
    felt = felt.assign_coords(beam_incidence_deg=np.linspace(0.0, 10.0, 6))
    for kind, are_shown in (("modal", True), ("mean", False)):
        chosen = felt.assign_attrs(correction=kind)
        figure = lift_correction.draw(SteadyData(polar_data(), beam_polar(), chosen, "coarse"))
        assert ("as the first mode feels it" in words(figure)) == are_shown
        lay_out(figure)


def test_correction_factor_has_a_gap_where_there_is_none():
    crossing = correction()
    crossing["moment_factor"] = ("incidence_deg", [0.8, np.nan, np.nan, 2.0, 1.5, 1.4])
    figure = moment_correction.draw(SteadyData(polar_data(), beam_polar(), crossing, "coarse"))
    drawn = next(line for line in figure.axes[1].lines if len(line.get_xdata()) == 6)
    np.testing.assert_array_equal(drawn.get_ydata(), crossing["moment_factor"])
    lay_out(figure)
    assert np.isfinite(figure.axes[1].get_ylim()).all()


def test_tables_and_polar_of_no_case_are_drawn(tmp_path):
    """As with ``compute: false`` and nothing kept; tables as they are read from their files."""

    def as_read(table: pd.DataFrame) -> pd.DataFrame:
        table.to_csv(tmp_path / "table.csv", index=False)
        return pd.read_csv(tmp_path / "table.csv")

    polar, summary = gather_polar({}), as_read(summarise([]))
    for figure, says in (
        (section_polar.draw(polar), "No incidence has a result."),
        (
            section_polar.draw(polar, as_read(grid_study(polar, {}))),
            "No incidence has an observed order",
        ),
        (
            growth_rate.draw(summary, linear_theory().iloc[:0], NOTHING),
            "No run has a growth rate.",
        ),
        (section_and_beam.draw(as_read(deviations(summary)), summary), "No section and beam"),
        (
            surface_loads.draw({}, as_read(bubble_table({})), "coarse", NOTHING),
            "No result has surface data.",
        ),
    ):
        assert says in words(figure)
        lay_out(figure)


def test_polars_may_be_empty():
    nothing = range(6)
    for figure in (
        section_polar.draw(polar_data(missing=nothing)),
        spanwise_loads.draw(beam_polar(missing=nothing), "coarse"),
        lift_correction.draw(
            SteadyData(
                polar_data(missing=nothing),
                beam_polar(missing=nothing),
                correction(math.nan),
                "coarse",
            )
        ),
    ):
        assert "No incidence has" in words(figure)
        lay_out(figure)


@pytest.mark.parametrize(
    ("available", "shown"),
    [
        ([0.0, 1.0, 2.5, 7.0, 10.0], [1.0, 2.5, 7.0]),
        ([0.0, 2.0, 6.0], [2.0, 6.0]),
        ([5.0], [5.0]),
        ([], []),
    ],
)
def test_incidences_shown(available, shown):
    assert nearest_incidences(available, spanwise_loads.WANTED_DEG) == shown


def test_modal_parts_add_up_and_compare():
    parts = modal_contributions.modal_parts(modes(), run(dimension="3d"), "torsion")
    assert parts.ratios[:3] == pytest.approx([1.0, 50.0, 1000.0])
    assert math.isinf(parts.ratios[3])
    tip = parts.amplitudes.sum()
    assert parts.parts.sum(axis=0)[-1] == pytest.approx(tip)  # every shape is 1 at the tip


def test_modal_parts_of_a_failed_run():
    figure = modal_contributions.draw(modes(), run(regime="failed", dimension="3d"))
    assert "it diverges" in words(figure)
    lay_out(figure)


@pytest.mark.parametrize("name", sorted(SWEEPS))
def test_response_draws(name, tmp_path):
    read = response.read_response(*sweep(tmp_path, SWEEPS[name]), 6.7)
    figure = response.draw(read)
    found = words(figure)
    assert "made-up" in found
    assert f"equisection {equisection.__version__}" in found
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    panels = [title for title in titles if ":" in title]
    assert [title[1] for title in panels] == list("cdefgh"[: len(panels)])
    shown = [title.split(":")[0][-1] for title in panels]
    assert shown == sorted(shown)
    has = {model[:2] for model in read.summary["model"]}
    for dimension, cases in (("2d", "ABC"), ("3d", "DEF")):
        assert (not set(cases).isdisjoint(shown)) == (dimension in has)
    assert ("2D: reduction 'consistent'" in found.replace("\n", " ")) == (name != "no section")
    if name == "diverged":
        assert "diverged, no mean" in found
        assert "it diverged" in found.replace("\n", " ")
    if name == "all failed":
        assert "every one failed or diverged" in found.replace("\n", " ")
    lay_out(figure)


def test_response_says_how_near_section_and_beam_are_and_where(tmp_path):
    summary, onset, paths = sweep(tmp_path, SWEEPS["all models"])
    beam = summary["model"] == "3d"
    summary.loc[beam, "mean_twist_deg"] *= 1.25
    summary.loc[beam & (summary["k_star"] == 8.0), "mean_deflection_chords"] *= 1.6
    at_4 = summary["k_star"] == 4.0
    summary.loc[beam & at_4, "mean_twist_deg"] = 1e3
    for of_section, of_beam in (
        ("growing", "growing"),
        ("growing", "settled"),  # beyond the onset of the section alone
        ("settled", "growing"),
        ("settled", "undecided"),
    ):
        summary.loc[at_4, "regime"] = np.where(beam[at_4], of_beam, of_section)
        figure = response.draw(response.read_response(summary, onset, paths, 6.7))
        titles = [axes.get_title(loc="left") for axes in figure.axes[:2]]
        assert "2D corrected within 20 % of 3D, $k^*$ = 5 to 8" in titles[0]
        assert "2D corrected within 38 % of 3D" in titles[1]
    alone = response.draw(response.read_response(*sweep(tmp_path, SWEEPS["no beam"]), 6.7))
    assert "within" not in alone.axes[0].get_title(loc="left")


def test_titles_of_the_response_over_speed_are_whole(tmp_path):
    """A long title goes on in a second line, rather than beyond the edge of the figure."""
    read = response.read_response(*sweep(tmp_path, SWEEPS["all models"]), 6.7)
    summary = read.summary.assign(speed=20.0 / np.sqrt(read.summary["k_star"] / 6.0))
    summary.loc[summary["model"] == "3d", ["mean_twist_deg", "mean_deflection_chords"]] *= 0.4
    over_speed = summary.drop(columns="k_star")
    figure = response.draw(
        replace(
            read,
            summary=over_speed,
            onset=read.onset.rename(columns=lambda name: name.replace("k_star_", "speed_")),
        )
    )
    lay_out(figure)
    for axes in figure.axes[:2]:
        title = axes._left_title
        assert "$V$ = " in title.get_text()
        assert title.get_text().endswith("m/s")
        assert title.get_window_extent().x1 < figure.bbox.x1


def test_bracket_of_the_onset_is_drawn_by_its_two_sides(tmp_path):
    figure = response.draw(response.read_response(*sweep(tmp_path, SWEEPS["no beam"]), 6.7))
    edges = [line for line in figure.axes[0].get_lines() if line.get_linestyle() == "--"]
    assert sorted(line.get_xdata()[0] for line in edges) == [4.0, 5.0]


def test_response_reads_and_draws_no_run_twice(tmp_path):
    """The stiffest run, C, is here the one next to the onset, B."""
    regimes = {4.0: "growing", 5.0: "limit-cycle"}
    read = response.read_response(*sweep(tmp_path, {"2d": regimes}), 6.7)
    assert list(read.histories) == ["A", "B"]
    figure = response.draw(read)
    letters = [axes.get_title(loc="left")[:7] for axes in figure.axes]
    assert letters[2:4] == ["(c)  A:", "(d)  B:"]
    assert not any(letters[4:])
    assert "C" not in words(figure)


def test_histories_are_shown_in_degrees_and_chords():
    """Of a twist in radians and a deflection in metres, at a chord of 0.1 m."""
    wave = 0.01 + 0.004 * np.sin(np.linspace(0.0, 40.0, 401))
    found = run(k_star=8.0)
    history = history_from_dataset(found, 2.0)
    np.testing.assert_allclose(history.twist_deg, wave * 180 / math.pi)
    np.testing.assert_allclose(history.tip_twist_deg, wave * 180 / math.pi)
    np.testing.assert_allclose(history.time, 2.0 * np.linspace(0.0, 40.0, 401))  # s sqrt(k*/I*)
    extent, late = extent_from_dataset(found), wave[200:]
    assert extent.twist_deg == pytest.approx(np.degrees([late.min(), late.max()]))
    assert extent.deflection_chords == pytest.approx([late.min(), late.max()])


def test_modal_contributions_are_shown_in_degrees_and_chords():
    found = run(dimension="3d")
    figure = modal_contributions.draw(modes(), found)
    late = 0.01 + 0.004 * np.sin(np.linspace(0.0, 40.0, 401))[200:]
    at_tip = (1.0 - 0.02 + 1e-3) * late.mean()
    for axes, unit in zip(figure.axes[:2], (1.0, 180 / math.pi), strict=True):
        (whole,) = (line for line in axes.get_lines() if line.get_label() == "all modes")
        assert whole.get_ydata()[-1] == pytest.approx(unit * at_tip)


def test_rounding_of_a_correction_of_one_is_not_enlarged():
    data = SteadyData(polar_data(), beam_polar(), correction(1.0 - 3e-9), "coarse")
    low, high = lift_correction.draw(data).axes[1].get_ylim()
    assert low < 0.99
    assert high > 1.01


def test_beam_without_a_mean_deformation_has_no_modes_that_add_to_it():
    found = run(dimension="3d")
    for kind in ("bending", "torsion"):
        found[f"{kind}_amplitude"] *= 1e-3
    figure = modal_contributions.draw(modes(), found)
    assert "no mean deformation" in words(figure)
    lay_out(figure)


@pytest.mark.parametrize("name", sorted(SWEEPS))
def test_hysteresis_draws(name, tmp_path):
    loops = hysteresis.read_loops(*sweep(tmp_path, SWEEPS[name]), 6.7)
    figure = hysteresis.draw(loops)
    assert "made-up" in words(figure)
    lay_out(figure)


def test_response_says_to_which_side_its_onsets_err(tmp_path):
    summary, onset, paths = sweep(tmp_path, SWEEPS["all models"])
    errors = {"growth_error": np.nan, "growth_error_rms": np.nan, "errs": "unknown"}
    onset = onset.assign(**errors).astype({"errs": object})
    unknown = words(response.draw(response.read_response(summary, onset, paths, 6.7)))
    assert "errs to" not in unknown
    beam = onset["model"] == "3d"
    onset.loc[beam, list(errors)] = [-0.01, 0.013, "unsafe"]
    found = words(response.draw(response.read_response(summary, onset, paths, 6.7)))
    said = "3D: growth -0.0100 V/c off kept CFD in the mean (0.0130 rms), the onset errs to"
    assert f"{said} the unsafe side" in found.replace("\n", " ")


def test_response_opens_no_file_that_it_does_not_draw(tmp_path):
    summary, onset, paths = sweep(tmp_path, SWEEPS["all models"])
    drawn = {"2d-corrected/k4", "2d-corrected/k5", "2d-corrected/k8", "3d/k4", "3d/k5", "3d/k8"}
    for path in paths:
        if f"{path.parent.name}/{path.stem}" not in drawn:
            path.write_text("not to be opened")
    read = response.read_response(summary, onset, paths, 6.7)
    assert set(read.histories) == set("ABCDEF")


@pytest.mark.parametrize(
    ("places", "said"),
    [
        ((1.0, 1.0), ("of the tip", "of the tip")),
        ((0.5, 0.5), ("at midspan", "at midspan")),
        ((0.0, 0.24), ("at the root end", "at $z/L$ = 0.24")),
    ],
)
def test_means_are_those_of_where_the_motion_is_read(tmp_path, places, said):
    read = response.read_response(*sweep(tmp_path, SWEEPS["one k*"]), 6.7, places=places)
    found = words(response.draw(read))
    assert f"mean twist {said[0]}" in found
    assert f"mean deflection {said[1]}" in found


def test_swing_of_a_sections_deflection_is_that_of_an_oscillation():
    """About its mean, which stays: by the factor of its reduction."""
    found = run(k_star=8.0).assign_attrs(mean_deflection_chords=0.01)
    plain, recovered = extent_from_dataset(found), extent_from_dataset(found, 1.5)
    for before, after in zip(plain.deflection_chords, recovered.deflection_chords, strict=True):
        assert after - 0.01 == pytest.approx(1.5 * (before - 0.01))
    assert recovered.twist_deg == plain.twist_deg


@pytest.mark.parametrize("along", [K_STAR, SPEED])
def test_axis_at_the_top_has_what_the_beam_has_there(along):
    """A tick at 30 m/s stands above the k* of 30 m/s, and the other way round."""
    given = AsGiven(8.0, 20.0)
    (axes,) = (figure := Figure()).subplots(1, 1, squeeze=False)[0]
    axes.set_xlim(2.0, 40.0)
    add_other_axis(axes, along, given)
    (top,) = axes.child_axes
    places, numbers = top.get_xticks(), [float(t.get_text()) for t in top.get_xticklabels()]
    assert len(places) >= 3
    there = given.speed_at if along is K_STAR else given.k_star_at
    np.testing.assert_allclose(numbers, [there(place) for place in places])
    lay_out(figure)


def test_no_axis_at_the_top_where_the_speed_is_unknown():
    axes = Figure().subplots()
    add_other_axis(axes, K_STAR, as_given(pd.DataFrame({"k_star": [5.0], "speed": [math.nan]})))
    add_other_axis(axes, INCIDENCE, AsGiven(8.0, 20.0))
    assert not axes.child_axes
    assert as_given(pd.DataFrame({"k_star": [5.0]})) is None


def test_mean_that_still_drifted_has_an_open_marker(tmp_path):
    summary, onset, paths = sweep(tmp_path, SWEEPS["all stable"])
    summary.loc[0, "mean_known"] = 0
    figure = response.draw(response.read_response(summary, onset, paths, 6.7))
    lines = figure.axes[0].get_lines()
    (drifting,) = (line for line in lines if line.get_markerfacecolor() == "white")
    assert drifting.get_xdata().tolist() == [4.0]
    (legend,) = figure.legends
    assert "still drifting" in [text.get_text() for text in legend.get_texts()]


def test_failed_runs_are_crosses_on_the_axis(tmp_path):
    figure = response.draw(response.read_response(*sweep(tmp_path, SWEEPS["all models"]), 6.7))
    crosses = [line for line in figure.axes[0].get_lines() if line.get_marker() == "x"]
    assert [list(line.get_xdata()) for line in crosses] == [[6.0]] * 3


def test_reduced_time_is_that_of_the_paper(tmp_path):
    read = response.read_response(*sweep(tmp_path, SWEEPS["one k*"]), 21.0 / 4.0)
    assert read.histories["B"].time[-1] == pytest.approx(2.0 * 40.0)


@pytest.mark.parametrize("module", [mesh_of_section, courant_number])
def test_mesh_that_is_not_kept_is_said_to_be_missing(module):
    figure = module.draw(no_mesh(2.5, 0.02).to_dataset())
    assert "is not kept" in words(figure).replace("\n", " ")
    lay_out(figure)


def test_rigid_beam_that_was_not_run_is_said_to_be_missing():
    figure = spanwise_loads.draw(gather_polar({}), "coarse")
    assert "No rigid beam was run" in words(figure)
    lay_out(figure)


def linear_theory() -> pd.DataFrame:
    return pd.DataFrame(
        {
            "reduction": "consistent",
            "motion": ["pitch", "pitch", "heave", "heave"],
            "k_star": [5.0, 21.0, 5.0, 21.0],
            "growth_rate": [-0.03, -0.02, -0.05, -0.04],
            "frequency_strouhal": [0.12, 0.28, 0.02, 0.04],
        }
    )


def growth(**changes: object) -> pd.DataFrame:
    runs = {
        "model": "2d",
        "k_star": [5.0, 21.0],
        "regime": ["growing", "settled"],
        "growth_rate": [0.01, -0.02],
        "frequency_strouhal": [0.12, 0.28],
        "solver": "made-up",
        "resolution": "coarse",
    }
    return pd.DataFrame({**runs, **changes})


def test_growth_of_runs_and_of_linear_theory_stand_in_one_panel():
    figure = growth_rate.draw(growth(), linear_theory(), stated(math.nan, 5.5, "onset elsewhere"))
    drawn = [tuple(line.get_ydata()) for line in figure.axes[0].get_lines()]
    assert {(0.01, -0.02), (-0.03, -0.02), (-0.05, -0.04)} <= set(drawn)
    marks = [line for line in figure.axes[0].get_lines() if line.get_label() == "onset elsewhere"]
    assert [list(line.get_xdata()) for line in marks] == [[5.5, 5.5]]
    lay_out(figure)


def test_bar_of_a_growth_rate_that_is_not_known_leaves_the_others_apart():
    """A fit of a motion without an oscillation has bars hundreds of times as long as growths."""
    runs = growth(growth_low=growth()["growth_rate"] - 0.01, growth_high=growth()["growth_rate"])
    usual = growth_rate.draw(runs, linear_theory(), NOTHING).axes[0].get_ylim()
    runs.loc[runs.index[-1], ["growth_low", "growth_high"]] = -13.0, 13.0
    low, high = growth_rate.draw(runs, linear_theory(), NOTHING).axes[0].get_ylim()
    assert low <= usual[0] < usual[1] <= high
    assert high - low < 4.0 * (usual[1] - usual[0])


def test_model_with_a_frequency_alone_is_in_the_legend_and_one_point_is_seen():
    nothing = growth(growth_rate=np.nan)
    alone = linear_theory().drop_duplicates("motion")
    figure = growth_rate.draw(nothing, alone, NOTHING)
    (legend,) = figure.legends
    assert LOOKS["2d"].label in [text.get_text() for text in legend.get_texts()]
    lines = [line for line in figure.axes[0].get_lines() if str(line.get_label())[0] != "_"]
    assert len(lines) == 2
    assert all(line.get_marker() == "." for line in lines)


def test_what_is_below_the_design_speed_ends_with_the_interval():
    angles = {"incidence_deg": [0.0, 5.0]}
    speeds = np.array([[12.0, 4.0]])
    data = xr.Dataset(
        {
            "critical_speed": (("model", "incidence_deg"), speeds),
            "speed_low": (("model", "incidence_deg"), speeds),
            "critical_mechanism": (("model", "incidence_deg"), [["flutter", "flutter"]]),
        },
        {"model": ["3d"], **angles},
        {"basis": "eigenvalue", "polar": "plate"},
    )
    ends = {"speed": speeds[0], "speed_low": speeds[0], "speed_from": [9.0, 3.0]}
    table = pd.DataFrame({"model": "3d", **angles, **ends, "speed_to": [15.0, 5.0]})
    figure = critical_speed.draw(data, table, 10.0)
    marked = [line for line in figure.axes[0].collections if isinstance(line, LineCollection)][-1]
    tops = [float(segment[:, 1].max()) for segment in marked.get_segments()]
    assert tops == [10.0, 5.0]
    assert "interval below the design speed" in words(figure)


def test_speed_up_to_which_a_model_is_stable_is_marked_and_nothing_else_is():
    angles = {"incidence_deg": [2.0, 5.0]}
    over = ("model", "incidence_deg")
    data = xr.Dataset(
        {
            "critical_speed": (over, [[np.nan, 40.0]]),
            "speed_low": (over, [[60.0, 40.0]]),
            "critical_mechanism": (over, [["none", "flutter"]]),
        },
        {"model": ["3d"], **angles},
        {"basis": "eigenvalue", "polar": "plate"},
    )
    ends = {"speed": [np.nan, 40.0], "speed_low": [60.0, 40.0], "speed_from": np.nan}
    figure = critical_speed.draw(
        data, pd.DataFrame({"model": "3d", **angles, **ends, "speed_to": np.nan}), None
    )
    axes = figure.axes[0]
    (bar,) = (line for line in axes.get_lines() if line.get_marker() == 2 and line.get_xdata().size)
    assert (bar.get_xdata().tolist(), bar.get_ydata().tolist()) == ([2.0], [60.0])
    assert "stable up to here" in words(figure)
    assert axes.get_xlim()[0] > 1.0


def test_limit_cycles_of_a_learnt_model_have_a_panel_and_words():
    values = {
        name: ("k_star", np.array([1.0, 1.0]))
        for name in (
            *("growth_rate", "growth_low", "growth_high"),
            *("frequency_strouhal", "frequency_low", "frequency_high"),
        )
    }
    flags = {"extrapolated": ("k_star", np.zeros(2))}
    attributes = {"model": "2d", "words": "model learnt", "learnt_from_k_star": 6.0}
    data = xr.Dataset({**values, **flags}, {"k_star": [5.0, 8.0]}, attributes)
    runs = growth(regime=["limit-cycle", "settled"], twist_amplitude_deg=[4.0, 0.0])
    without = growth_rate.draw(runs, linear_theory(), NOTHING, [data])
    assert len(without.axes) == 2
    cycles = data.assign(
        limit_cycle_deg=("k_star", np.array([5.0, 2.0])),
        limit_cycle_extrapolated=("k_star", np.array([1.0, 0.0])),
    ).assign_attrs(limit_cycles="limit cycle by a model")
    figure = growth_rate.draw(runs, linear_theory(), NOTHING, [cycles])
    panel = figure.axes[2]
    seen, beyond, run = (line.get_ydata() for line in panel.get_lines())
    np.testing.assert_array_equal(seen, [np.nan, 2.0])
    np.testing.assert_array_equal(beyond, [5.0, np.nan])
    assert list(run) == [4.0]
    assert "limit cycle by a model" in words(figure)
    lay_out(figure)


def test_failed_runs_have_no_growth():
    failed = growth(regime="failed")
    figure = growth_rate.draw(failed, linear_theory().iloc[:0], NOTHING)
    assert "No run has a growth rate." in words(figure)
    lay_out(figure)


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_saving_twice_gives_the_same_bytes(suffix, tmp_path):
    data = sweep(tmp_path, {"2d-corrected": {4.0: "growing"}})
    for place in ("first", "second"):
        loops = hysteresis.read_loops(*data, 6.7)  # lines, pixels, text and mathematics
        save_figure(hysteresis.draw(loops), [tmp_path / place / f"figure.{suffix}"])
    first, second = (tmp_path / place / f"figure.{suffix}" for place in ("first", "second"))
    assert first.read_bytes() == second.read_bytes()
    assert first.stat().st_size > 10_000


def test_a_figure_is_laid_out_once_for_all_formats(tmp_path, monkeypatch):
    laid_out = []
    once = ConstrainedLayoutEngine.execute

    def counted(engine, figure):
        laid_out.append(figure)
        return once(engine, figure)

    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", counted)
    with drawing_style(STYLE):  # which asks for a layout engine
        figure = Figure()
        axes = figure.subplots()
        axes.set_ylabel("a label that needs room")
        save_figure(figure, [tmp_path / f"figure.{suffix}" for suffix in ("png", "svg", "pdf")])
    assert laid_out == [figure]
    assert {path.suffix for path in tmp_path.iterdir()} == {".png", ".svg", ".pdf"}


def test_an_unknown_format_is_refused(tmp_path):
    with pytest.raises(FigureFormatError, match="format 'bmp' is not written here"):
        save_figure(Figure(), [tmp_path / "figure.bmp"])


def test_nothing_is_left_of_a_drawing_that_fails(tmp_path):
    figure = Figure()
    figure.text(0.5, 0.5, r"$\nosuchcommand$")
    with pytest.raises(ValueError, match="nosuchcommand"):
        save_figure(figure, [tmp_path / "figure.png"])
    assert list(tmp_path.iterdir()) == []


def test_cases_that_are_close_share_a_mark(tmp_path):
    close = {4.0: "growing", 10.0: "growing", 10.02: "settled", 20.0: "settled"}
    data = sweep(tmp_path, {"2d": close})
    found = words(response.draw(response.read_response(*data, 6.7)))
    assert "\nA, B\n" in found
    assert "\nC\n" in found
