"""The paper's numbers beside those of a run, and its tables."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from equisection.analysis.bubble import bubble_table
from equisection.analysis.onset import onset_table
from equisection.analysis.summary import summarise
from equisection.config import Config
from equisection.paper import printed_values as paper_values
from equisection.paper.comparison import COLUMNS, paper_table
from equisection.paper.printed_values import PUBLISHED, Published, relative_difference
from equisection.paper.quantities import Run, uniform_load_ratio
from equisection.paper.tables import table_1, table_2
from equisection.results.polar_dataset import gather_polar

KINDS = ("bending", "bending", "torsion", "bending", "torsion", "in-plane")
FREQUENCY = np.array([8.0, 50.0, 58.0, 140.0, 180.0, 188.0])
ANGLES = (0.0, 2.5, 5.0, 10.0)


def modes() -> xr.Dataset:
    return xr.Dataset(
        {
            "frequency": ("mode", FREQUENCY),
            "kind": ("mode", list(KINDS)),
            "frequency_constant": ("mode", FREQUENCY * 3e-5),
        },
        attrs={"method": "solid", "elements": "24 x 89 x 2"},
    )


def mesh_study() -> xr.Dataset:
    analytic = np.array([8.1, 51.0, 57.0, 142.0, 171.0, math.nan])
    return xr.Dataset(
        {
            "frequency": (("elements", "mode"), np.array([1.02, 1.01])[:, None] * FREQUENCY),
            "kind": ("mode", list(KINDS)),
            "mesh": ("elements", ["4 x 15 x 1", "8 x 30 x 1"]),
            "analytic_frequency": ("mode", analytic),
        }
    )


def polar_3d(angles: tuple[float, ...] = ANGLES) -> xr.Dataset:
    rows = paper_values.TABLE_1["15e6 cells"]
    values = np.array([rows.get(angle, (0.1, 0.3, 0.06)) for angle in angles])
    return xr.Dataset(
        {
            short: (("resolution", "incidence_deg"), values[None, :, column] * 1.1)
            for column, short in enumerate(("cd", "cl", "cm"))
        },
        {"resolution": ["coarse"], "incidence_deg": list(angles)},
        attrs={"solver_coarse": "a solver on 9 cells", "failures": ""},
    )


def summary(regimes: dict[str, dict[float, str]]) -> pd.DataFrame:
    return pd.DataFrame(
        [
            {
                "model": model,
                "k_star": k_star,
                "regime": regime,
                "twist_amplitude_deg": 0.9,
                "cpu_seconds": 8.0 if model == "3d" else 2.0,
                "end_time": 100.0,
                "solver": "embedded",
            }
            for model, runs in regimes.items()
            for k_star, regime in runs.items()
        ]
    )


def onset(*rows: tuple[str, float, float]) -> pd.DataFrame:
    return pd.DataFrame(rows, columns=["model", "k_star_stable", "k_star_unstable"])


def bubble() -> pd.DataFrame:
    """Return the table of a run whose result at 5 deg has no surface data."""
    columns = (
        "resolution incidence_deg bubble y_plus_mean y_plus_largest y_plus_below_1 method note"
    )
    rows = [
        ("coarse", 1.0, 0.4, 0.7, 2.0, 0.95, "steady", ""),
        ("coarse", 2.5, 0.6, 0.8, 2.4, 0.93, "steady", ""),
        ("coarse", 5.0, *[math.nan] * 4, "steady", "made before"),
        ("fine", 5.0, 0.9, 0.5, 0.9, 1.0, "steady", ""),
    ]
    return pd.DataFrame(rows, columns=columns.split()).assign(solver="a solver on 9 cells")


REGIMES = {
    "2d": {5.0: "growing", 6.0: "settled"},
    "2d-corrected": {5.0: "growing", 6.0: "settled"},
    "3d": {5.0: "limit-cycle", 7.0: "settled"},
}


def run(**changes: object) -> Run:
    time = np.linspace(0.0, 10.0, 11)
    amplitude = np.outer([0.1, -5e-4], np.ones(11))
    both = ["paper", "consistent"]
    parts: dict[str, object] = {
        "config": Config(),
        "modes": modes(),
        "equivalent": xr.Dataset(
            {
                "stiffness_ratio": ("reduction", [0.184, 0.228]),
                "inertia_ratio": ("reduction", [9.13, 12.0]),
                "k_star": ("reduction", [21.28, 22.5]),
                "f_mean": ("row", [0.6, -0.2]),
                "g_mean": ("row", [0.4, -0.2]),
                "mass_theta": (("row", "column"), np.diag([0.4, 0.4])),
                "mass_w": (("row", "column"), np.diag([0.25, 0.25])),
            },
            {"reduction": both},
        ),
        "polar_3d": polar_3d(),
        "correction": xr.Dataset(
            {
                "lift_factor": ("incidence_deg", [1.2, 1.2, 0.9]),
                "moment_factor": ("incidence_deg", [1.1, 1.1, 1.05]),
            },
            {"incidence_deg": [0.0, 2.5, 10.0]},
        ),
        "summary": summary(REGIMES),
        "onset": onset(("2d", 6.0, 5.0), ("2d-corrected", 6.0, 5.0), ("3d", 7.0, 5.0)),
        "reference_3d": xr.Dataset(
            {
                "torsion_amplitude": (("torsion_mode", "time"), amplitude),
                "bending_amplitude": (("bending_mode", "time"), 100 * amplitude[::-1]),
            },
            {"time": time},
            attrs={"window_start": 5.0, "k_star": 21.0},
        ),
    }
    return Run(**{**parts, **changes})  # type: ignore[arg-type]


def by_quantity(table: pd.DataFrame) -> pd.DataFrame:
    assert table["quantity"].is_unique
    return table.set_index("quantity")


class TestPublished:
    def test_names_are_unique(self) -> None:
        names = [value.name for value in PUBLISHED]
        assert len(set(names)) == len(names)

    @pytest.mark.parametrize(
        ("name", "value"),
        [
            ("C_D at 0 deg (4.7e6 cells)", 0.0473),
            ("C_M at 5 deg (4.7e6 cells)", 0.0804),
            ("C_L at 5 deg (7.0e6 cells)", 0.4861),
            ("C_M at 10 deg (15e6 cells)", 0.0659),
            ("C_1 (bending) (8.5e3 elements)", 2.44e-4),
            ("C_5 (torsion) (5.0e4 elements)", 5.35e-3),
            ("c^2 k_w/k_theta", 0.183),
            ("c^2 m_2D/I_2D", 9.12),
            ("k* of the onset", 5.5),
            ("aspect ratio 2L/c", 7.4),
        ],
    )
    def test_values_are_the_printed_ones(self, name: str, value: float) -> None:
        assert {entry.name: entry.value for entry in PUBLISHED}[name] == value

    def test_what_follows_from_the_printed_values(self) -> None:
        values = {entry.name: entry.value for entry in PUBLISHED}
        assert values["Reynolds number (rho V c/mu)"] == pytest.approx(1.27e5, rel=2e-3)
        assert values["cost of 3D over 2D, per time simulated"] == pytest.approx(245, rel=2e-3)

    def test_refinement_of_table_1_changes_little(self) -> None:
        """A slip of the pen in the table would break the paper's own grid independence."""
        coarse, fine = (paper_values.TABLE_1[m] for m in ("4.7e6 cells", "15e6 cells"))
        for angle, row in coarse.items():
            np.testing.assert_allclose(row, fine[angle], rtol=0.17)

    def test_bounds(self) -> None:
        bound = Published("ratio", 100.0, "somewhere", "at least")
        assert bound.holds(100.0)
        assert not bound.holds(99.0)


