"""Temperature ramps at a few frequencies, and steps of a test that are no sweep of frequency."""

import numpy as np
from numpy.typing import NDArray

from asperity.base.arguments import Array
from asperity.base.diagnostics import InvalidInput, Note
from asperity.io import plausible
from asperity.io.columns import Columns
from asperity.sweeps import Isotherm

STEP = 1.0  # K: sweeps nearer to each other in temperature are one isotherm
_DRIFT = 4.0  # K: what moves farther without a step is a ramp
_SAME = 0.01  # relative: frequencies no farther apart are one
_FEWEST = 4  # frequencies of an isotherm; between fewer ln E is interpolated over ln w
_APART = 1.0  # K: isotherms of a ramp are not nearer


def without_other_tests(table: Columns) -> Columns:
    """The rows but for blocks of one frequency and one temperature, where others have several."""
    values = table.values
    kept = np.ones(table.block.size, bool)
    for block in np.unique(table.block):
        rows = table.block == block
        hertz, kelvin = values["frequency"][rows], values["temperature"][rows]
        if np.ptp(np.log(hertz)) <= _SAME and np.ptp(kelvin) <= STEP:
            kept[rows] = False
    if kept.all() or not kept.any():
        return table
    left = table.taken(np.flatnonzero(~kept))
    text = f"{left.span()}: {left.block.size} rows at one frequency and temperature were left out"
    plausible.tell_again([Note(text, code="rows-left-out", where=table.path)])
    return table.taken(np.flatnonzero(kept))


def is_ramp(table: Columns) -> bool:
    kelvin = np.sort(table.values["temperature"])
    groups = np.split(kelvin, np.flatnonzero(np.diff(kelvin) > STEP) + 1)
    drift = max(float(np.ptp(group)) for group in groups)
    few = np.unique(_places(table)).size < _FEWEST <= len(groups)
    return drift > _DRIFT or few


def isotherms_of_ramp(table: Columns) -> list[Isotherm]:
    """Isotherms where all frequencies were measured, as far as neighbours have moduli in common."""
    values, place = table.values, _places(table)
    curves = []
    for one in np.unique(place):
        rows = np.flatnonzero(place == one)
        rows = rows[np.argsort(values["temperature"][rows], kind="stable")]
        curves.append(table.taken(rows).values)
    ln_w = np.array([np.median(np.log(curve["frequency"])) for curve in curves])
    if len(curves) < 2:
        hertz = np.exp(ln_w[0]) / (2 * np.pi)
        problem = (
            f"is a temperature ramp at {hertz:.3g} Hz alone, which does not tell how it shifts: "
            "must have two frequencies or more; where a_T is known, "
            "read_master_curve and a scene's master_curve take it with shift"
        )
        raise InvalidInput(problem, code="temperature-ramp", where=table.path)
    low = max(curve["temperature"][0] for curve in curves)
    high = min(curve["temperature"][-1] for curve in curves)
    if not high > low:
        raise InvalidInput("has no temperature with all its frequencies", where=table.path)
    fewest = min(curve["temperature"].size for curve in curves)
    count = int(max(2, min((high - low) / _APART + 1, fewest)))
    parts = 1 if len(curves) >= _FEWEST else -(-_FEWEST // (len(curves) - 1))
    at = np.arange(len(curves)) * parts
    every = np.interp(np.arange(at[-1] + 1), at, ln_w)

    def moduli(name: str, temperature: float) -> Array:
        ln = [np.interp(temperature, one["temperature"], np.log(one[name])) for one in curves]
        return np.asarray(np.exp(np.interp(every, ln_w, ln)))

    isotherms = [
        Isotherm(
            temperature=float(t),
            angular_frequency=np.exp(every),
            storage_modulus=moduli("storage", t),
            loss_modulus=moduli("loss", t),
        )
        for t in np.linspace(low, high, count)
    ]
    return _tied(table, isotherms)


def _tied(table: Columns, isotherms: list[Isotherm]) -> list[Isotherm]:
    """The longest row of isotherms whose neighbours share moduli, as a glass's do not."""
    low, high = (
        np.array([of(one.storage_modulus) for one in isotherms]) for of in (np.min, np.max)
    )
    apart = np.flatnonzero((low[1:] > high[:-1]) | (high[1:] < low[:-1])) + 1
    runs = np.split(np.arange(len(isotherms)), apart)
    kept = max(runs, key=len)
    if len(runs) > 1:
        ends = isotherms[kept[0]].temperature, isotherms[kept[-1]].temperature
        text = (
            f"of a temperature ramp {ends[0]:.5g} to {ends[1]:.5g} K were taken: beyond them "
            "neighbours have no modulus in common"
        )
        plausible.tell_again([Note(text, code="ramp-cut", where=table.path)])
    return [isotherms[one] for one in kept]


def _places(table: Columns) -> NDArray[np.int64]:
    """For each row which of the rising frequencies it has."""
    hertz = table.values["frequency"]
    order = np.argsort(hertz, kind="stable")
    new = np.concatenate([[0], np.diff(np.log(hertz[order])) > _SAME]).astype(np.int64)
    places = np.empty(hertz.size, np.int64)
    places[order] = np.cumsum(new)
    return places
