"""Figs 13 and 14: separation and p_T of the improved Greenwood-Williamson model, both readings."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from asperity._core import GreenwoodWilliamson, PronySeries, contact_area, separation
from asperity.article.inputs import LOADS, PRESSURES, Q0, Inputs, effective_modulus
from asperity.article.statement import Statement, judged, listed, rests_on_tuning, unchecked

_Array = NDArray[np.float64]
FIG13_VELOCITIES = (0.001, 0.01, 0.1, 1.0)  # m/s, the article's
FIG14_PRESSURES = (0.02e6, 0.1e6, 0.3e6, 0.5e6, 0.9e6)  # Pa, ours: its legend is not legible
_SLOW = 1e-9  # m/s
_PRESSURES = np.array(PRESSURES)


@dataclass(frozen=True, eq=False)
class Shifts:
    """d~ [m] and p_T over pressure and velocity; p_T is 1 in full and infinite without contact."""

    pressure: _Array  # [Pa], rows
    velocity: _Array  # [m/s], columns
    effective: _Array
    shift_factor: _Array


@dataclass(frozen=True, eq=False)
class Readings:
    """Fig. 13 and Fig. 14 of either reading, by its name."""

    over_pressure: dict[str, Shifts]
    over_velocity: dict[str, Shifts]


def compute(inputs: Inputs) -> Readings:
    """Both figures' curves, each reading with its own tuned compound and heights."""
    pressure = 1e6 * np.linspace(0.01, 0.9, 90)
    velocity = np.geomspace(1e-4, 10, 51)
    return Readings(
        over_pressure={
            name: shifts(
                inputs, tuned.rubber, tuned.correction, pressure, np.array(FIG13_VELOCITIES)
            )
            for name, tuned in inputs.tuned.items()
        },
        over_velocity={
            name: shifts(
                inputs, tuned.rubber, tuned.correction, np.array(FIG14_PRESSURES), velocity
            )
            for name, tuned in inputs.tuned.items()
        },
    )


def shifts(
    inputs: Inputs,
    rubber: PronySeries,
    igw: GreenwoodWilliamson,
    pressure: _Array,
    velocity: _Array,
) -> Shifts:
    """d~ and p_T2 on the sandpaper, pressures in rows, velocities in columns."""
    z_max, z_min = igw.z_max, igw.z_min
    found = separation(
        pressure=pressure[:, None],
        effective_modulus=[effective_modulus(rubber, v) for v in velocity],
        rms_height=inputs.sandpaper.rms_height,
        q0=Q0,
        reading=igw.reading,
        z_max=z_max,
        z_min=z_min,
    )
    d, state = np.asarray(found.effective), np.asarray(found.state)
    gap = np.where(state == "partial", z_max - d, 1.0)
    factor = np.select(
        [state == "full", state == "no contact"], [1.0, np.inf], (z_max - z_min) / gap
    )
    return Shifts(pressure, velocity, d, factor)


def statements(inputs: Inputs, readings: Readings) -> list[Statement]:
    """What Sections 3.2, 6.1.2 and 7 say of p_T2."""
    return [*_trends(inputs, readings), *_average(inputs)]


def _trends(inputs: Inputs, readings: Readings) -> list[Statement]:
    pressed, faster = readings.over_pressure, readings.over_velocity
    turning = _turning(inputs)
    slow = {
        name: shifts(
            inputs, tuned.rubber, tuned.correction, _PRESSURES, np.array([_SLOW])
        ).shift_factor[:, 0]
        for name, tuned in inputs.tuned.items()
    }
    softest = _full_conformity(inputs)
    return [
        Statement(
            "G4",
            "Sec. 6.1.2, Fig. 13",
            "separation and p_T fall with pressure",
            "at every step to 0.9 MPa, 4 velocities: implicit; added; added to 20 MPa",
            "; ".join(
                f"{name}: largest step of d~ {1e6 * np.diff(s.effective, axis=0).max():.2g} um"
                for name, s in pressed.items()
            )
            + f"; at 0.001 m/s added turns back at {turning / 1e6:.2g} MPa",
            judged(
                [
                    *(_falls(s.effective) and _falls(s.shift_factor) for s in pressed.values()),
                    turning == np.inf,
                ]
            ),
            "the added reading turns back on soft rubber at high load, where it is unphysical",
        ),
        Statement(
            "G5",
            "Sec. 6.1.2, Fig. 14",
            "separation and p_T rise with velocity",
            f"at every step from 1e-4 to 10 m/s, {len(FIG14_PRESSURES)} pressures, both readings",
            "; ".join(
                f"{name}: p_T {s.shift_factor[2, 0]:.2f} to {s.shift_factor[2, -1]:.2f} at 0.3 MPa"
                for name, s in faster.items()
            ),
            judged(_falls(-s.effective.T) and _falls(-s.shift_factor.T) for s in faster.values()),
            "the modulus rises with frequency",
        ),
        _fading(inputs),
        Statement(
            "G7",
            "Sec. 3.2",
            "p_T comes to 1 at very low velocity, where Persson's assumption is exact",
            f"p_T < 1.05 at 1e-9 m/s, at {LOADS} in the implicit reading",
            "; ".join(f"{name}: {listed(values)}" for name, values in slow.items())
            + f"; 1 only below E* = {listed(softest / 1e6)} MPa (implicit)",
            judged(slow["implicit"] < 1.05),
            "a solid rubber keeps its rubbery modulus however slow, and with it p_T > 1",
        ),
        unchecked(
            "G8",
            "Sec. 3.2",
            "IGW is the more accurate the faster and stiffer",
            "needs exact contact mechanics at each modulus",
            _strains(inputs, readings),
        ),
        unchecked(
            "G9",
            "Sec. 3.2",
            "Hertz misses the stress by 2 % and the contact length by 33 % at large strain",
            "cited from finite elements elsewhere, which are not at hand",
        ),
    ]


