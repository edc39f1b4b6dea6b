"""The bars of what 10 % more is worth."""

import math
from pathlib import Path

import pytest

from asperity.scene.design import design_at_largest
from asperity.scene.scene import scene_of
from helpers.examples import TABLES

charts = pytest.importorskip("asperity.app.charts", reason="the app needs asperity[app]")
LAW = {"wlf_c1": 9.645, "wlf_c2_k": 93.3, "reference_temperature_c": 20.0, "temperature_c": 20.0}


def made(more):
    tables = {**TABLES, "rubber": {**TABLES["rubber"], **more}}
    scene = scene_of(Path("scene"), tables, for_friction=True)
    return design_at_largest(scene, scene.friction().mu)


@pytest.mark.parametrize("more", [{}, LAW])
def test_bars_have_the_worth_of_their_decade(more):
    result = made(more)
    parts = {
        part: [one for one in result.worths if one.part == part] for part in ("storage", "loss")
    }
    chart = charts.worth_chart(parts, "decade")
    names = chart["xAxis"]["data"]
    for series in chart["series"]:
        worths = {f"1e{round(math.log10(w.lower))}": w for w in parts[series["name"]]}
        assert len(series["data"]) == len(names)
        for name, bar in zip(names, series["data"], strict=True):
            decade, _, kelvin = name.partition("\n")
            worth = worths.get(decade)
            assert bar == pytest.approx(worth.mu if worth else 0.0, rel=1e-3)
            assert bool(kelvin) == bool(more)
