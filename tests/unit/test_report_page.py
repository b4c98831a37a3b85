"""The report on one page, as its text, and as Chromium shows it."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from tests.chromium import Chromium, program
from tests.conftest import ROOT
from tests.run_by_hand import Run
from tests.unit.test_commands import HEADER

import equisection as eq
from equisection.figures.panels import without_data
from equisection.figures.save import save_figure
from equisection.report.captions import CaptionError, caption_html
from equisection.report.csv_tables import table_shown
from equisection.report.embedded_files import EmbeddingError
from equisection.report.interactive_map import interactive_map
from equisection.report.report_page import MapFiles, ReportError, Shown, write_report
from equisection.results.netcdf import write_dataset

#: Light enough for mail.
MOST_BYTES = 10e6
NAME = "beam <b>&amp;"
ATTACK = "</script><script>document.title = 'altered'</script><img src=x onerror=alert(1)>"
DESIGN_SPEED = 30.0


@pytest.fixture(scope="module")
def stability_map() -> xr.Dataset:
    """A panel's section over incidence and speed, and a beam of which nothing is known."""
    beam = eq.Beam.from_yaml(ROOT / "config/examples/photovoltaic_panel.yaml")
    section = eq.reduce(beam, method="beam")
    polar = eq.Polar.read(ROOT / "config/polars/plate_2d_11136.csv")
    speeds = np.linspace(10.0, 70.0, 13)
    known = eq.stability_map(section, polar, incidence_deg=[1.0, 2.5], speed=speeds, density=1.18)
    unknown = known.copy(
        data={
            name: np.full(one.shape, np.nan if one.dtype.kind == "f" else "unknown", one.dtype)
            for name, one in known.data_vars.items()
        }
    )
    both = xr.concat([known, unknown], "model", combine_attrs="override")
    names = {"units": "1", "long_name": "model of the sweep"}
    return both.assign_coords(model=("model", ["2d", "3d"], names))


@pytest.fixture(scope="module")
def stability(stability_map: xr.Dataset) -> pd.DataFrame:
    """Critical speeds of the map, known to 2 m/s of those of the section, one open above."""
    speed = stability_map["critical_speed"].to_dataframe().reset_index()
    speed = speed[["model", "incidence_deg", "critical_speed"]]
    return speed.rename(columns={"critical_speed": "speed"}).assign(
        speed_from=lambda table: table["speed"] - 2.0,
        speed_to=lambda table: [*table["speed"][:1] + 2.0, np.inf, *table["speed"][2:]],
        margin=lambda table: table["speed"] / DESIGN_SPEED,
    )


def shown(path: Path, number: str = "", shows: str = "") -> Shown:
    caption = caption_html("What is *seen*.", {}, {}, path.stem)
    return Shown(path, path.stem, number, shows or path.stem, caption)


def picture(folder: Path, name: str) -> Path:
    path = folder / f"{name}.png"
    matplotlib.image.imsave(path, np.ones((40, 90, 3)))
    return path


def written(
    folder: Path, stability_map: xr.Dataset | None = None, stability: pd.DataFrame | None = None
) -> Path:
    """Write the report of a run of three cases, of which one failed and one is undecided."""
    run = Run(folder, NAME)
    run.finished(6.0, "growing")
    run.finished(7.0, "failed", ATTACK)
    run.finished(8.0, "undecided", "too short")
    (run.folder / "comparison").mkdir()
    table = run.folder / "comparison" / "critical_speed.csv"
    table.write_text(HEADER + "2d,2.5,39.54321,38,41.5,flutter,7.89,9,1.27,time,,,\n")
    (run.folder / "comparison" / "summary.csv").write_text("a,b\n1,<i>2\n")
    files = None
    if stability_map is not None and stability is not None:
        files = MapFiles(folder / "map.nc", folder / "stability.csv", DESIGN_SPEED)
        write_dataset(files.stability_map, stability_map)
        stability.to_csv(files.stability, index=False)
    page = run.folder / "report.html"
    lacks = write_report(
        page,
        run.folder,
        figures=[
            shown(picture(folder, "growth-rate")),
            shown(picture(folder, "spanwise-loads"), "10"),
            shown(picture(folder, "mode-shapes"), "3", "modes & shapes"),
            shown(picture(folder, "response"), "16"),
        ],
        tables=[shown(run.folder / "comparison" / "summary.csv"), shown(table)],
        map_files=files,
        config_text=f"run: {ATTACK}\n",
    )
    assert not lacks
    return page


