"""Pictures of heat: what they draw is what is computed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from asperity.cli.main import main
from asperity.scene.scene import load_scene
from helpers import scenes
from helpers.scenes import HEATING, LAW


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    pytest.importorskip("matplotlib")
    drawn: list[Any] = []
    monkeypatch.setattr(
        "asperity.plot.friction.picture", lambda figure, path: drawn.append(figure) or b"picture"
    )
    return drawn


def draw(folder: Path, temperatures: str, velocity: str, more: str = HEATING) -> Any:
    conditions = (
        f"\n[conditions]\npressure_pa = [1e5, 3e5]\nvelocity_m_s = {velocity}\n"
        f"temperature_k = {temperatures}\n"
    )
    text = scenes.SURFACE + scenes.RUBBER + LAW + conditions + more
    (folder / "hot.toml").write_text(text)
    assert main(["friction", "hot.toml", "--output", "hot.csv", "--plot", "hot.png"]) == 0
    lines = (folder / "hot.csv").read_text().splitlines()
    names, *rows = (line.split(",") for line in lines if not line.startswith("#"))
    return dict(zip(names, np.array(rows, float).T, strict=True))


def shown(axes: Any) -> list[Any]:
    return [line for line in axes.lines if len(line.get_xdata())]


def test_over_velocity_there_is_mu_with_its_rise_and_that_of_each_roughness(
    folder: Path, figures: list[Any]
) -> None:
    table = draw(folder, "290", "{from = 1e-3, to = 10, points = 7}")
    mu, rise, profile = figures[0].axes
    hot, cold = shown(mu)[:2]
    np.testing.assert_array_equal(hot.get_ydata(), table["mu"][:7])
    np.testing.assert_array_equal(cold.get_ydata(), table["mu_cold"][:7])
    for line, start in zip(shown(rise), (0, 7), strict=True):
        expected = table["hot_temperature_k"][start : start + 7] - 290
        np.testing.assert_allclose(line.get_ydata(), expected, rtol=1e-12)
    fastest, *_, slowest = shown(profile)
    assert fastest.get_label() == "10 m/s"
    assert slowest.get_label() == "0.001 m/s"
    assert fastest.get_ydata()[-1] == pytest.approx(table["hot_temperature_k"][6] - 290, rel=1e-3)
    assert slowest.get_ydata()[-1] == pytest.approx(table["hot_temperature_k"][0] - 290, rel=1e-3)
    scene = load_scene("hot.toml", for_friction=True)
    assert fastest.get_xdata()[[0, -1]] == pytest.approx([scene.spectrum.q0, scene.spectrum.q1])
    names = [text.get_text() for text in mu.get_legend().get_texts()]
    assert {"100 kPa", "300 kPa", "without heat"} <= {*names}


@pytest.mark.parametrize("more", ["", HEATING])
def test_a_list_of_temperatures_at_one_velocity_is_drawn_over_them(
    folder: Path, figures: list[Any], more: str
) -> None:
    table = draw(folder, "[310, 280, 295]", "1.0", more)
    mu, *rest = figures[-1].axes
    assert len(rest) == (1 if more else 0)
    assert mu.get_xlabel().startswith("Temperature")
    assert mu.get_xscale() == "linear"
    low = table["pressure_pa"] == 1e5
    order = np.argsort(table["temperature_k"][low])
    line = shown(mu)[0]
    assert line.get_xdata().tolist() == [280.0, 295.0, 310.0]
    np.testing.assert_array_equal(line.get_ydata(), table["mu"][low][order])
    assert line.get_label() == "100 kPa, 1 m/s"
    if more:
        risen = (table["hot_temperature_k"] - table["temperature_k"])[low][order]
        np.testing.assert_allclose(shown(rest[0])[0].get_ydata(), risen, rtol=1e-12)
