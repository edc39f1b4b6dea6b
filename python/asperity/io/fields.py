"""Fields of a scene file: their types, and messages that name file, table and key."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import MISSING, dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from asperity._core import InvalidInput, NotConverged, OutOfRange
from asperity.base.arguments import shortened
from asperity.base.diagnostics import Advice, Argument, Must, Sentence, Value, Words, valued
from asperity.base.parameters import Parameter, parameters, without_unit
from asperity.base.quantities import TEMPERATURE, Quantity
from asperity.io import plausible
from asperity.io.toml import toml_value
from asperity.io.typed import as_typed

MOST_POINTS = 100_000  # of a sweep
MOST_ROWS = 1_000_000  # of a table
_SWEEP = dict.fromkeys(("from", "to", "points"))


@dataclass(frozen=True)
class Field:
    """What a key may hold, the argument that it sets, and what its unit lets it be."""

    read: Callable[[object], Any]
    argument: str = ""
    quantity: Quantity | None = None
    unit: str = ""  # of `quantity`, the SI unit if empty
    declared: Parameter | None = None
    meaning: str = ""  # for the page of scenes, where the argument's docstring does not say it

    @property
    def required(self) -> bool:
        return self.declared is not None and self.declared.default is MISSING

    @property
    def default(self) -> Any:
        """What holds where the key is left out; None where it is required, or nothing does."""
        return None if self.declared is None or self.required else self.declared.default


class _WrongValueError(InvalidInput):
    """Says what is wrong with a value, or what it must be."""


_MUST = Must("must be ")


def number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _WrongValueError(_MUST, "a number")
    try:
        return float(value)
    except OverflowError:
        raise _WrongValueError(_MUST, "a finite number") from None


def one_temperature(value: object) -> float:
    if isinstance(value, list):
        raise _WrongValueError(_MUST, "a number; several temperatures go into [conditions]")
    return number(value)


def numbers(value: object) -> list[float]:
    try:
        return [number(entry) for entry in value]  # type: ignore[attr-defined]
    except (TypeError, _WrongValueError):
        raise _WrongValueError(_MUST, "a list of numbers") from None


def text(value: object) -> str:
    if not isinstance(value, str):
        raise _WrongValueError(_MUST, "a text")
    return value


def text_or_true(value: object) -> str | bool:
    return True if value is True else text(value)


def truth(value: object) -> bool:
    if not isinstance(value, bool):
        raise _WrongValueError(_MUST, "true or false")
    return value


def file_name(value: object) -> str:
    if not isinstance(value, str) or not value or "\0" in value:
        raise _WrongValueError(_MUST, "the name of a file")
    if any(one in value for one in "\b\t\n\f\r"):  # "C:\temp" has a tab
        raise _WrongValueError(_MUST, "a name with / or in '...', as \\ begins a code in \"...\"")
    return value


def file_names(value: object) -> list[str]:
    if not isinstance(value, list) or not value:
        raise _WrongValueError(_MUST, "a list of names of files")
    return [file_name(entry) for entry in value]


def file_or_files(value: object) -> str | list[str]:
    return file_names(value) if isinstance(value, list) else file_name(value)


def texts(value: object) -> dict[str, str]:
    if not isinstance(value, dict) or not all(isinstance(entry, str) for entry in value.values()):
        raise _WrongValueError(_MUST, 'a table of texts, as in {frequency = "Hz"}')
    return dict(value)


def columns(value: object) -> dict[str, str | int]:
    if not isinstance(value, dict) or not all(
        isinstance(entry, str | int) and not isinstance(entry, bool) for entry in value.values()
    ):
        example = 'as in {frequency = "f"}, or {frequency = 1}'
        raise _WrongValueError(_MUST, f"a table of names or places of columns, {example}")
    return {key: int(one) if isinstance(one, int) else one for key, one in value.items()}


def count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or abs(value) >= 2**63:
        raise _WrongValueError(_MUST, "a whole number")
    return value


def pixel_size(value: object) -> float | tuple[float, float]:
    try:
        if isinstance(value, list) and len(value) == 2:
            return number(value[0]), number(value[1])
        return number(value)
    except _WrongValueError:
        raise _WrongValueError(_MUST, "a number or [dy, dx]") from None


def sweep(value: object) -> Any:
    """Array of the values that a number, a list or a logarithmic sweep stands for."""
    return _swept(value, "{from = 1e-6, to = 10, points = 60}", _logarithmic)


def angles(value: object) -> Any:
    return _swept(value, "{from = 0, to = 360, points = 73}", np.linspace)


def _swept(value: object, example: str, spread: Callable[[float, float, int], Any]) -> Any:
    allowed = f"a number, a list, or {example}"
    if isinstance(value, dict):
        return spread(*_ends(value, example))
    if isinstance(value, list):
        if not value:
            raise _WrongValueError(_MUST, f"{allowed}, and not empty")
        return np.array(numbers(value))
    try:
        return np.array([number(value)])
    except _WrongValueError:
        raise _WrongValueError(_MUST, allowed) from None


def _logarithmic(low: float, high: float, points: int) -> Any:
    if not (0 < low < np.inf and 0 < high < np.inf):
        raise _WrongValueError(_MUST, "a sweep between two positive numbers")
    return np.geomspace(low, high, points)


def _ends(value: Mapping[str, object], example: str) -> tuple[float, float, int]:
    for key in value:
        if key not in _SWEEP:
            raise _WrongValueError(f"unknown key {shortened(key)}, {nearest(key, _SWEEP)}")
    readers: tuple[Callable[[object], Any], ...] = (number, number, count)
    entries = []
    for key, read in zip(_SWEEP, readers, strict=True):
        if key not in value:
            raise _WrongValueError(f"{key} is missing, as in {example}")
        try:
            entries.append(read(value[key]))
        except _WrongValueError as wrong:
            raise _WrongValueError(f"{key} ", *wrong.sentence) from None
    low, high, points = entries
    if not 2 <= points <= MOST_POINTS:
        raise _WrongValueError("points ", _MUST, f"in 2..{MOST_POINTS}")
    return low, high, points


_READERS: dict[Any, Callable[[object], Any]] = {
    float: number,
    float | None: number,
    int: count,
    str: text,
    str | None: text,
    Mapping[str, str]: texts,
    Mapping[str, str | int]: columns,
    Sequence[float] | None: numbers,
}


def fields_of(of: Callable[..., Any], *names: str) -> dict[str, Field]:
    """The keys of a scene for the parameters of a value or a function, or for those of `names`.

    What is no number, text or list of numbers is not set by a key.
    """
    fields = {}
    for one in parameters(of, *names):
        read = _READERS.get(one.type)
        if one.choices:
            read = text_or_true if True in one.choices else text
        elif read is None and (one.si_unit or one.key_name):
            read = numbers
        if read is not None:
            fields[one.key] = Field(read, one.name, one.quantity, declared=one)
    return fields


def kelvin_or_celsius(
    read: Callable[[object], Any], argument: str, meaning: str
) -> dict[str, Field]:
    """The two keys of a temperature, of which a table has one."""
    same = f"the same, instead of `{argument}_k`"
    return {
        f"{argument}_k": Field(read, argument, TEMPERATURE, meaning=meaning),
        f"{argument}_c": Field(read, "", TEMPERATURE, "C", meaning=same),
    }


def defaults_of(fields: Mapping[str, Field]) -> dict[str, Any]:
    return {key: one.default for key, one in fields.items() if one.default is not None}


def required(fields: Mapping[str, Field]) -> tuple[str, ...]:
    return tuple(key for key, one in fields.items() if one.required)


def refuse(path: Path, field: str, problem: str, phrase: Value | None = None) -> NoReturn:
    value = () if phrase is None else (" = ", phrase)
    raise InvalidInput(Argument(shortened(field)), *value, f": {problem}", where=path)


def nearest(name: str, known: Mapping[str, object], form: str = "{}") -> str:
    """What to try instead of an unknown name."""
    import difflib  # here: `import asperity` is to be quick

    close = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
    if close:
        unit = " Its number is in another unit." if _other_unit(name, close[0]) else ""
        return "did you mean " + form.format(close[0]) + "?" + unit
    return "allowed are " + ", ".join(form.format(key) for key in known)


def _other_unit(name: str, key: str) -> bool:
    """Whether a name is a key's but for the unit at its end."""
    quantity, unit = without_unit(key)
    return bool(unit) and name.startswith(f"{quantity}_")