def test_colour_of_the_map_changes_at_the_critical_speed(
    stability_map: xr.Dataset, stability: pd.DataFrame
) -> None:
    """What decays is below zero, what grows above, and the line runs between them."""
    section, beam = interactive_map(stability_map, stability, DESIGN_SPEED)["models"]
    known = stability_map.sel(model="2d")
    growth = known["growth_rate"].transpose("speed", "incidence_deg").values
    assert section["figure"]["data"][0]["zmin"] == -section["figure"]["data"][0]["zmax"]
    for column, critical in enumerate(known["critical_speed"].values):
        grows = growth[:, column] > 0.0
        first = int(np.argmax(grows))
        assert grows.any()
        assert known["speed"][first - 1] <= critical <= known["speed"][first]
    words = section["figure"]["data"][0]["text"]
    assert "stable" in words[0][0]
    assert "flutter" in words[first][column]
    assert [one["name"] for one in section["figure"]["data"]][1:] == [
        "critical speed and its interval",
        "interval is open above",
        "design speed",
    ]
    assert [one["name"] for one in beam["figure"]["data"]] == ["critical speed", "design speed"]


@pytest.mark.parametrize(
    ("basis", "words"),
    [
        ("eigenvalue", "The line is the critical speed"),
        ("model", "Markers are the critical speeds of releases by a learnt model"),
    ],
)
def test_map_of_learnt_models_joins_nothing_and_says_what_it_shows(
    stability_map: xr.Dataset,
    stability: pd.DataFrame,
    basis: str,
    words: str,
    tmp_path: Path,
) -> None:
    of_basis = stability_map.assign_attrs(basis=basis)
    section, _ = interactive_map(of_basis, stability, None)["models"]
    assert section["figure"]["data"][1]["mode"] == (
        "markers" if basis == "model" else "lines+markers"
    )
    assert words in written(tmp_path, of_basis, stability).read_text()


@pytest.mark.parametrize(
    "template",
    ["{{ snakemake.config['no'] }}", "A long title\n=====\n", ".. raw:: html\n\n   <b>", "*open"],
)
def test_caption_that_is_not_sound_is_named(template: str) -> None:
    with pytest.raises(CaptionError, match="caption of response: "):
        caption_html(template, {"run": "a"}, {}, "response")


def test_value_in_a_caption_is_text() -> None:
    text = caption_html("Of {{ snakemake.config['run'] }}.", {"run": ATTACK}, {}, "response")
    assert "<script" not in text
    assert "<img" not in text


def test_without_a_map_the_page_has_no_script(tmp_path: Path) -> None:
    text = written(tmp_path).read_text()
    assert "<script" not in text
    assert "script-src" not in text


def test_without_plotly_the_page_says_how_to_get_the_map(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "plotly", None)
    monkeypatch.delitem(sys.modules, "equisection.report.interactive_map", raising=False)
    run = Run(tmp_path)
    page = tmp_path / "report.html"
    (lack,) = write_report(
        page,
        run.folder,
        figures=[],
        tables=[],
        map_files=MapFiles(tmp_path / "map.nc", tmp_path / "stability.csv", None),
        config_text="",
    )
    assert "pip install" in lack
    assert "the package plotly is not there" in page.read_text()
    assert "no answer: " in page.read_text()  # the run has no table of critical speeds


def test_what_cannot_be_read_or_written_is_named(tmp_path: Path) -> None:
    run = Run(tmp_path)
    parts: dict[str, Any] = {"tables": [], "map_files": None, "config_text": ""}
    with pytest.raises(EmbeddingError, match=r"gone\.png: cannot be read"):
        write_report(
            tmp_path / "a.html", run.folder, figures=[shown(tmp_path / "gone.png")], **parts
        )
    (tmp_path / "a-file").touch()
    with pytest.raises(ReportError, match="cannot be written there"):
        write_report(tmp_path / "a-file" / "a.html", run.folder, figures=[], **parts)


