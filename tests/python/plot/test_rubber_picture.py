"""Numbers on the rubber's picture, computed again from what is drawn."""

import re

import numpy as np
import pytest

from asperity import fit_prony
from helpers.rubbers import built, sweeps


def test_residuals_are_those_of_the_points_drawn() -> None:
    """A fit through the smoothed curve can be ten times nearer to it than the points are."""
    pyplot = pytest.importorskip("matplotlib.pyplot")
    from asperity.plot.rubber import _draw_residual

    build = built(sweeps(noise=0.05, seed=1))
    axes = pyplot.figure().subplots()
    _draw_residual(axes, build, fit_prony(build))
    lines = [line for line in axes.lines if "rms" in str(line.get_label())]
    assert len(lines) == 2
    for line in lines:
        stated = float(re.search(r"rms ([\d.]+) %", line.get_label())[1])  # type: ignore[index]
        drawn = np.sqrt(np.mean(np.asarray(line.get_ydata()) ** 2))
        assert stated == pytest.approx(drawn, rel=0.05)
    pyplot.close("all")