def read_table(
    path: Path, section: str, table: object, fields: Mapping[str, Field]
) -> dict[str, Any]:
    """Values of a TOML table whose keys are all known, types right and numbers plausible."""
    if not isinstance(table, dict):
        refuse(path, f"[{section}]", "must be a table")
    for key in table:
        if key not in fields:
            refuse(path, f"[{section}] {key}", f"unknown key, {nearest(key, fields)}")
    values = {}
    for key, value in table.items():
        try:
            values[key] = fields[key].read(value)
        except _WrongValueError as wrong:
            phrase = valued(value, shortened(toml_value(value), 80))
            about = Argument(f"[{section}] {key}"), " = ", phrase, ": "
            raise InvalidInput(*about, *wrong.sentence, where=path) from None
        if (quantity := fields[key].quantity) is not None:
            name = f"[{section}] {key}"
            plausible.check(name, values[key], quantity, fields[key].unit, path=path)
    return values


def arguments(values: Mapping[str, Any], fields: Mapping[str, Field]) -> dict[str, Any]:
    """Keyword arguments of the core from those of `values` that are in `fields`; angles that keys
    have in degrees are in radians there."""
    return {
        f.argument: math.radians(values[key]) if key.endswith("_deg") else values[key]
        for key, f in fields.items()
        if f.argument and key in values
    }


