"""Section 3.2 checked: Eqs 14 to 21 of the improved Greenwood-Williamson model."""

import numpy as np
from numpy.typing import NDArray

from asperity.article.inputs import LAMBDA0, LOADS, PRESSURES, Q0, VELOCITY, Inputs
from asperity.article.inputs import effective_modulus as modulus_of
from asperity.article.readings import READINGS
from asperity.article.shifts import shifts
from asperity.article.statement import (
    Statement,
    by_construction,
    by_name,
    despite_tuning,
    judged,
    listed,
    percent,
    unchecked,
)
from asperity.asperities import hertz_penetration, separation
from asperity.correction import GreenwoodWilliamson, LocalPeaks, PeaksThenGreenwoodWilliamson
from asperity.friction import friction
from asperity.rubber import effective_modulus

_Array = NDArray[np.float64]


def statements(inputs: Inputs) -> list[Statement]:
    """What Section 3.2 prints, each equation put to a number."""
    return [_hertz(inputs), _stone(inputs), *_model(inputs), *_shift(inputs), _skewed(inputs)]


def _radius(inputs: Inputs) -> float:
    """R of Eq. 18 [m]."""
    return float(1 / (Q0**2 * np.sqrt(2) * inputs.sandpaper.rms_height))


def _hertz(inputs: Inputs) -> Statement:
    radius, stiff, force = _radius(inputs), modulus_of(inputs.compound_a), 0.01

    def pressed(depth: float) -> float:
        return float(4 / 3 * stiff * np.sqrt(radius) * depth**1.5)  # the force of Eq. 16

    printed = pressed((9 * force / (16 * stiff**2 * radius)) ** (1 / 3))
    squared = pressed(hertz_penetration(force=force, effective_modulus=stiff, radius=radius))
    return Statement(
        "E1",
        "Eq. 14",
        "Eq. 14 is Hertz's penetration",
        "put into the force of Eq. 16 it gives F_N = 0.01 N back within 1 %",
        f"{printed:.3g} N as printed, {squared:.3g} N with F_N squared",
        judged(abs(printed / force - 1) < 0.01),
        "the square of F_N is missing, without which the units do not fit",
    )


def _stone(inputs: Inputs) -> Statement:
    rubber = 1e6
    errors = [
        float(effective_modulus(modulus=rubber, poisson_ratio=0.5) / _pair(rubber, ratio) - 1)
        for ratio in (100, 1000)
    ]
    glassy = {
        name: float(abs(rubber.modulus(inputs.sandpaper.q1 * 1.0)))
        for name, rubber in inputs.compounds.items()
    }
    return Statement(
        "E2",
        "Eq. 15",
        "with rubber 2 to 3 decades softer than the substrate, E* is E / (1 - nu^2)",
        "within 2 %, the substrate's Poisson ratio 0.3",
        f"{', '.join(percent(e) for e in errors)} at ratios of 100 and 1000",
        judged(abs(e) < 0.02 for e in errors),
        "at q1 and 1 m/s, though, surrogate A has "
        + ", ".join(f"{modulus / 1e9:.2g} GPa ({name})" for name, modulus in glassy.items()),
    )


def _pair(rubber: float, ratio: float) -> float:
    return float(
        effective_modulus(
            modulus=rubber, poisson_ratio=0.5, modulus_2=ratio * rubber, poisson_ratio_2=0.3
        )
    )


def _model(inputs: Inputs) -> list[Statement]:
    h0, stiff = inputs.sandpaper.rms_height, modulus_of(inputs.compound_a)
    density = Q0**2 / (2 * np.pi**2 * np.sqrt(3)) * LAMBDA0**2 * np.sqrt(3) / 2
    x = 1e-3 * LAMBDA0
    bend = np.sqrt(2) * h0 * (2 * np.cos(Q0 * x) - 2) / x**2  # of sqrt(2) h0 cos(q0 x), at its top
    curvature = -_radius(inputs) * bend
    rms = np.sqrt(np.mean((np.sqrt(2) * h0 * np.cos(2 * np.pi * np.arange(1000) / 1000)) ** 2)) / h0
    implicit = separation(pressure=PRESSURES, effective_modulus=stiff, rms_height=h0, q0=Q0)
    pressed = np.array([_load(inputs, stiff, d) for d in implicit.effective])
    ratios = [density, curvature, rms, *(pressed / PRESSURES)]
    moved = {name: _moved(inputs, modulus_of(rubber)) for name, rubber in inputs.compounds.items()}
    return [
        Statement(
            "E3",
            "Eqs 17, 18, 20",
            "n_a, R and the factor of Eq. 20 follow from lambda0, q0 and h0",
            "n_a both ways; R from the curvature of sqrt(2) h0 cos(q0 x), whose rms height is h0; "
            "Eq. 20 by quadrature at the d~ found: each within 1e-4",
            f"ratios {listed(ratios, '.6f')}",
            judged(abs(ratio - 1) < 1e-4 for ratio in ratios),
            "for one wave; P7 counts the peaks of a rough surface",
        ),
        Statement(
            "E4",
            "Sec. 3.2, Eqs 19-20",
            "interaction of the asperities increases the effective separation",
            "d~ above the plain Greenwood-Williamson separation by more than 1 % of h0: implicit "
            "reading; added reading; E* of A tuned to each and untuned",
            "; ".join(
                f"E* {name}: by "
                + ", ".join(
                    f"{listed(1e6 * d, '.2g')} um {reading}"
                    for reading, d in zip(READINGS, both, strict=True)
                )
                for name, both in moved.items()
            )
            + f" at {LOADS}",
            despite_tuning(
                {name: [bool(np.all(d > 0.01 * h0)) for d in both] for name, both in moved.items()}
            ),
            "solved for d~, Eq. 20 is the plain model's equation again: the interaction cancels",
        ),
    ]


