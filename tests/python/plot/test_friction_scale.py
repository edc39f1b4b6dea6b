"""The axis of mu, and what its legend says of bands that cannot be seen."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from asperity.scene.model import Scene, SceneFriction
from asperity.scene.scene import load_scene

SCENE = """
surface = {rms_height_m = 1e-4, hurst = 0.8, q0_per_m = 2e3, q1_per_m = 3e4}
rubber = {equilibrium_modulus_pa = 3e6, moduli_pa = [1e8], relaxation_times_s = [1e-4]}
conditions = {pressure_pa = 1e5, velocity_m_s = {from = 1e-6, to = 1, points = 13}}
correction = {kind = "partial-contact"}
"""


@pytest.fixture
def found(tmp_path: Path) -> tuple[Scene, SceneFriction]:
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    scene = load_scene(tmp_path / "scene.toml")
    return scene, scene.friction()


def drawn(
    found: tuple[list[Scene], list[SceneFriction]], monkeypatch: pytest.MonkeyPatch, **more: Any
) -> Any:
    """The axes of mu of some scenes, with other values in their results."""
    pytest.importorskip("matplotlib")
    from asperity.plot import friction

    figures: list[Any] = []
    monkeypatch.setattr(friction, "picture", lambda figure, path: figures.append(figure))
    friction.friction_figure(found[0], [replace(one, **more) for one in found[1]], Path("mu.png"))
    return figures[0].axes[0]


@pytest.mark.parametrize(("factor", "scale"), [(29, "linear"), (31, "log"), (1 / 31, "log")])
def test_curves_that_are_far_apart_are_drawn_over_decades(
    found: tuple[Scene, SceneFriction], monkeypatch: pytest.MonkeyPatch, factor: float, scale: str
) -> None:
    curves = found[1]
    other = replace(found[0], path=found[0].path.with_name("other.toml"))
    more = replace(curves, mu=factor * curves.mu, hysteresis=factor * curves.hysteresis)
    axes = drawn(([found[0], other], [curves, more]), monkeypatch)
    assert axes.get_yscale() == scale
    low, high = axes.get_ylim()
    assert (low == 0) == (scale == "linear")
    assert low < min(1, factor) * curves.mu.min()
    assert high > max(1, factor) * curves.mu.max()
