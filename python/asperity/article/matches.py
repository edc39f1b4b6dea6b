"""Section 6.1 checked: whether the asperity-based factors match PF-CF, and what areas they give."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from asperity.article.factors import END, GAMMA, PRINTED_P_T1, Factors, by_compound
from asperity.article.inputs import LOADS, Inputs
from asperity.article.readings import PRINTED, READINGS
from asperity.article.statement import (
    Statement,
    by_construction,
    by_name,
    despite_tuning,
    listed,
    percent,
    rests_on_tuning,
    unchecked,
)

_Array = NDArray[np.float64]


def statements(inputs: Inputs, factors: Mapping[str, Factors]) -> list[Statement]:
    """What Section 6.1 and the conclusions say of matches, penetration and areas."""
    return [
        *_local(by_compound(factors)),
        *_improved(factors),
        *_penetration(inputs, factors),
        *_larger(factors),
    ]


def _local(factors: Mapping[str, Factors]) -> list[Statement]:
    wide, narrow = (
        {name: f.local[p] / f.persson - 1 for name, f in factors.items()} for p in PRINTED_P_T1
    )
    met = {name: [_met(f.zeta, row, 0.05) for row in narrow[name]] for name, f in factors.items()}
    return [
        Statement(
            "C6",
            "Fig. 8",
            f"with p_T1 = {PRINTED_P_T1[0]:g} LP-CF does not match PF-CF",
            f"it differs by more than 5 % at {END}, three pressures, tuned and untuned",
            "; ".join(
                f"{name}: {percent(x[0, -1])} at {END}, {percent(x[0, 0])} at q0"
                for name, x in wide.items()
            ),
            despite_tuning({n: bool(np.all(np.abs(x[:, -1]) > 0.05)) for n, x in wide.items()}),
            "in light contact LP-CF / PF-CF = 1 / (p_T gamma) whatever the surface and the rubber",
        ),
        Statement(
            "C7",
            "Sec. 6.1.1, Fig. 9",
            f"with p_T1 = {PRINTED_P_T1[1]:g} LP-CF matches PF-CF perfectly",
            f"within 5 % at {END}; within 5 % at all magnifications; tuned and untuned",
            "; ".join(
                f"{name}: {_largest(x[:, -1])} at {END}, at most {_largest(x)}, within 5 % from "
                f"{listed(met[name], '.4g')} q0 on"
                for name, x in narrow.items()
            )
            + f" at {LOADS}",
            despite_tuning(
                {
                    name: [bool(np.abs(x[:, -1]).max() < 0.05), bool(np.abs(x).max() < 0.05)]
                    for name, x in narrow.items()
                }
            ),
            "p_T = 1 / gamma matches in light contact always, so the match tells nothing of peaks; "
            "near full contact CF is 1 / p_T^2 in place of 1",
        ),
    ]


def _improved(factors: Mapping[str, Factors]) -> list[Statement]:
    ratio = {name: (f.improved / f.area)[:, -1] for name, f in factors.items()}
    igw = {name: (f.improved / f.persson)[:, -1] - 1 for name, f in factors.items()}
    near = [np.abs(igw[reading]) for reading in READINGS]
    return [
        Statement(
            "C8",
            "Sec. 6.1",
            "A_m C_m / (A C) comes to a value like that of S",
            f"within 10 % of S = {GAMMA} at {END}, each pressure, tuned and untuned",
            "; ".join(
                f"{name}: {listed(x)} at p_T = {listed(factors[name].shift_factor)}"
                for name, x in ratio.items()
            ),
            despite_tuning({name: np.abs(x / GAMMA - 1) < 0.1 for name, x in ratio.items()}),
            "it comes to 1 / p_T",
        ),
        Statement(
            "C9",
            "Sec. 6.1.2, Fig. 11",
            "IGW-CF is similar to PF-CF at 0.3 and 0.5 MPa, less so at 0.1 MPa",
            f"within 10 % at {END} at 0.3 and 0.5 MPa, farther off at 0.1 MPa; both readings, "
            "tuned",
            "; ".join(f"{n}: {', '.join(percent(v) for v in x)}" for n, x in igw.items())
            + f" at {LOADS}",
            rests_on_tuning(
                test for x in near for test in (bool(np.all(x[1:] < 0.1)), bool(x[0] > x[1:].max()))
            ),
            "in light contact IGW-CF / PF-CF = 1 / (p_T gamma), and p_T is tuned to those printed",
        ),
    ]


def _penetration(inputs: Inputs, factors: Mapping[str, Factors]) -> list[Statement]:
    depth = {
        name: (model.correction.z_max - model.correction.z_min) / factors[name].shift_factor
        for name, model in inputs.models.items()
    }
    printed = np.array(list(PRINTED.values()))
    return [
        Statement(
            "C10",
            "Sec. 6.1.2",
            f"{printed[1]:g} and {printed[2]:g} are close to the constant p_T1 of about 2",
            "within 10 %",
            f"{', '.join(percent(x / 2 - 1) for x in printed[1:])}; {printed[0]:g}: "
            f"{percent(printed[0] / 2 - 1)}",
            by_construction(np.abs(printed[1:] / 2 - 1) < 0.1),
            "printed numbers beside one another: nothing is computed",
        ),
        Statement(
            "C11",
            "Sec. 6.1.2, 7",
            "at 0.1 MPa IGW predicts a smaller penetration than at higher pressures",
            "z_max - d~ less at 0.1 MPa than at 0.3 and 0.5 MPa, both readings, tuned",
            by_name({name: 1e6 * x for name, x in depth.items()}, ".0f") + f" um at {LOADS}",
            rests_on_tuning(
                bool(depth[reading][0] < depth[reading][1:].min()) for reading in READINGS
            ),
            "penetration is (z_max - z_min) / p_T, and p_T is tuned",
        ),
        unchecked(
            "C12",
            "Sec. 6.1, 7",
            "both asperity-based factors agree with molecular dynamics",
            f"they are compared with S at gamma = {GAMMA}, a fit to the elastic energy of "
            "simulations, not with a simulation of these surfaces: see `asperity validate`",
        ),
    ]


def _larger(factors: Mapping[str, Factors]) -> list[Statement]:
    shift, compounds = PRINTED_P_T1[1], by_compound(factors)
    local = {name: f.local_area[shift] / f.area for name, f in compounds.items()}
    partial = {name: x[compounds[name].area < 1] for name, x in local.items()}
    igw = {name: f.improved_area / f.area for name, f in factors.items()}
    gain = {name: (f.improved_area - f.area)[:, -1] for name, f in factors.items()}
    return [
        Statement(
            "C13",
            "Sec. 6.1.1, Fig. 10",
            "with the local peaks the real contact area is larger",
            "at every magnification with partial contact, three pressures, tuned and untuned",
            "; ".join(
                f"{name}: x {listed(local[name][:, -1], '.4g')} at {END}, least x {x.min():.4g}"
                for name, x in partial.items()
            ),
            by_construction(bool(np.all(x > 1)) for x in partial.values()),
            f"p_T1 = {shift:g} divides G by its square, in light contact the area grows by p_T; no "
            "check of its truth",
        ),
        Statement(
            "C14",
            "Sec. 6.1.2, Fig. 12",
            "with IGW the area is larger, by far the most at low pressure",
            "larger at every magnification with partial contact; the ratio falls with pressure; "
            "both readings, tuned",
            "; ".join(
                f"{name}: x {listed(x[:, -1], '.4g')}, A/A0 up by {listed(gain[name], '.2g')}"
                for name, x in igw.items()
            )
            + f" at {LOADS}, {END}",
            rests_on_tuning(
                test
                for name in READINGS
                for test in (
                    bool(np.all(igw[name][factors[name].area < 1] > 1)),
                    bool(np.all(np.diff(igw[name][:, -1]) < 0)),
                )
            ),
            "in light contact the ratio is p_T, which is tuned",
        ),
    ]


def _met(zeta: _Array, difference: _Array, tolerance: float) -> float:
    """The magnification from which on the difference stays within the tolerance."""
    beyond = np.flatnonzero(np.abs(difference) > tolerance)
    return float(zeta[0] if beyond.size == 0 else zeta[min(beyond[-1] + 1, zeta.size - 1)])


def _largest(difference: _Array) -> str:
    """That which is farthest from 0."""
    return percent(float(difference.flat[np.abs(difference).argmax()]))