def _moved(inputs: Inputs, stiff: float) -> list[_Array]:
    """How far d~ [m] is above the plain model's, in either reading, at the three pressures."""
    found = [
        separation(
            pressure=PRESSURES,
            effective_modulus=stiff,
            rms_height=inputs.sandpaper.rms_height,
            q0=Q0,
            reading=reading,
        )
        for reading in READINGS
    ]
    return [np.asarray(each.effective) - np.asarray(found[-1].rigid) for each in found]


def _shift(inputs: Inputs) -> list[Statement]:
    scan, h0 = inputs.scans[0], inputs.sandpaper.rms_height
    pressure, velocity = np.array(PRESSURES), np.array([VELOCITY])
    separations = {
        name: shifts(inputs, model, pressure, velocity).effective[:, 0]
        for name, model in inputs.models.items()
    }
    printed = {
        name: np.sqrt(2) * h0 / (separations[name] - model.correction.z_max)
        for name, model in inputs.models.items()
    }
    d = separations["untuned, implicit"]
    factor = (scan.z_max - scan.z_min) / (scan.z_max - d)
    lowest = [float(scan.affine_shift(p).heights.min() - scan.heights.mean()) for p in factor]
    return [
        Statement(
            "E5",
            "Eq. 21",
            "Eq. 21 gives the shift factor, p_T >= 1",
            f"p_T >= 1 at {LOADS}, as printed, both readings, tuned and untuned",
            f"{by_name(printed)}; with its sign turned and twice the amplitude above up to "
            f"{max(-2 * p.min() for p in printed.values()):.3g}",
            despite_tuning({name: p >= 1 for name, p in printed.items()}),
            "negative wherever d~ is below the highest point; its text gives "
            "(z_max - z_min) / (z_max - d~), used here",
        ),
        Statement(
            "E6",
            "Sec. 3.2, 7",
            "the lowest point of the shifted profile is at d~, its height the penetration",
            "within 1e-9 of z_max on a synthetic scan, p_T as the text of Eq. 21 gives it",
            f"{listed([1e6 * z for z in lowest], '.3f')} um against {listed(1e6 * d, '.3f')} um",
            by_construction(abs(z - x) < 1e-9 * scan.z_max for z, x in zip(lowest, d, strict=True)),
            "this is what the formula in use is made of",
        ),
    ]


def _skewed(inputs: Inputs) -> Statement:
    scan = inputs.scans[0]
    peaks = LocalPeaks(scan, min_distance=LAMBDA0)
    found = []
    for reading in READINGS:
        extremes = {"z_max": scan.z_max, "z_min": scan.z_min}
        corrections: dict[str, GreenwoodWilliamson | PeaksThenGreenwoodWilliamson] = {
            "Gaussian": GreenwoodWilliamson(**extremes, reading=reading),
            "peaks in Eq. 20": GreenwoodWilliamson(
                **extremes, peaks=peaks.heights, reading=reading
            ),
            "peaks, then IGW": PeaksThenGreenwoodWilliamson(
                scan, min_distance=LAMBDA0, reading=reading
            ),
        }
        rubber = inputs.tuned[reading].rubber
        factors = [
            friction(
                inputs.sandpaper, rubber, pressure=0.3e6, velocity=VELOCITY, correction=c
            ).shift_factor
            for c in corrections.values()
        ]
        found.append(f"{reading}: {listed(factors)}")
    return unchecked(
        "E7",
        "Sec. 3.1, 3.2, 7",
        "for skewed surfaces local peaks and IGW together are more accurate",
        "accuracy needs the exact contact; the article has no example either",
        f"p_T at 0.3 MPa ({', '.join(corrections)}): " + "; ".join(found),
    )


def _load(inputs: Inputs, stiff: float, d: float) -> float:
    """Right side of Eq. 20 at the separation d [m], by Gauss-Legendre quadrature [Pa]."""
    h0 = inputs.sandpaper.rms_height
    nodes, weights = np.polynomial.legendre.leggauss(400)
    top = np.sqrt(8 * h0 - d if d < 8 * h0 else h0)
    u = top * (1 + nodes) / 2  # z = d + u^2
    z = d + u**2
    density = np.exp(-((z / h0) ** 2) / 2) / (h0 * np.sqrt(2 * np.pi))
    moment = float(np.sum(top / 2 * weights * 2 * u * u**3 * density))
    return float(4 / 3 * stiff * Q0 / (2 * np.pi**2 * np.sqrt(h0 * 3 * np.sqrt(2))) * moment)