def _fading(inputs: Inputs) -> Statement:
    tuned, pressure = inputs.tuned["implicit"], np.geomspace(1.0, 0.5e6, 300)
    area = np.asarray(
        contact_area(
            inputs.sandpaper,
            tuned.rubber,
            pressure=pressure,
            velocity=1.0,
            correction=tuned.correction,
        )
    )
    lost, touching = pressure[area == 0], area[area > 0]
    least = pressure[area > 0][touching.argmin()]
    return Statement(
        "G6",
        "Figs 13, 14",
        "as the load falls contact fades out, until there is none where d~ reaches z_max",
        "A/A0 falls with the pressure all the way from 0.5 MPa, at 1 m/s, implicit reading",
        f"A/A0 = {touching[-1]:.2g} at 0.5 MPa, least {touching.min():.2g} at {least:.2g} Pa, then "
        f"up to {touching[: touching.argmin() + 1].max():.2g}; none below {lost.max():.2g} Pa",
        judged(bool(np.all(np.diff(area) >= 0))),
        "p_T goes to infinity at z_max and takes the roughness away: the model has left its range",
    )


def _average(inputs: Inputs) -> list[Statement]:
    pressure, velocity = 1e6 * np.linspace(0.1, 0.5, 9), np.geomspace(1e-3, 1, 13)
    factor = {
        name: shifts(inputs, tuned.rubber, tuned.correction, pressure, velocity).shift_factor
        for name, tuned in inputs.tuned.items()
    }
    return [
        Statement(
            "G10",
            "Sec. 6.1.2",
            "p_T is about two on average, intermediate pressures and a wide range of velocities",
            "mean within 10 % of 2, both readings; 0.1 to 0.5 MPa, 0.001 to 1 m/s (log.)",
            "; ".join(
                f"{n}: {f.mean():.2f}, {f.min():.2f} to {f.max():.2f}" for n, f in factor.items()
            ),
            rests_on_tuning(abs(f.mean() / 2 - 1) < 0.1 for f in factor.values()),
            "met, by compounds tuned so that p_T at 0.1 m/s are the printed ones",
        ),
        Statement(
            "G11",
            "Sec. 7",
            "u_z is about h / 2 on average",
            "mean of 1 / p_T within 10 % of 1/2, both readings, over the same range",
            "; ".join(f"{n}: {(1 / f).mean():.3f}" for n, f in factor.items()),
            rests_on_tuning(abs(2 * (1 / f).mean() - 1) < 0.1 for f in factor.values()),
            "met, by the same compounds, and as an average: see the range of p_T above",
        ),
    ]


def _turning(inputs: Inputs) -> float:
    """Pressure [Pa] at which d~ of the added reading turns upward, to 20 MPa, at 0.001 m/s."""
    tuned, pressure = inputs.tuned["added"], np.geomspace(0.1e6, 20e6, 200)
    slow = np.array(FIG13_VELOCITIES[:1])
    d = shifts(inputs, tuned.rubber, tuned.correction, pressure, slow).effective[:, 0]
    rising = np.diff(d) > 0
    return float(pressure[rising.argmax()]) if rising.any() else np.inf


def _full_conformity(inputs: Inputs) -> _Array:
    """E* [Pa] at which d~ is z_min in the implicit reading, at the three pressures."""
    z_min = inputs.tuned["implicit"].implied.z_min
    low, high = 1e-3, 1.0  # sigma0 / E*, on which alone d~ depends
    while high - low > 1e-9:
        load = (low + high) / 2
        d = separation(
            pressure=load, effective_modulus=1.0, rms_height=inputs.sandpaper.rms_height, q0=Q0
        ).effective
        low, high = (load, high) if d > z_min else (low, load)
    return _PRESSURES / low


def _strains(inputs: Inputs, readings: Readings) -> str:
    """Contact radius over asperity radius, sqrt(depth / R), as a measure of the strain."""
    radius = 1 / (Q0**2 * np.sqrt(2) * inputs.sandpaper.rms_height)
    found = []
    for name, tuned in inputs.tuned.items():
        curves = readings.over_pressure[name]
        row = int(np.abs(curves.pressure - 0.3e6).argmin())
        depth = tuned.implied.z_max - curves.effective[row, [0, -1]]
        found.append(f"{name}: {listed(np.sqrt(depth / radius), '.2f')}")
    return "contact radius / R at 0.001 and 1 m/s, 0.3 MPa: " + "; ".join(found)


def _falls(rows: _Array) -> bool:
    """Whether no row is above the one before; equal where both are infinite or 1."""
    return bool(np.all(rows[1:] <= rows[:-1]))