class TestRelativeDifference:
    def test_arithmetic(self) -> None:
        assert relative_difference(2.0, 2.5) == 0.25
        assert relative_difference(-2.0, -1.0) == -0.5

    @pytest.mark.parametrize(("paper", "here"), [(0.0, 1.0), (math.nan, 1.0), (1.0, math.nan)])
    def test_without_meaning(self, paper: float, here: float) -> None:
        assert math.isnan(relative_difference(paper, here))

    def test_last_bit_is_no_difference(self) -> None:
        assert relative_difference(3.7, 0.37 / 0.1) == 0.0


class TestPaperTable:
    def test_columns_begin_with_those_of_the_contract(self, tmp_path: Path) -> None:
        path = tmp_path / "paper.csv"
        paper_table(run()).to_csv(path, index=False)
        read = pd.read_csv(path)
        assert list(read.columns[:4]) == ["quantity", "paper", "here", "relative_difference"]
        assert tuple(read.columns) == COLUMNS
        assert read["paper"].dtype == read["here"].dtype == float

    def test_every_published_number_has_a_row(self) -> None:
        names = set(paper_table(run())["quantity"])
        for entry in PUBLISHED:
            assert any(name == entry.name or name.startswith(entry.name + ",") for name in names)

    def test_an_empty_value_says_why(self) -> None:
        table = paper_table(run())
        assert (table.loc[table["here"].isna(), "note"] != "").all()

    def test_values_beside_each_other(self) -> None:
        row = by_quantity(paper_table(run())).loc["C_L at 10 deg (15e6 cells)"]
        assert row["paper"] == 0.5684
        assert row["here"] == pytest.approx(1.1 * 0.5684)
        assert row["relative_difference"] == pytest.approx(0.1)
        assert "a solver on 9 cells" in row["note"]

    def test_onset_of_the_models_that_the_paper_speaks_of(self) -> None:
        table = by_quantity(paper_table(run()))
        assert table.loc["k* of the onset, 3d", "here"] == 6.0
        assert table.loc["k* of the onset, 2d-corrected", "relative_difference"] == 0.0
        assert (
            "5 (limit cycle of 0.9 deg) to 7 (settled)" in table.loc["k* of the onset, 3d", "note"]
        )
        assert "k* of the onset, 2d" not in table.index

    @pytest.mark.parametrize(
        ("row", "says"),
        [
            (("3d", 5.0, math.nan), "below 5"),
            (("3d", math.nan, 7.0), "above 7"),
            (("3d", math.nan, math.nan), "every run failed"),
        ],
    )
    def test_open_brackets(self, row: tuple[str, float, float], says: str) -> None:
        found = by_quantity(paper_table(run(onset=onset(row)))).loc["k* of the onset, 3d"]
        assert math.isnan(found["here"])
        assert says in found["note"]

    def test_bounds_hold_or_do_not(self) -> None:
        table = by_quantity(paper_table(run()))
        torsion = table.loc["first torsion mode over the others"]
        assert torsion["here"] == pytest.approx(200.0)
        assert torsion["note"].startswith("holds")
        bending = table.loc["first bending mode over the others", "note"]
        assert bending.startswith("does not hold")
        assert math.isnan(torsion["relative_difference"])
        assert table.loc["c_l/C_L at 10 deg", "note"] == "holds"
        assert table.loc["c_m/C_M at 10 deg", "note"] == "does not hold here"

    def test_a_factor_that_is_not_a_positive_number_is_blank_with_the_reason(self) -> None:
        crossing = run().correction.assign(moment_factor=("incidence_deg", [1.1, math.nan, 1.05]))
        table = by_quantity(paper_table(run(correction=crossing)))
        row = table.loc["c_m/C_M at theta_0"]
        assert math.isnan(row["here"])
        assert math.isnan(row["relative_difference"])
        assert "not a positive number" in row["note"]
        assert table.loc["c_m/C_M at 10 deg", "here"] == 1.05
        assert table.loc["c_l/C_L at theta_0", "here"] == 1.2

    def test_modal_factors_are_not_compared_with_the_papers(self) -> None:
        """The paper's are of the mean loads; its bounds on them say nothing of others."""
        names = [f"{f} at {at}" for f in ("c_l/C_L", "c_m/C_M") for at in ("theta_0", "10 deg")]
        for kind, compared in (("modal", False), ("mean", True)):
            factors = run().correction.assign_attrs(correction=kind)
            table = by_quantity(paper_table(run(correction=factors))).loc[names]
            assert table["here"].notna().all()
            assert table["note"].str.contains("hold").all() == compared
            assert table["note"].str.contains("hold").any() == compared
            assert table["note"].str.contains("correction: modal").any() != compared

    def test_ratio_of_a_uniform_load(self) -> None:
        assert uniform_load_ratio(run(), "torsion") == pytest.approx(3.0 * (180 / 58) ** 2)
        one = run(modes=modes().isel(mode=[0, 2]))
        assert math.isnan(uniform_load_ratio(one, "torsion"))

    def test_without_the_beam(self) -> None:
        table = by_quantity(paper_table(run(reference_3d=None)))
        assert math.isnan(table.loc["first torsion mode over the others", "here"])

    def test_a_failed_incidence_is_blank_with_the_reason(self) -> None:
        polar = polar_3d()
        polar["cl"][0, 3] = math.nan
        polar.attrs["failures"] = "coarse 10 deg: did not converge"
        row = by_quantity(paper_table(run(polar_3d=polar))).loc["C_L at 10 deg (15e6 cells)"]
        assert math.isnan(row["here"])
        assert math.isnan(row["relative_difference"])
        assert "did not converge" in row["note"]

    def test_a_run_without_results_has_rows_that_say_why(self) -> None:
        """As with ``compute: false`` and nothing kept."""
        nothing = summarise([])
        empty = run(
            polar_3d=gather_polar({}),
            summary=nothing,
            onset=onset_table(nothing),
            bubble=bubble_table({}),
            reference_3d=None,
            correction=None,
        )
        row = by_quantity(paper_table(empty)).loc["C_L at 10 deg (15e6 cells)"]
        assert math.isnan(row["here"])
        assert "no incidence has a result at resolution coarse" in row["note"]

    def test_no_cost_without_a_run(self) -> None:
        failed = summary({"2d": {5.0: "failed"}, "3d": {5.0: "failed"}})
        failed["end_time"] = 0.0
        row = by_quantity(paper_table(run(summary=failed, onset=onset()))).loc[
            "cost of 3D over 2D, per time simulated"
        ]
        assert math.isnan(row["here"])

    def test_cost_has_no_relative_difference(self) -> None:
        row = by_quantity(paper_table(run())).loc["cost of 3D over 2D, per time simulated"]
        assert row["here"] == pytest.approx(4.0)
        assert math.isnan(row["relative_difference"])

    def test_bubble_and_wall_distance_beside_the_papers(self) -> None:
        table = by_quantity(paper_table(run(bubble=bubble())))
        row = table.loc["bubble over chord, 2D at 1 deg"]
        assert row["here"] == 0.4
        assert row["relative_difference"] == pytest.approx(-0.2)
        assert "resolution coarse, a solver on 9 cells, steady" in row["note"]
        row = table.loc["wall y+, 2D"]
        assert row["here"] == 2.4
        assert row["note"].startswith("does not hold here")
        assert "at 2.5 deg; 0.8 in the mean, below 1 on 93 % of both sides" in row["note"]

    def test_a_bubble_that_is_not_known_says_why(self) -> None:
        table = by_quantity(paper_table(run(bubble=bubble())))
        assert "made before" in table.loc["bubble over chord, 2D at 5 deg", "note"]
        few = bubble().iloc[1:]
        table = by_quantity(paper_table(run(bubble=few)))
        assert "1 deg: not among" in table.loc["bubble over chord, 2D at 1 deg", "note"]
        table = by_quantity(paper_table(run()))
        assert "'embedded' has no surface" in table.loc["wall y+, 2D", "note"]