def test_words_of_several_lines_stay_in_their_cell(tmp_path: Path) -> None:
    path = tmp_path / "missing.csv"
    reason = "no state\nof it \u2028, two ranks"
    pd.DataFrame({"case": ["k6"], "reason": [reason]}).to_csv(path, index=False)
    assert table_shown(path).lines == (("k6", reason),)


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "model,incidence_deg\n2d,two\n"])
def test_a_broken_table_of_the_map_is_named(tmp_path: Path, text: str) -> None:
    (tmp_path / "stability.csv").write_text(text)
    files = MapFiles(tmp_path / "map.nc", tmp_path / "stability.csv", None)
    with pytest.raises(ReportError, match=r"stability\.csv: no table of a map"):
        write_report(
            tmp_path / "report.html",
            Run(tmp_path).folder,
            figures=[],
            tables=[],
            map_files=files,
            config_text="",
        )


@pytest.fixture(scope="module")
def page(
    tmp_path_factory: pytest.TempPathFactory, stability_map: xr.Dataset, stability: pd.DataFrame
) -> Path:
    return written(tmp_path_factory.mktemp("report"), stability_map, stability)


def test_page_with_its_map_is_light_enough_for_mail(page: Path) -> None:
    assert page.stat().st_size < MOST_BYTES


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chromium]:
    """A browser; where there is none a test is skipped, but not in CI."""
    path = program()
    if path is None and os.environ.get("CI") != "true":
        pytest.skip("no Chromium here; 'make chromium' installs it")
    assert path is not None
    with Chromium(path, tmp_path_factory.mktemp("chromium")) as browser:
        yield browser


def red_less_blue(picture: Path) -> np.ndarray:
    """Return by how much each pixel of a picture is more red than blue, from -1 to 1."""
    pixels = matplotlib.image.imread(picture)
    return np.asarray(pixels[..., 0] - pixels[..., 2])


@pytest.fixture(scope="module")
def wide(page: Path, chromium: Chromium) -> Chromium:
    """The browser with the page in a wide window; before another window is opened."""
    chromium.open(page, 1200, 900, prefers_color_scheme="light")
    return chromium


def test_wide_window_shows_answer_map_and_figures(
    page: Path, wide: Chromium, tmp_path: Path
) -> None:
    chromium = wide
    text = chromium.value("document.body.innerText")
    assert chromium.value("document.title") == f"equisection: {NAME}"
    assert "between 38 m/s (stable) and 41.5 m/s (unstable), at 2.5 deg" in text
    assert "flutter at 7.89 Hz" in text
    assert "1.27 times the design speed" in text
    assert "2 of 3 cases failed, are undecided" in text
    assert ATTACK in text  # the reason of the failed case, as text
    assert "too short" in text
    heads = chromium.value("[...document.querySelectorAll('h1, h2, h3')].map(h => h.innerText)")
    order = [heads.index(one) for one in ("Fig. 16: Response", "Fig. 3: Modes & shapes")]
    order += [heads.index("Fig. 10: Spanwise-loads"), heads.index("Growth-rate")]
    assert order == sorted(order)
    # the model that answers is the one that is drawn, and the other can be chosen
    colours = "document.querySelectorAll('#map .heatmaplayer image').length"
    points = "document.querySelectorAll('#map .scatterlayer .point').length"
    assert chromium.value("document.getElementById('map-model').selectedOptions[0].label") == "2D"
    assert chromium.value(colours) == 1
    known = chromium.value(points)
    chromium.value("document.getElementById('stability').scrollIntoView()")
    seen = red_less_blue(chromium.picture(tmp_path / "wide.png"))
    assert np.mean(seen > 0.2) > 0.05  # it grows at high speeds,
    assert np.mean(seen < -0.03) > 0.05  # and decays at low ones, which are further down
    assert np.argwhere(seen > 0.2)[:, 0].mean() < np.argwhere(seen < -0.03)[:, 0].mean()
    chromium.value("""(() => {
        const choice = document.getElementById("map-model");
        choice.value = 1;
        choice.dispatchEvent(new Event("change"));
    })()""")
    assert chromium.value(colours) == 0
    assert 0 < chromium.value(points) < known  # the design speed alone
    assert "3D" in chromium.value("document.getElementById('map').getAttribute('aria-label')")
    assert chromium.complaints() == []
    assert chromium.requests() == [page.resolve().as_uri()]


