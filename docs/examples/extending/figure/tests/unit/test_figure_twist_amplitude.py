"""The figure of the twist's amplitude shows every run that has one."""

import math

import pandas as pd
from matplotlib.text import Text
from tests.conftest import ROOT

from equisection.figures.style import drawing_style
from equisection.figures.twist_amplitude import draw

SUMMARY = pd.DataFrame(
    {
        "model": ["2d", "2d", "2d", "3d"],
        "k_star": [4.0, 5.0, 6.0, 5.0],
        "twist_amplitude_deg": [7.1, math.nan, 0.0, 3.2],
        "solver": "embedded",
        "resolution": "coarse",
    }
)


def test_amplitude_of_each_run_is_at_its_k_star() -> None:
    figure = draw(SUMMARY)
    shown = {line.get_label(): line.get_xydata().tolist() for line in figure.axes[0].lines}
    assert shown == {"2D": [[4.0, 7.1], [6.0, 0.0]], "3D": [[5.0, 3.2]]}
    with drawing_style(ROOT / "envs" / "equisection.mplstyle"):
        figure.draw_without_rendering()


def test_a_sweep_of_failed_runs_says_so() -> None:
    figure = draw(SUMMARY.assign(twist_amplitude_deg=math.nan))
    assert "No run has an amplitude." in {text.get_text() for text in figure.findobj(Text)}
