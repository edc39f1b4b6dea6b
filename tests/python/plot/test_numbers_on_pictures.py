"""Numbers on pictures, computed again from what is drawn."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity
from asperity import fit_prony
from helpers.rubbers import built, sweeps

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5)
RUBBER = asperity.PronySeries(
    equilibrium_modulus=1e6, moduli=[1e7, 1e8], relaxation_times=[1e-3, 1e-5]
)


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


def numbers(label: object) -> list[float]:
    return [float(result) for result in re.findall(r"= (-?[\d.]+(?:e[+-]?\d+)?)", str(label))]


def labelled(axes: Any, start: str) -> Any:
    (line,) = [line for line in axes.lines if str(line.get_label()).startswith(start)]
    return line


def test_wlf_is_the_curve_drawn_and_its_residual_that_of_the_points() -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    from asperity.plot.rubber import draw_shifts

    build = built(sweeps(noise=0.05, seed=1))
    axes = pyplot.figure().subplots()
    draw_shifts(axes, build, build.fit_wlf(), celsius=False)
    curve = labelled(axes, "WLF")
    (points,) = [line for line in axes.lines if line.get_marker() == "o"]
    t, shift = (np.asarray(one) for one in points.get_data())
    t_line, line = (np.asarray(one) for one in curve.get_data())
    stated = float(re.search(r"residual ([\d.e-]+)", curve.get_label())[1])  # type: ignore[index]
    left = shift - np.interp(t, t_line, line)
    assert stated == pytest.approx(np.sqrt(np.mean(left**2)), rel=0.1)
    c1, c2 = numbers(curve.get_label())
    # log10 a_T = -c1 d / (c2 + d): d / log10 a_T is a straight line in d
    d = t_line - build.reference_temperature
    far = np.abs(d) > 1
    slope, start = np.polyfit(d[far], d[far] / line[far], 1)
    assert c1 == pytest.approx(-1 / slope, rel=0.01)
    assert c2 == pytest.approx(start / slope, rel=0.01)
    pyplot.close("all")


def test_hurst_exponent_and_rolloff_are_those_of_the_line_drawn() -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    from asperity.plot.surface import draw_spectrum

    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.7, q0=4e3, q1=1e6, rolloff=1.5e5)
    scan = asperity.synthesize(road, shape=(500, 500), pixel_size=3e-6, seed=4)
    spectrum = asperity.power_spectrum(scan)
    axes = pyplot.figure().subplots()
    draw_spectrum(axes, spectrum, asperity.fit_self_affine(spectrum), None)
    line = labelled(axes, "fit")
    q, density = (np.log(np.asarray(one)) for one in line.get_data())
    slope = np.gradient(density, q)
    (hurst,) = numbers(line.get_label())
    assert hurst == pytest.approx(-slope[-10:].mean() / 2 - 1, abs=1e-3)
    rolloff = float(re.search(r"roll-off ([\d.e+]+)/m", line.get_label())[1])  # type: ignore[index]
    # where the falling line, carried on, reaches the flat one
    bend = q[-1] + (density[0] - density[-1]) / slope[-10:].mean()
    assert np.log(rolloff) == pytest.approx(bend, abs=0.01)
    pyplot.close("all")


def test_the_error_that_a_map_is_certified_for_holds_for_the_colours_drawn(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pytest.importorskip("matplotlib")
    from pathlib import Path

    from asperity.plot import friction_map as module

    box = {"pressure": (5e4, 5e5), "velocity": (1e-3, 1)}
    made = asperity.friction_map(ROAD, RUBBER, **box, rtol=1e-3, checked=2000)

    def errors(pressure: Any, velocity: Any) -> Any:
        exact = asperity.friction(ROAD, RUBBER, pressure=pressure, velocity=velocity).mu
        return np.abs(made.mu(pressure, velocity) / exact - 1)

    figures: list[Any] = []
    monkeypatch.setattr(module, "picture", lambda figure, _: figures.append(figure) or b"")
    module.map_figure(made, errors, Path("map.png"))
    right = figures[0].axes[1]
    result = re.fullmatch(
        r"(\d+) cells, certified: ([\d.e-]+); (\d+) of ([\d,]+) random points beyond",
        right.get_title(),
    )
    assert result is not None
    drawn = np.asarray(right.collections[0].get_array())
    assert drawn.max() <= float(result[2]) * 1.05
    assert (result[1], result[3], result[4]) == (str(made.cells), "0", "2,000")


def test_parameters_of_the_adhesion_are_those_of_the_curve_drawn() -> None:
    """tau_f0 times A/A0 over the pressure at v0, which is where the area's part is divided out."""
    pytest.importorskip("matplotlib")
    from asperity.plot.fit import _parameters

    scene = {"pressure": 1e5, "velocity": np.geomspace(1e-5, 1, 25)}
    truth = asperity.Adhesion(shear_stress=5e6, reference_velocity=2e-3, width=0.12)
    mu = asperity.friction(ROAD, RUBBER, adhesion=truth, **scene).mu
    noise = 1 + 0.02 * np.random.default_rng(1).standard_normal(25)
    fit = asperity.fit_adhesion(ROAD, RUBBER, mu=mu * noise, **scene)
    stress, velocity, width = numbers(_parameters(fit))
    curve = asperity.friction(ROAD, RUBBER, adhesion=fit, **scene)
    strength = np.log(curve.adhesion * 1e5 / curve.contact_area)  # ln tau_f, a parabola in log10 v
    c, b, a = np.polyfit(np.log10(scene["velocity"]), strength, 2)
    assert width == pytest.approx(-c, rel=0.05)
    assert np.log10(velocity * 1e-3) == pytest.approx(-b / (2 * c), abs=0.02)
    assert stress * 1e6 == pytest.approx(np.exp(a - b * b / (4 * c)), rel=0.01)


