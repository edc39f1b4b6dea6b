"""Section 6.1 checked: correction factors of Figs 8 to 12, Eq. 8 and gamma."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from asperity.article.inputs import (
    LOADS,
    MAGNIFICATION,
    PRESSURES,
    Q0,
    UNTUNED,
    VELOCITY,
    Inputs,
    Model,
    magnifications,
)
from asperity.article.persson import areas
from asperity.article.shifts import shifts
from asperity.article.statement import (
    Statement,
    by_construction,
    by_name,
    despite_tuning,
    percent,
)
from asperity.contact import correction_factor
from asperity.correction import AffineShift, Correction, SFactor
from asperity.rubber import PronySeries

_Array = NDArray[np.float64]
GAMMA = 0.5
PRINTED_P_T1 = (2.5, 2.0)  # Figs 8 and 9
END = f"{MAGNIFICATION:g} q0"


@dataclass(frozen=True, eq=False)
class Factors:
    """A/A0 and correction factors at the three pressures (rows) over magnification, 0.1 m/s."""

    zeta: _Array
    area: _Array  # without correction
    persson: _Array  # PF-CF = S A / A0
    local: dict[float, _Array]  # LP-CF by p_T1
    local_area: dict[float, _Array]
    improved: _Array  # IGW-CF
    improved_area: _Array
    shift_factor: _Array  # p_T of IGW


def compute(inputs: Inputs) -> dict[str, Factors]:
    """All of them on the sandpaper, by the names of `Inputs.models`."""
    return {name: _factors(inputs, model) for name, model in inputs.models.items()}


def _factors(inputs: Inputs, model: Model) -> Factors:
    zeta, rubber, igw = magnifications(300), model.rubber, model.correction
    local = {p: AffineShift(p) for p in PRINTED_P_T1}
    return Factors(
        zeta=zeta,
        area=areas(inputs, rubber, zeta),
        persson=cf(inputs, rubber, zeta, SFactor(gamma=GAMMA)),
        local={p: cf(inputs, rubber, zeta, shift) for p, shift in local.items()},
        local_area={p: areas(inputs, rubber, zeta, shift) for p, shift in local.items()},
        improved=cf(inputs, rubber, zeta, igw),
        improved_area=areas(inputs, rubber, zeta, igw),
        shift_factor=shifts(inputs, model, np.array(PRESSURES), np.array([VELOCITY])).shift_factor[
            :, 0
        ],
    )


def cf(inputs: Inputs, rubber: PronySeries, zeta: _Array, correction: Correction) -> _Array:
    """CF at the three pressures (rows) and at magnifications."""
    return np.asarray(
        correction_factor(
            inputs.sandpaper,
            rubber,
            pressure=PRESSURES,
            velocity=VELOCITY,
            correction=correction,
            wavenumber=zeta * Q0,
        )
    )


def by_compound(factors: Mapping[str, Factors]) -> dict[str, Factors]:
    """By the names of `Inputs.compounds`, for what does not depend on IGW."""
    tuned = {name: f for name, f in factors.items() if not name.startswith(UNTUNED)}
    return {**tuned, UNTUNED: factors[f"{UNTUNED}, implicit"]}


def statements(inputs: Inputs, factors: Mapping[str, Factors]) -> list[Statement]:
    """What is said of S(q), of gamma, and of factors where contact is complete."""
    compounds = by_compound(factors)
    s = {name: (f.persson / f.area)[f.area < 1] for name, f in compounds.items()}
    within = {name: _within(f) for name, f in compounds.items()}
    soon = MAGNIFICATION**0.1
    at_end = {name: f.area[:, -1] for name, f in compounds.items()}
    low = {
        name: cf(inputs, rubber, compounds[name].zeta[-1:], SFactor(gamma=0.4))[:, 0]
        / compounds[name].persson[:, -1]
        - 1
        for name, rubber in inputs.compounds.items()
    }
    return [
        Statement(
            "C1",
            "Sec. 2, below Eq. 8",
            "S(q) corrects Eq. 7 when multiplied with it",
            "S A > A wherever contact is partial, since the area is said to be too small; tuned "
            "and untuned",
            "S A / A: "
            + "; ".join(f"{name}: {x.min():.3g} to {x.max():.3g}" for name, x in s.items()),
            despite_tuning({name: bool(np.all(x > 1)) for name, x in s.items()}),
            "S <= 1 makes the area smaller still; it belongs to the integrand of Eq. 22",
        ),
        Statement(
            "C2",
            "Sec. 6.1",
            "S(q) comes to gamma very rapidly",
            f"within 1 % of gamma = {GAMMA} in the first tenth of ln(q / q0), up to {soon:.3g} q0, "
            f"at {LOADS}; tuned and untuned",
            f"within 1 % from q / q0 on: {by_name(within)}",
            despite_tuning({name: max(found) < soon for name, found in within.items()}),
            "S - gamma = (1 - gamma)(A/A0)^2: the stiffer the rubber the sooner, and how stiff A "
            "is was tuned",
        ),
        Statement(
            "C3",
            "Sec. 6.1",
            "PF-CF = S A/A0 is not S",
            f"PF-CF / S < 0.01 at {END}, tuned and untuned",
            f"PF-CF / S = A/A0 = {by_name(at_end)}",
            by_construction(bool(np.all(a < 0.01)) for a in at_end.values()),
            "by definition",
        ),
        _complete(inputs),
        Statement(
            "C5",
            "Sec. 7",
            "gamma of 0.4 to 0.5 gives slightly different results",
            f"PF-CF differs by less than 10 % at {END}, tuned and untuned",
            "; ".join(f"{n}: {', '.join(percent(v) for v in x)}" for n, x in low.items())
            + " with 0.4 for 0.5",
            despite_tuning({n: bool(np.abs(x).max() < 0.1) for n, x in low.items()}),
            "in light contact the factor is gamma itself; see F3 for the friction",
        ),
    ]


def _within(f: Factors) -> list[float]:
    """q / q0 from which S is within 1 % of gamma, at the three pressures."""
    return [float(f.zeta[np.argmax(row < 1.01 * GAMMA)]) for row in f.persson / f.area]


def _complete(inputs: Inputs) -> Statement:
    found, held = [], {}
    for name, model in inputs.models.items():
        corrections: dict[str, Correction] = {
            "PF-CF": SFactor(gamma=GAMMA),
            "IGW-CF": model.correction,
            "LP-CF (p_T = 2)": AffineShift(2.0),
        }
        values = {
            which: float(
                correction_factor(
                    inputs.sandpaper,
                    model.rubber,
                    pressure=1e12,
                    velocity=VELOCITY,
                    correction=correction,
                    wavenumber=inputs.sandpaper.q1,
                )
            )
            for which, correction in corrections.items()
        }
        held[name] = [value > 0.99 for value in values.values()]
        found.append(f"{name}: {', '.join(f'{w} {value:.3g}' for w, value in values.items())}")
    return Statement(
        "C4",
        "Sec. 2, 3.2",
        "in complete contact u_z = h is exact; then no correction must be left",
        "CF > 0.99 at sigma0 = 1000 GPa, where A/A0 = 1, for PF, IGW and local peaks; tuned and "
        "untuned",
        "; ".join(found),
        despite_tuning(held),
        "a constant p_T leaves CF at 1 / p_T^2 however complete the contact; the added reading "
        "turns back with the load (G4), at last to no contact and CF 0",
    )
