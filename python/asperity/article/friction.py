"""Sections 4, 5.1, 6.2 and 7 checked: compounds, cut-offs, hysteresis and adhesion."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from asperity.article.compounds import ROOM, T_G, compound
from asperity.article.inputs import ADHESION, MAGNIFICATION, Q0, Inputs
from asperity.article.readings import READINGS
from asperity.article.sliding import CUTOFFS, Sliding
from asperity.article.statement import (
    Statement,
    by_construction,
    judged,
    listed,
    percent,
    unchecked,
)
from asperity.friction import Friction

_Array = NDArray[np.float64]
_POINTS = (1e-5, 1e-3, 1e-1, 1.0)  # m/s, at which numbers are listed
_BOTH = "both cut-offs"
_NO_POINTS = "the measured points of Fig. 15 are not at hand"


def statements(inputs: Inputs, sliding: Sliding) -> list[Statement]:
    """What is said of rubber and of friction, compound B on asphalt at 81 kPa."""
    return [
        *_compounds(),
        _cutoffs(inputs),
        *_hysteresis(sliding),
        *_adhesion(sliding),
        *_experiments(sliding),
    ]


def _compounds() -> list[Statement]:
    temperature = np.arange(-60.0, 61.0)
    steepest = {}
    for name, t_g in T_G.items():
        stiff = [abs(compound(t_g, float(t)).modulus(2 * np.pi)) for t in temperature]
        slope = np.diff(np.log(np.asarray(stiff, dtype=float)))
        steepest[name] = float(temperature[slope.argmin()]) + 0.5 - t_g
    return [
        Statement(
            "M1",
            "Sec. 5.1",
            "the modulus varies most near T_g",
            "the steepest fall of ln |E| with temperature, at 1 Hz, is nearer to T_g than to 20 C",
            ", ".join(f"{name}: at T_g {dt:+.1f} K" for name, dt in steepest.items()),
            by_construction(abs(dt) < (ROOM - T_G[name]) / 2 for name, dt in steepest.items()),
            f"surrogates are made so: WLF places them by their T_g, {listed(T_G.values(), 'g')} C",
        ),
        unchecked(
            "M2",
            "Sec. 5.1, Fig. 5",
            "Fig. 5 shows the master curves of compounds A and B",
            f"the moduli are not published; our Fig. 5 shows surrogates at {ROOM:g} C",
        ),
        unchecked(
            "M3",
            "Sec. 5.1",
            "strains at the surface reach 100 %, so the large-strain modulus is the right one",
            "no strain sweeps of the compounds are at hand; at_strain() does what is described",
        ),
    ]


def _cutoffs(inputs: Inputs) -> Statement:
    surfaces = {"sandpaper": inputs.sandpaper, "asphalt": inputs.asphalt}
    found = {name: surface.cutoff_for_slope(1.3) / Q0 for name, surface in surfaces.items()}
    return Statement(
        "F1",
        "Sec. 4, 5.2",
        f"the spectrum ends where the rms slope reaches 1.3; q1 is {MAGNIFICATION:g} q0 of both",
        f"the rule gives {CUTOFFS[0]} within 10 %",
        "; ".join(
            f"{name}: {found[name]:.3g} q0, rms slope {surface.rms_slope:.3g} at {CUTOFFS[0]}"
            for name, surface in surfaces.items()
        ),
        judged(abs(q / MAGNIFICATION - 1) < 0.1 for q in found.values()),
        "the article does not follow the rule that it cites; F4 to F6 and F9 show what it decides",
    )


def _hysteresis(sliding: Sliding) -> list[Statement]:
    curves = sliding.curves
    with_s = {n: c["gamma 0.5"].hysteresis / c["original"].hysteresis for n, c in curves.items()}
    gamma = {
        n: c["gamma 0.4"].hysteresis / c["gamma 0.5"].hysteresis - 1 for n, c in curves.items()
    }
    ratios = {
        f"{n}, {reading}": c["original"].hysteresis / c[reading].hysteresis
        for n, c in curves.items()
        for reading in READINGS
    }
    total = {
        f"{n}, {reading}": c["original"].mu / c[reading].mu
        for n, c in curves.items()
        for reading in READINGS
    }
    article, rule = (curves[name]["original"].hysteresis for name in CUTOFFS)
    return [
        Statement(
            "F2",
            "Sec. 4",
            "S(q) lowers the hysteresis friction",
            f"below the original at every velocity, {_BOTH}",
            f"{_ranges(with_s)} with gamma 0.5",
            by_construction(bool(np.all(r < 1)) for r in with_s.values()),
            "S <= 1",
        ),
        Statement(
            "F3",
            "Sec. 7",
            "gamma of 0.4 to 0.5 gives slightly different results",
            f"hysteresis within 10 % at every velocity, {_BOTH}",
            "; ".join(f"{n}: {percent(g.min())} to {percent(g.max())}" for n, g in gamma.items())
            + " with 0.4 for 0.5",
            judged(bool(np.all(np.abs(g) < 0.1)) for g in gamma.values()),
            "in light contact the hysteresis is in proportion to gamma",
        ),
        Statement(
            "F4",
            "Sec. 6.2, Fig. 15",
            "the original theory gives more hysteresis than the modified one",
            f"at every velocity from 1e-6 to 10 m/s, both readings, {_BOTH}",
            f"{_ranges(ratios)}; the slope rule's cut-off alone: x {(rule / article).min():.2g} to "
            f"{(rule / article).max():.2g}",
            judged(bool(np.all(r > 1)) for r in ratios.values()),
            "the ratio is near p_T, and above 1 where p_T is; the choice of cut-off weighs as much",
        ),
        Statement(
            "F5",
            "Sec. 6.2, Fig. 15",
            "the original theory gives more friction than the modified one",
            f"mu at every velocity from 1e-6 to 10 m/s, both readings, {_BOTH}",
            "; ".join(
                f"{n}: x {r.min():.3g} to {r.max():.3g}{_less(sliding.velocity, r)}"
                for n, r in total.items()
            ),
            judged(bool(np.all(r > 1)) for r in total.values()),
            "p_T raises the area and with it the adhesion, which the slope rule's cut-off lets "
            "prevail",
        ),
    ]


def _adhesion(sliding: Sliding) -> list[Statement]:
    velocity, curves = sliding.velocity, sliding.curves
    share = {
        f"{n}, {reading}": c[reading].adhesion / c[reading].mu
        for n, c in curves.items()
        for reading in READINGS
    }
    bell = {n: c["implicit"].adhesion / c["implicit"].contact_area for n, c in curves.items()}
    peak = {n: velocity[b.argmax()] for n, b in bell.items()}
    top = {n: velocity[c["implicit"].adhesion.argmax()] for n, c in curves.items()}
    more = {
        f"{n}, {reading}": c[reading].adhesion / c["original"].adhesion
        for n, c in curves.items()
        for reading in READINGS
    }
    step = np.log10(velocity[1] / velocity[0])
    return [
        Statement(
            "F6",
            "Sec. 4, Fig. 15",
            "adhesion adds to the friction at low velocity",
            f"its share of mu falls with velocity at every step, modified, both readings, {_BOTH}",
            "; ".join(
                f"{n}: {', '.join(f'{100 * x:.2g} %' for x in _at(velocity, s))}"
                f"{_rises(velocity, s)}"
                for n, s in share.items()
            )
            + f"; at {listed(_POINTS, 'g')} m/s",
            judged(bool(np.all(np.diff(s) < 0)) for s in share.values()),
            "the area falls with velocity, the hysteresis rises; where adhesion prevails its bell "
            "about v0 shows",
        ),
        Statement(
            "F7",
            "Eq. 23",
            f"the shear stress is largest at v0, {1e3 * ADHESION.reference_velocity:g} mm/s",
            f"mu_A A0 / A is largest within one point of the curve from v0, {_BOTH}",
            "; ".join(
                f"{n}: at {peak[n]:.2g} m/s, mu_A itself is largest at {top[n]:.2g} m/s"
                for n in peak
            ),
            by_construction(
                abs(np.log10(v / ADHESION.reference_velocity)) <= step for v in peak.values()
            ),
            "Eq. 23's bell; its logarithm is read as base 10, which the article does not say; the "
            "area shifts the peak of mu_A down",
        ),
        Statement(
            "F8",
            "Sec. 6.2",
            "a larger contact area gives more adhesion in the modified model",
            f"mu_A above the original at every velocity, both readings, {_BOTH}",
            _ranges(more),
            by_construction(bool(np.all(m > 1)) for m in more.values()),
            "Eq. 23 is in proportion to the area, which every p_T > 1 makes larger",
        ),
    ]


def _experiments(sliding: Sliding) -> list[Statement]:
    dominant = {
        name: _dominant(sliding.velocity, curves["implicit"])
        for name, curves in sliding.curves.items()
    }
    mu = sliding.curves[CUTOFFS[0]]
    return [
        unchecked(
            "F9",
            "Sec. 6.2",
            "hysteresis is the main mechanism in the velocities of the experiment",
            "that range is not printed",
            "; ".join(
                f"{name}: more hysteresis than adhesion above {v:.2g} m/s"
                for name, v in dominant.items()
            ),
        ),
        unchecked(
            "F10",
            "Sec. 6.2, 7, Fig. 15a",
            "the original theory overestimates the measured friction",
            _NO_POINTS,
            f"mu {listed(_at(sliding.velocity, mu['original'].mu))} at {listed(_POINTS, 'g')} m/s",
        ),
        unchecked(
            "F11",
            "Abstract, Sec. 6.2, 7, Fig. 15b",
            "the modified theory agrees with the measured friction, better than the original",
            _NO_POINTS,
            f"mu {listed(_at(sliding.velocity, mu['implicit'].mu))} (implicit), "
            f"{listed(_at(sliding.velocity, mu['added'].mu))} (added) at the same",
        ),
    ]


def _at(velocity: _Array, values: _Array) -> _Array:
    """Values at _POINTS, which are points of the curve."""
    return np.asarray(values[[int(np.abs(velocity - v).argmin()) for v in _POINTS]])


def _dominant(velocity: _Array, curve: Friction) -> float:
    """The velocity above which hysteresis exceeds adhesion."""
    below = np.flatnonzero(curve.hysteresis <= curve.adhesion)
    return float(velocity[0] if below.size == 0 else velocity[below[-1]])


def _ranges(ratios: Mapping[str, _Array]) -> str:
    return "; ".join(f"{n}: x {r.min():.3g} to {r.max():.3g}" for n, r in ratios.items())


def _less(velocity: _Array, ratio: _Array) -> str:
    """Where the ratio is below 1, if anywhere."""
    below = velocity[ratio < 1]
    return f", less below {below.max():.2g} m/s" if below.size else ""


def _rises(velocity: _Array, share: _Array) -> str:
    """Where the share rises with velocity, if anywhere."""
    rising = velocity[1:][np.diff(share) >= 0]
    return f", rising between {rising.min():.2g} and {rising.max():.2g} m/s" if rising.size else ""
