"""Temperature ramps at a few frequencies, and steps of a test that are no sweep of frequency."""

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base.diagnostics import Note
from asperity.io import plausible
from asperity.io.columns import Columns
from asperity.sweeps import Isotherm

STEP = 1.0  # K: sweeps nearer to each other in temperature are one isotherm
_DRIFT = 4.0  # K: what moves farther without a step is a ramp
_SAME = 0.01  # relative: frequencies no farther apart are one
_FEWEST = 4  # frequencies of an isotherm
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
    """Whether the temperature moves on without steps."""
    kelvin = np.sort(table.values["temperature"])
    groups = np.split(kelvin, np.flatnonzero(np.diff(kelvin) > STEP) + 1)
    drift = max(float(np.ptp(group)) for group in groups)
    few = np.unique(_places(table)).size < _FEWEST <= len(groups)
    return drift > _DRIFT or few


def isotherms_of_ramp(table: Columns) -> list[Isotherm]:
    """Isotherms where all frequencies were measured; InvalidInput where these are too few."""
    values, place = table.values, _places(table)
    curves = []
    for one in np.unique(place):
        rows = np.flatnonzero(place == one)
        rows = rows[np.argsort(values["temperature"][rows], kind="stable")]
        curves.append(table.taken(rows).values)
    hertz = [float(np.median(curve["frequency"])) / (2 * np.pi) for curve in curves]
    if len(curves) < _FEWEST:
        named = ", ".join(f"{one:.3g}" for one in hertz)
        problem = (
            f"is a temperature ramp at {named} Hz, which do not tell how it shifts: must have "
            f"{_FEWEST} frequencies or more, or be sweeps of frequency at several temperatures; "
            "where a_T is known, read_master_curve and a scene's master_curve take it with shift"
        )
        raise InvalidInput(problem, code="temperature-ramp", where=table.path)
    low = max(curve["temperature"][0] for curve in curves)
    high = min(curve["temperature"][-1] for curve in curves)
    fewest = min(curve["temperature"].size for curve in curves)
    count = int(max(2, min((high - low) / _APART + 1, fewest)))
    if not high > low:
        raise InvalidInput("has no temperature with all its frequencies", where=table.path)
    result = []
    for t in np.linspace(low, high, count):
        storage, loss = (
            [np.exp(np.interp(t, c["temperature"], np.log(c[name]))) for c in curves]
            for name in ("storage", "loss")
        )
        result.append(
            Isotherm(
                temperature=float(t),
                angular_frequency=2 * np.pi * np.array(hertz),
                storage_modulus=storage,
                loss_modulus=loss,
            )
        )
    return result


def _places(table: Columns) -> NDArray[np.int64]:
    """For each row which of the rising frequencies it has."""
    hertz = table.values["frequency"]
    order = np.argsort(hertz, kind="stable")
    new = np.concatenate([[0], np.diff(np.log(hertz[order])) > _SAME]).astype(np.int64)
    places = np.empty(hertz.size, np.int64)
    places[order] = np.cumsum(new)
    return places