SCENE = """
surface = {rms_height_m = 1e-4, hurst = 0.8, q0_per_m = 2e3, q1_per_m = 3e4}
rubber = {equilibrium_modulus_pa = 3e6, moduli_pa = [1e8], relaxation_times_s = [1e-4]}
conditions = {pressure_pa = 1e5, velocity_m_s = {from = 1e-6, to = 1, points = 7}}
correction = {kind = "partial-contact"}
adhesion = {shear_stress_pa = 1e6}
"""


def test_the_hatched_band_is_the_model_error_of_the_hysteresis(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib")
    from asperity.plot import friction
    from asperity.scene.scene import load_scene

    drawn: list[Any] = []
    monkeypatch.setattr(friction, "picture", lambda figure, path: drawn.append(figure))
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    scene = load_scene(tmp_path / "scene.toml")
    result = scene.friction()
    assert result.model_error is not None
    known = np.isfinite(result.model_error[0])
    assert known.any()
    friction.friction_figure([scene], [result], tmp_path / "mu.png")
    (axes,) = drawn[0].axes
    hatched = [shape for shape in axes.collections if shape.get_hatch() and shape.get_paths()]
    corners = np.concatenate([path.vertices for path in hatched[0].get_paths()])
    for v, mu, off in zip(
        scene.velocity[known],
        result.mu[0][known],
        (result.model_error * result.hysteresis)[0][known],
        strict=True,
    ):
        here = corners[np.isclose(corners[:, 0], v, rtol=1e-9), 1]
        assert [here.min(), here.max()] == pytest.approx([mu - off, mu + off], rel=1e-9)
    (line,) = [one for one in axes.lines if "numerical" in str(one.get_label())]
    power = int(re.search(r"10\^\{(-\d+)\}", line.get_label())[1])  # type: ignore[index]
    worst = float(np.max(result.error_estimate / result.mu))
    assert 10.0 ** (power - 1) < worst <= 10.0**power
