"""The ranges that stated units leave plausible, with their reasons, and what is said outside them.

Scenes, readers and the command line state their units, so a number that no rubber, road or test
rig has was most likely given in another one. Outside of `least` to `most` a number is absurd,
outside of `low` to `high` it is unusual. Scenes and the command line refuse what is absurd and note
what is unusual; a reader that Python calls notes both, in one line of the logger "asperity", which
goes to stderr where nobody has configured logging. Each message guesses a unit in which the number
would be likely. Nothing is converted. The functions that compute take any consistent units and
never ask here.

These cannot be seen, since the wrong number is as plausible as the right one: hertz given as rad/s
(a factor of 6.3), wavenumbers without their 2 pi, 50 km/h given as 50 m/s, 68 F given as 68 C, some
hundred kPa given as Pa, nanometres given where micrometres are meant. Relaxation times and the
frequencies of a master curve have no range: time-temperature shifts move them over any number of
decades.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity._core import InvalidInput, NotConverged, OutOfRange
from asperity.base.diagnostics import MUST_BE, Argument, Note, Sentence, Value, valued
from asperity.base.quantities import (
    LENGTH_UNITS,
    PRESSURE_ON_RUBBER,
    RUBBER_FROM,
    SPACING,
    TEMPERATURE_UNITS,
    Limit,
    Quantity,
)
from asperity.io.typed import as_typed

# where notes go, and whether what is absurd is refused instead
_sink: ContextVar[tuple[list[Note], bool] | None] = ContextVar("sink", default=None)


@contextmanager
def collected(inputs: Mapping[str, Any] | None = None) -> Iterator[list[Note]]:
    """Refuse absurd numbers, and collect the notes on unusual ones in a list.

    An error of the package that follows on a note may well be due to it, and repeats it. Both have
    the numbers of `inputs` as they were typed (`as_typed`).
    """
    notes: list[Note] = []
    typed = partial(as_typed, inputs=inputs or {})
    token = _sink.set((notes, True))
    try:
        yield notes
    except (InvalidInput, OutOfRange, NotConverged) as error:
        more = [("; note: ", *note.where, *note.sentence) for note in notes]
        raise error.followed_by(*chain.from_iterable(more)).said(typed) from error
    finally:
        _sink.reset(token)
        notes[:] = [note.said(typed) for note in notes]


def implausible(
    numbers: Mapping[str, tuple[ArrayLike, Quantity]], stiffest: float
) -> tuple[Note, ...]:
    """Return one note on all numbers of a call that are absurd or unusual in SI units, none where
    there is nothing to note: any consistent units are taken."""
    pressure = numbers["pressure"][0]
    odd = [name for name, one in numbers.items() if not _is_usual(*one)]
    if not odd and _is_usual(pressure, PRESSURE_ON_RUBBER) and np.max(pressure) <= stiffest:
        return ()
    notes: list[Note] = []
    token = _sink.set((notes, False))
    try:
        for name in odd:
            check(name, *numbers[name])
        check_load("pressure", pressure, stiffest)
    finally:
        _sink.reset(token)
    if not notes:
        return ()
    first, *others = notes
    rest = chain.from_iterable(("; ", *note.sentence) for note in others)
    code = next((note.code for note in notes if note.code.startswith("absurd")), first.code)
    step = "check the units: numbers are taken as Pa, m, m/s, unless all are in consistent ones"
    return (Note(*first.sentence, *rest, code=code, next_step=step),)


def _is_usual(values: ArrayLike, quantity: Quantity) -> bool:
    """Whether `check` has nothing to say of SI numbers that are no temperatures, at one look."""
    low, high = quantity.low or quantity.least, quantity.high or quantity.most
    if type(values) is float:
        return low.value <= abs(values) <= high.value
    size = np.abs(values)
    return size.size > 0 and bool(low.value <= size.min() and size.max() <= high.value)


def tell_again(notes: Sequence[Note]) -> None:
    """Note what was noted when something was built that is now taken from a cache."""
    for note in notes:
        _keep(note)


def check(
    name: str, values: ArrayLike, quantity: Quantity, unit: str = "", *, path: object = ()
) -> None:
    """Refuse numbers that are absurd, note those that are unusual; note both for Python's callers.

    Parameters
    ----------
    name : str
        Whose values they are: a key or an option, of the file at `path`.
    values : array-like
        Zeros, infinite ones and NaN are left to whoever computes with them.
    unit : str
        One of `quantity.units`, the SI unit if empty.

    Raises
    ------
    InvalidInput
        Inside of `collected`. In one line: the value, what is allowed and why, and the unit that it
        may be in.
    """
    unit = unit or next(iter(quantity.units))
    numbers = np.ravel(np.asarray(values, dtype=np.float64))
    numbers = numbers[np.isfinite(numbers)]
    if quantity.units is not TEMPERATURE_UNITS:
        numbers = numbers[numbers != 0]
    if numbers.size == 0:
        return
    size = quantity.size(numbers, unit)
    lowest, highest = int(size.argmin()), int(size.argmax())
    for at, side, absurd, words, limit in (
        (lowest, -1, True, (MUST_BE, "at least"), quantity.least),
        (highest, 1, True, (MUST_BE, "at most"), quantity.most),
        (lowest, -1, False, (": unusual, below",), quantity.low),
        (highest, 1, False, (": unusual, above",), quantity.high),
    ):
        # sweeps end on rounded numbers
        if limit is not None and side * (size[at] - limit.value) > 1e-9 * abs(limit.value):
            sentence = _sentence(name, float(numbers[at]), quantity, unit, words, limit)
            _tell(sentence, "absurd-value" if absurd else "unusual-value", path, absurd=absurd)
            if absurd:
                return


def check_scan(path: object, heights: NDArray[Any], spacing: ArrayLike, unit: str) -> None:
    """Refuse a scan that stands higher than it is long, as heights in a wrong unit make it.

    Measured surfaces have rms heights, tilt included, of 1e-5 to 0.1 of their longest side; a
    scan tilted by 45 degrees has 0.29.
    """
    check("pixel_size", spacing, SPACING, path=path)
    step = max(1, heights.size // 50_000)  # an order of magnitude is enough
    with np.errstate(all="ignore"):  # a signalling NaN is a drop-out, 1e300 is not refused here
        sample = np.asarray(heights.ravel(order="K")[::step], dtype=np.float64)
        sample = sample[np.isfinite(sample)]
        rms = float(np.std(sample)) if sample.size else 0.0
    length = float(np.max(np.array(heights.shape) * np.asarray(spacing)))
    if not (0 < rms < math.inf and 0 < length < math.inf) or 5e-10 <= rms / length <= 0.5:
        return
    number = rms / LENGTH_UNITS[unit][0]
    others = (one for one in LENGTH_UNITS.items() if one[0] != unit)
    likely = [other for other, (si, _) in others if 3e-5 <= number * si / length <= 0.1]
    guess = f"; heights in {likely[0]}? {number:.4g} {likely[0]} would do" if likely else ""
    words: Sentence = (MUST_BE, "at most 10 times the length (no surface stands so high)")
    absurd, code = rms / length > 10, "absurd-heights"
    if not absurd:
        where = "above half the length" if rms > length else "outside 5e-10 to 0.5 of the length"
        words, code = (f": unusual, {where}",), "unusual-heights"
    shown = f": rms height {rms:.4g} m on a length of {length:.4g} m"
    sentence = Argument("unit"), " = ", valued(unit), shown, *words, guess
    _tell(sentence, code, path, absurd=absurd)


def check_load(name: str, pressure: ArrayLike, stiffest: float, *, path: object = ()) -> None:
    """Hold pressures against the largest |E| [Pa] of the rubber that they press.

    Rubber under its own modulus is squeezed flat, and linear theory has nothing to say of ten
    times that; a pressure below the weight of a centimetre of rubber is unusual where the rubber
    is no gel.
    """
    highest = pressure if type(pressure) is float else float(np.max(pressure))
    if stiffest > RUBBER_FROM:
        check(name, pressure, PRESSURE_ON_RUBBER, path=path)
    if not 0 < stiffest < highest:
        return
    phrase = valued(highest, f"{highest:.6g}")
    times = f": {highest / stiffest:.3g} times the rubber's largest modulus ({stiffest:.4g} Pa)"
    guess = "; moduli in MPa?" if 1e5 <= stiffest * 1e6 <= 2e10 else ""
    about = Argument(name), " = ", phrase, times
    words: Sentence = (", which squashes it",)
    absurd, code = highest > 10 * stiffest, "squashed-rubber"
    if absurd:
        words, code = (MUST_BE, "at most 10 times (it would be squashed)"), "absurd-pressure"
    _tell((*about, *words, guess), code, path, absurd=absurd)


def _tell(sentence: Sentence, code: str, path: object, *, absurd: bool) -> None:
    """Note it; what is absurd is refused where somebody collects."""
    sink = _sink.get()
    if sink is not None and sink[1] and absurd:
        raise InvalidInput(*sentence, code=code, where=path)
    _keep(Note(*sentence, code=code, where=path))


def _keep(note: Note) -> None:
    sink = _sink.get()
    if sink is None:
        import logging  # here: `import asperity` is to be quick

        logging.getLogger("asperity").warning("%s", note)
    elif note not in sink[0]:
        sink[0].append(note)


def _sentence(
    name: str, value: float, quantity: Quantity, unit: str, words: Sentence, limit: Limit
) -> Sentence:
    bound = f" {quantity.of_si(limit.value, unit):.6g} {unit}".rstrip()
    phrase = Value(f"{value:.6g}", (value,), unit if quantity.units is TEMPERATURE_UNITS else "")
    guess = _guess(value, quantity, unit)
    return Argument(name), " = ", phrase, *words, f"{bound} ({limit.reason}){guess}"


def _guess(value: float, quantity: Quantity, unit: str) -> str:
    """The first other unit in which the number would be likely."""
    for other in quantity.units:
        if (
            other != unit
            and quantity.likely[0] <= quantity.size(value, other) <= quantity.likely[1]
        ):
            here = quantity.of_si(quantity.to_si(value, other), unit)
            return f"; in {other}? {value:.6g} {other} is {here:.6g} {unit}"
    return ""