_ADVICE = {  # in a scene, and on the command line that fits one
    "take-partial-contact": 'take [correction] kind = "partial-contact", which was 4 % rms off',
    "give-macro-wavenumber": "give macro_wavenumber_per_m or macro_area",
    "end-spectrum": "[surface] q1_per_m = {:.12g}",
    "extrapolate-curve": '[rubber] extrapolation = "power-law" or "clamp"',
    "extrapolate-series": '[rubber] extrapolation = "prony"',
    "hold-some": "--hold keeps some",
    "hold-width": "--hold width=0.1",
    "hold-velocity": "--hold reference_velocity_m_s=6e-3",
}


def in_keys(sentence: Sentence, names: Mapping[str, str]) -> Sentence:
    """A sentence with arguments as `names`, argument -> [table] key, and advice for a scene."""
    said: list[str] = []
    for phrase in sentence:
        if isinstance(phrase, Argument):
            name, _, entry = phrase.partition(": ")  # of an argument that has entries
            whole = (
                f"{names[name]} {names.get(entry, entry)}" if entry and name in names else phrase
            )
            phrase = phrase.saying(names.get(phrase, whole))
        elif isinstance(phrase, Advice) and phrase.tag in _ADVICE:
            phrase = phrase.saying(_ADVICE[phrase.tag].format(*phrase.numbers))
        elif isinstance(phrase, Advice) and phrase.tag == "allowed-velocities":
            low, high = inside(phrase)
            line = f"velocity_m_s = {{ from = {low:g}, to = {high:g}, points = 31 }}"
            phrase = phrase.saying(f"{phrase}, as in {line}," if low < high else phrase)
        said.append(phrase)
    return tuple(said)


def inside(offer: Advice) -> tuple[float, float]:
    """Short numbers within the two of an offer."""
    low, high = offer.numbers
    return float(f"{1.01 * low:.3g}"), float(f"{0.99 * high:.3g}")


@contextmanager
def saying(words: Words, path: Path | None = None) -> Iterator[None]:
    """Let errors speak in words of an edge, of a file where one is named."""
    try:
        yield
    except (InvalidInput, OutOfRange, NotConverged) as error:
        said = error.said(words)
        raise (said if path is None else said.within(path)) from error


@contextmanager
def rename_in_errors(
    path: Path | None, names: Mapping[str, str], inputs: Mapping[str, Any] | None = None
) -> Iterator[None]:
    """Let errors of the core name the file and its fields, with numbers of `inputs` as they were
    typed."""
    with saying(lambda sentence: as_typed(in_keys(sentence, names), inputs or {}), path):
        yield


def names_of(section: str, fields: Mapping[str, Field]) -> dict[str, str]:
    return {f.argument: f"[{section}] {key}" for key, f in fields.items() if f.argument}
