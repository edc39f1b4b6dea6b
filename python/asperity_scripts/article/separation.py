"""d~ and p_T2 of Sections 3.2, 6.1.2 and 7 checked; Figs 13 and 14."""

from collections import defaultdict
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.asperities import separation
from asperity.contact import contact_area
from asperity.draw.figure import new_figure
from asperity.draw.style import grey, palette
from asperity_scripts.article.inputs import PRESSURES, Q0, Inputs, Model, effective_modulus
from asperity_scripts.article.page import page, panel, sandpaper_inputs, stacked, tuned_inputs
from asperity_scripts.article.readings import Array
from asperity_scripts.article.statement import Finding, Findings

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_FIG13 = 1e6 * np.linspace(0.01, 0.9, 90), np.array([0.001, 0.01, 0.1, 1.0])  # Pa, m/s
# The article's legend of Fig. 14 is not legible: these pressures are ours.
_FIG14 = 1e6 * np.array([0.02, 0.1, 0.3, 0.5, 0.9]), np.geomspace(1e-4, 10, 51)
_AVERAGE = 1e6 * np.linspace(0.1, 0.5, 9), np.geomspace(1e-3, 1, 13)
_FOLLOWED = np.geomspace(0.1e6, 20e6, 200), np.array([0.001])
_FADING = np.geomspace(1e-4, 0.5e6, 500)
_SLOW = np.array(PRESSURES), np.array([1e-9])


def shifts(model: Model, pressure: Array, velocity: Array) -> tuple[Array, Array]:
    """d~ [m] and p_T2, pressures in rows; p_T2 is 1 in full and infinite without contact."""
    igw = model.correction
    result = separation(
        pressure=pressure[:, None],
        effective_modulus=[effective_modulus(model.rubber, v) for v in velocity],
        rms_height=model.surface.rms_height,
        q0=model.surface.q0,
        reading=igw.reading,
        z_max=igw.z_max,
        z_min=igw.z_min,
    )
    d, state = np.asarray(result.effective), np.asarray(result.state)
    gap = np.where(state == "partial", igw.z_max - d, 1.0)
    known = [state == "full", state == "no contact"]
    return d, np.select(known, [1.0, np.inf], (igw.z_max - igw.z_min) / gap)