class TestTables:
    def test_table_1_has_all_meshes_and_the_run(self) -> None:
        table = table_1(polar_3d()).set_index("incidence_deg")
        assert table.loc[2.5, "C_M paper 15e6 cells"] == 0.0602
        assert table.loc[10.0, "C_D paper 4.7e6 cells"] == 0.1551
        assert table.loc[10.0, "C_D coarse"] == pytest.approx(1.1 * 0.1535)
        assert (table["made_by"] == "coarse: a solver on 9 cells").all()

    def test_table_1_leaves_incidences_blank_that_were_not_run(self) -> None:
        table = table_1(polar_3d((0.0, 2.5, 4.0, 6.0)))
        assert list(table["incidence_deg"]) == list(ANGLES)
        assert table["C_L coarse"].isna().tolist() == [False, False, True, True]

    def test_table_1_of_no_result_has_the_papers_columns(self) -> None:
        table = table_1(gather_polar({}))
        assert list(table.columns) == list(
            table_1(polar_3d()).filter(regex="^(?!.*coarse)").columns
        )
        assert len(table) == len(ANGLES)

    def test_table_2(self) -> None:
        table = table_2(modes(), mesh_study(), 0.004 / 0.37).set_index("constant")
        assert table.loc["C_3", "paper 8.5e3 elements"] == 1.77e-3
        assert table.loc["C_2", "solid 24 x 89 x 2"] == pytest.approx(50.0 * 3e-5)
        assert table.loc["C_2", "mesh 4 x 15 x 1"] == pytest.approx(1.02 * 50.0 * 3e-5)
        assert table.loc["C_3", "analytic beam"] == pytest.approx(0.004 / 0.37 / (2 * math.pi))
        assert list(table["kind"]) == ["bending", "bending", "torsion", "bending", "torsion"]

    def test_table_2_says_what_three_finer_and_finer_meshes_converge_to(self) -> None:
        """Errors of 16 % h^2: the element sizes are 1, 1/2 and 1/3 in chord and span."""
        factors = np.array([1.16, 1.04, 1.0 + 0.16 / 9])
        study = mesh_study().isel(elements=[0, 0, 0])
        study["frequency"] = (("elements", "mode"), factors[:, None] * FREQUENCY)
        study["mesh"] = ("elements", ["4 x 15 x 1", "8 x 30 x 1", "12 x 45 x 1"])
        table = table_2(modes(), study, 0.01).set_index("constant")
        assert table["observed_order"].to_numpy() == pytest.approx(2.0)
        assert table["extrapolated"].to_numpy() == pytest.approx(
            table["solid 24 x 89 x 2"].to_numpy()
        )
        assert (table["convergence"] == "monotonic").all()
        assert table["gci"].to_numpy() == pytest.approx(1.25 * 0.16 / 9 / factors[-1])

    def test_table_2_without_second_torsion(self) -> None:
        few = modes().isel(mode=[0, 1, 2, 3])
        table = table_2(few, mesh_study(), 0.01).set_index("constant")
        assert math.isnan(table.loc["C_5", "solid 24 x 89 x 2"])
