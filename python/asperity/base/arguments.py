"""Arguments as Python gives them, brought to what the core takes, or refused by their names.

The core checks ranges. What is checked here is the kind: a number, an array, a name, an object.
"""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from decimal import Decimal
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.base.diagnostics import Argument, File, InvalidInput, Note, must_be, refusal
from asperity.base.diagnostics import brief as brief

Array = NDArray[np.float64]
Shape = tuple[int, ...]
Input = TypeVar("Input", contravariant=True)
Output = TypeVar("Output", covariant=True)
Known = TypeVar("Known")


class Conversion(Protocol[Input, Output]):
    """The type of a field that takes more kinds of arguments than it keeps."""

    def __get__(self, owner: object, cls: type) -> Output: ...
    def __set__(self, owner: object, value: Input) -> None: ...


Vector = Conversion[ArrayLike, Array]
Covariance = Conversion[ArrayLike, NDArray[Any]]  # of three parameters
OptionalVector = Conversion[ArrayLike | None, Array | None]
MOST_THREADS = 1024  # more would be a slip
ABSENT: Any = None  # the default of a field whose type is Conversion


if TYPE_CHECKING:
    _Path = Path
else:
    _Path = type(Path())


class FilePath(_Path):
    """A path whose name stays in one line of a message, whatever characters it has."""

    def __format__(self, form: str) -> str:
        name = shortened(str(self))
        return format(name if name.isprintable() else repr(name), form)


@contextmanager
def reading(what: object) -> Iterator[None]:
    """Let a failure name what is read, a file say, and why it cannot be."""
    try:
        yield
    except OSError as error:
        raise InvalidInput(f"cannot be read: {error.strerror or error}", where=what) from error
    except InvalidInput as error:
        named = any(isinstance(phrase, File) for phrase in error.where)
        raise (error if named else error.within(what)) from error


def shortened(text: str, most: int = 400) -> str:
    """Return a text, of which the middle is left out where it is too long for a message."""
    return text if len(text) <= most else f"{text[: most // 2]} ... {text[-most // 4 :]}"


def quoted(text: str) -> str:
    """Return a text in quotation marks, in one short line, whatever characters it has."""
    return f'"{repr(text[:60])[1:-1][:60]}"'


def number(value: Any, name: str) -> float:
    if type(value) is float:
        return value
    if isinstance(value, Real | Decimal):
        try:
            return float(value)
        except OverflowError:
            allowed = "at most 1.8e308 in size"
            raise refusal(name, value, allowed) from None
        except ValueError:  # a signalling NaN
            raise refusal(name, value, "a number") from None
    if getattr(value, "ndim", None) == 0:
        return float(real_array(value, name))
    raise refusal(name, value, "a number")


def number_or_none(value: Any, name: str) -> float | None:
    return None if value is None else number(value, name)


def whole(value: Any, name: str, *, lowest: int = 0, highest: int = 2**62) -> int:
    if isinstance(value, int | np.integer) and lowest <= value <= highest:
        return int(value)
    allowed = f"from {lowest} to {highest}" if highest != 2**62 else f"{lowest} or more"
    raise refusal(name, value, f"a whole number, {allowed}")


def flag(value: Any, name: str) -> bool:
    if value is True or value is False:
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    raise refusal(name, value, "True or False")


def choice(value: Any, name: str, allowed: Any) -> int:
    """Return the place of an option among those of a Literal or a sequence, which is its number in
    the core."""
    options: Sequence[Any] = get_args(allowed) or allowed
    if (isinstance(value, str) or value is None or value is True) and value in options:
        return options.index(value)
    names = ", ".join(f'"{one}"' if isinstance(one, str) else f"{one}" for one in options)
    shown = quoted(value) if isinstance(value, str) else brief(value)
    raise refusal(name, value, f"one of {names}", text=shown)


def real_array(value: Any, name: str) -> Array:
    """Return an array-like of real numbers as float64, of the shape that it has."""
    if type(value) is float:
        return np.array(value)
    array = real_numbers(value, name)
    if array.dtype == np.float64:
        return array
    with np.errstate(invalid="ignore"):  # signalling NaN, of which the core says what is wrong
        return array.astype(np.float64)