def eq20(h0: float, d: float) -> float:
    """sigma0 / E* of Eq. 20, its right side over E*, by Gauss-Legendre quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    top = np.sqrt(8 * h0 - d if d < 8 * h0 else h0)
    u = top * (1 + nodes) / 2  # z = d + u^2
    density = np.exp(-(((d + u**2) / h0) ** 2) / 2) / (h0 * np.sqrt(2 * np.pi))
    moment = float(np.sum(top / 2 * weights * 2 * u * u**3 * density))
    return float(4 / 3 * Q0 / (2 * np.pi**2 * np.sqrt(h0 * 3 * np.sqrt(2))) * moment)


def findings(inputs: Inputs) -> Findings:
    """Trends of d~ and p_T2, their limits and their averages."""
    findings: dict[str, dict[str, Finding]] = defaultdict(dict)
    for name, model in inputs.models.items():
        d, p = shifts(model, *_FIG13)
        turns = np.diff(shifts(model, *_FOLLOWED)[0][:, 0]) > 0
        until = _FOLLOWED[0][turns.argmax()] if turns.any() else _FOLLOWED[0][-1]
        held, step = (_falls(d) and _falls(p), not turns.any()), np.diff(d, axis=0).max()
        findings["G4"][name] = Finding(held, step=1e6 * step, until=until / 1e6)
        d, p = shifts(model, *_FIG14)
        findings["G5"][name] = Finding(_falls(-d.T) and _falls(-p.T), p=p[2])
        area = contact_area(
            model.surface,
            model.rubber,
            pressure=_FADING,
            velocity=1.0,
            correction=model.correction,
        )
        touching, at = area[area > 0], _FADING[area > 0]
        least = int(touching.argmin())
        findings["G6"][name] = Finding(
            _falls(-area),
            least=touching[least],
            at=at[least],
            top=touching[: least + 1].max(),
            lightest=at[0],
        )
        p = shifts(model, *_SLOW)[1][:, 0]
        findings["G7"][name] = Finding(p < 1.05, p=p)
        p = shifts(model, *_AVERAGE)[1].ravel()
        findings["G10"][name] = Finding(abs(p.mean() / 2 - 1) < 0.1, mean=p.mean(), p=p)
        findings["G11"][name] = Finding(abs(2 * (1 / p).mean() - 1) < 0.1, mean=(1 / p).mean())
    full = eq20(inputs.sandpaper.rms_height, inputs.tuned["implicit"].implied.z_min)
    findings["G7"][""] = Finding(softest=np.array(PRESSURES) / full / 1e6)  # where d~ is z_min
    return findings


def fig13(inputs: Inputs) -> dict[str, bytes]:
    """d~ and p_T over pressure, a colour a velocity."""
    axis = {"xlabel": r"Nominal pressure $\sigma_0$ [MPa]", "xlim": (0, _FIG13[0][-1] / 1e6)}
    return _figure("fig13", inputs, *_FIG13, axis)


def fig14(inputs: Inputs) -> dict[str, bytes]:
    """d~ and p_T over velocity, a colour a pressure."""
    ends = _FIG14[1][0], _FIG14[1][-1]
    axis = {"xlabel": "Sliding velocity $v$ [m/s]", "xscale": "log", "xlim": ends}
    return _figure("fig14", inputs, *_FIG14, axis)


def _figure(
    name: str, inputs: Inputs, pressure: Array, velocity: Array, axis: dict[str, Any]
) -> dict[str, bytes]:
    """A row a reading, over the longer of `pressure` and `velocity`."""
    figure, panels = new_figure(4)
    curves, facts = [], sandpaper_inputs(inputs)
    for k, (reading, tuned) in enumerate(inputs.tuned.items()):
        pair = shifts(tuned, pressure, velocity)
        left, right = panels[2 * k : 2 * k + 2]
        if pressure.size > velocity.size:
            x, labels, place = pressure / 1e6, [f"{v:g} m/s" for v in velocity], "upper right"
            rows = zip(*(values.T for values in pair), labels, palette(), strict=False)
        else:
            x, labels, place = velocity, [f"{p / 1e6:g} MPa" for p in pressure], "upper left"
            rows = zip(*pair, labels, palette(), strict=False)
        for d, p, label, colour in rows:
            left.plot(x, 1e3 * d, color=colour, label=label)
            right.plot(x, np.where(np.isfinite(p), p, np.nan), color=colour, label=label)
        stiff = f"$E^*$ = {tuned.implied.effective_modulus / 1e6:.3g} MPa at 0.1 m/s"
        titles = [f"({mark}) {reading} reading, {stiff}" for mark in "abcd"[2 * k : 2 * k + 2]]
        _limits(left, 1e3 * tuned.implied.z_max, 1e3 * tuned.implied.z_min)
        panel(left, titles[0], ylabel=r"Separation $\tilde{d}$ [mm]", **axis)
        shift = {"ylabel": "Shift factor $p_T$ [-]", "ylim": (0.9, 5)}
        panel(right, titles[1], place, **shift, **axis)
        points = {
            "pressure_pa": np.repeat(pressure, velocity.size),
            "velocity_m_s": np.tile(velocity, pressure.size),
        }
        values = {"separation_m": pair[0].ravel(), "shift_factor": pair[1].ravel()}
        curves.append({"reading": reading, **points, **values})
        facts[reading] = tuned_inputs(tuned)
    return page(name, figure, facts, stacked(curves))


def _limits(axes: "Axes", z_max: float, z_min: float) -> None:
    """Where there is no contact, and where it is full [mm]."""
    small: dict[str, Any] = {"va": "top", "fontsize": "small"}
    axes.set_ylim(-0.58, 0.38)
    axes.axhspan(z_max, 0.38, color=grey(0.88), linewidth=0)
    axes.text(0.03, 0.965, "no contact", transform=axes.transAxes, **small)
    axes.axhline(z_min, color=grey(0.4), linestyle=":", linewidth=1)
    text, place = r"full contact below $z_{\mathrm{min}}$", axes.get_yaxis_transform()
    axes.text(0.97, z_min - 0.01, text, transform=place, ha="right", **small)


def _falls(rows: Array) -> bool:
    """Whether no row is above the one before; equal where both are infinite or 1."""
    return bool(np.all(rows[1:] <= rows[:-1]))