def test_figure_that_shows_nothing_is_left_out_with_its_reason(tmp_path: Path) -> None:
    run = Run(tmp_path, NAME)
    run.finished(6.0, "growing")
    empty, full = tmp_path / "response.png", without_data("It has data.")
    save_figure(without_data("The mesh is <not> kept."), [empty])
    full.axes[0].set_label("")
    save_figure(full, [tmp_path / "growth-rate.png"])
    page = run.folder / "report.html"
    figures = [shown(empty), shown(tmp_path / "growth-rate.png")]
    write_report(page, run.folder, figures=figures, tables=[], map_files=None, config_text="")
    text = page.read_text(encoding="utf-8")
    assert text.count("<figure") == text.count("<img") == 1
    assert '<figure id="figure-growth-rate">' in text
    assert '<li id="figure-response">Response. The mesh is &lt;not&gt; kept.</li>' in text


def test_cases_that_tell_nothing_for_one_reason_come_together(tmp_path: Path) -> None:
    run = Run(tmp_path, NAME)
    for k_star in (6.0, 7.0, 8.0):
        run.finished(k_star, "failed", "too unlike" if k_star < 8.0 else "diverges")
    page = run.folder / "report.html"
    write_report(page, run.folder, figures=[], tables=[], map_files=None, config_text="")
    text = page.read_text(encoding="utf-8")
    assert "3 of 3 cases failed" in text
    assert text.count("too unlike") == text.count("diverges") == 1
    assert '<th scope="row">2d k6, k7</th>' in text


def test_buttons_of_the_map_hide_nothing_of_it(wide: Chromium) -> None:
    """Neither the map nor the scale of its colours, whatever the legend has."""
    hidden = """(() => {
        const box = part => document.querySelector(`#map ${part}`).getBoundingClientRect();
        const buttons = box(".modebar");
        return [".heatmaplayer image", ".colorbar .cbfills", ".legend .bg"].filter(part => {
            const one = box(part);
            return one.left < buttons.right && buttons.left < one.right
                && one.top < buttons.bottom && buttons.top < one.bottom;
        });
    })()"""
    wide.value("""(() => {
        const choice = document.getElementById("map-model");
        choice.value = 0;
        choice.dispatchEvent(new Event("change"));
    })()""")
    assert wide.value(hidden) == []


def test_page_is_for_readers_aloud_and_keyboards(wide: Chromium) -> None:
    chromium = wide
    levels = chromium.value(
        "[...document.querySelectorAll('h1, h2, h3')].map(h => Number(h.tagName[1]))"
    )
    assert levels.count(1) == 1
    assert all(below - above <= 1 for above, below in pairwise(levels))
    assert chromium.value("[...document.images].every(image => image.alt)")
    assert chromium.value("[...document.querySelectorAll('th')].every(head => head.scope)")
    links = "[...document.querySelectorAll('nav a')].map(a => a.getAttribute('href'))"
    assert chromium.value(f"{links}.every(id => document.querySelector(id))")
    assert chromium.value("document.querySelector('label[for=map-model]').control.tabIndex") == 0


def test_narrow_dark_window_cuts_nothing_off(
    page: Path, chromium: Chromium, tmp_path: Path
) -> None:
    chromium.open(page, 360, 740, prefers_color_scheme="dark")
    assert chromium.value("document.documentElement.scrollWidth") == 360
    seen = matplotlib.image.imread(chromium.picture(tmp_path / "narrow.png"))
    assert np.median(seen[..., :3]) < 0.2
    assert chromium.value("document.querySelectorAll('#map .main-svg').length") > 0
    assert chromium.complaints() == []