def real_numbers(value: Any, name: str) -> NDArray[Any]:
    """Return an array-like of real numbers in the type that it has."""
    if is_masked(value) or (isinstance(value, list | tuple) and any(map(is_masked, value))):
        hint = "leave masked entries out with compressed()"
        raise InvalidInput(Argument(name), f" is a masked array; {hint}")
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        array = np.array(None)
    if array.dtype.kind in "biuf":
        return array
    raise refusal(name, value, "a number or an array of real numbers")


def is_masked(value: Any) -> bool:
    """Whether this is a NumPy masked array, told without importing `numpy.ma`."""
    return isinstance(value, np.ndarray) and hasattr(value, "mask")


def vector(value: Any, name: str) -> Array:
    """Return a copy of a one-dimensional array-like that nobody can write to."""
    array = real_array(value, name)
    if array.ndim != 1:
        raise InvalidInput(Argument(name), f" has {array.ndim} dimensions; it must have 1")
    return frozen(np.array(array, order="C"))


def vector_or_none(value: Any, name: str) -> Array | None:
    return None if value is None else vector(value, name)


def covariance_matrix(value: Any, name: str) -> Array:
    """Return the covariance of three parameters, read-only."""
    matrix = real_array(value, name)
    if matrix.shape != (3, 3):
        raise must_be(name, "(3, 3)", f" has shape {matrix.shape}")
    if not np.isfinite(matrix).all() or np.diag(matrix).min() < 0:
        raise refusal(name, value, "finite, its diagonal not negative")
    return frozen(np.array(matrix, order="C"))


def known(value: Known | None) -> Known:
    """Return what was seen not to be None before."""
    assert value is not None
    return value


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Return the array itself, made read-only."""
    array.setflags(write=False)
    return array


def of_kind(value: Any, name: str, *kinds: type) -> Any:
    """Return an object of one of the classes of the package."""
    if isinstance(value, kinds):
        return value
    names = [("an " if kind.__name__[0] in "AI" else "a ") + kind.__name__ for kind in kinds]
    raise refusal(name, value, f"{' or '.join(names)}")


def many(value: Any, name: str, kind: type) -> list[Any]:
    """Return objects of one class of the package, given as an iterable."""
    if not isinstance(value, Iterable):
        raise refusal(name, value, "an iterable")
    return [of_kind(one, f"{name}[{at}]", kind) for at, one in enumerate(value)]


def notes_of(value: Any, name: str) -> tuple[Note, ...]:
    """Return a tuple of notes, of which some may be plain texts."""
    if isinstance(value, Iterable) and not isinstance(value, str | dict):
        entries = tuple(value)
        if all(isinstance(one, str) for one in entries):
            return tuple(one if isinstance(one, Note) else Note(one) for one in entries)
    raise refusal(name, value, "a tuple of str")


def path_of(value: Any, name: str) -> Path:
    if isinstance(value, str | os.PathLike):
        with suppress(TypeError):  # of a __fspath__ that gives bytes
            return FilePath(value)
    raise refusal(name, value, "the path of a file")


def broadcast(**arguments: Any) -> tuple[Shape, list[Any]]:
    """Return the shape that arguments have together, and each of them flat in that shape.

    Numbers stay numbers, which the core takes as arrays of one entry.
    """
    flat = [*arguments.values()]
    if all([type(one) is float for one in flat]):  # the common scalar, without NumPy's rules
        return (), flat
    arrays = {name: real_array(one, name) for name, one in arguments.items()}
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        raise InvalidInput(_no_shape(arrays)) from None
    return shape, [np.broadcast_to(array, shape).ravel() for array in arrays.values()]


def _no_shape(arrays: dict[str, Array]) -> str:
    shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
    text = f"shapes {shapes}: must broadcast together"
    lines = [name for name, array in arrays.items() if array.ndim == 1]
    if len(lines) > 1:
        text += f"; {lines[0]}[:, None] gives every {lines[0]} with every {lines[1]}"
    return text


def shaped(flat: NDArray[Any], shape: Shape) -> Any:
    """Return a result in the shape of its arguments: a scalar for scalars, else a new array."""
    return flat.reshape(shape) if shape else flat.item()


def over(value: Any, name: str, compute: Callable[[Array], NDArray[Any]]) -> Any:
    """Return f of every entry, in the shape of the argument."""
    array = real_array(value, name)
    return shaped(compute(np.ascontiguousarray(array).ravel()), array.shape)
