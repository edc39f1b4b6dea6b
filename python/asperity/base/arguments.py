"""Arguments as Python gives them, brought to what the core takes, or refused by their names.

The core checks ranges. What is checked here is the kind: a number, an array, a name, an object.
"""

import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from decimal import Decimal
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity._core import InvalidInput
from asperity.base.diagnostics import MUST_BE, Argument, Note, refusal
from asperity.base.diagnostics import brief as brief

Array = NDArray[np.float64]
Shape = tuple[int, ...]
Taken = TypeVar("Taken", contravariant=True)
Kept = TypeVar("Kept", covariant=True)


class Given(Protocol[Taken, Kept]):
    """The type of a field that takes more kinds of arguments than it keeps."""

    def __get__(self, owner: object, cls: type) -> Kept: ...
    def __set__(self, owner: object, given: Taken) -> None: ...


Vector = Given[ArrayLike, Array]
OptionalVector = Given[ArrayLike | None, Array | None]
MOST_THREADS = 1024  # more would be a slip
ABSENT: Any = None  # the default of a field whose type is Given


if TYPE_CHECKING:
    _Path = Path
else:
    _Path = type(Path())


class FilePath(_Path):
    """A path whose name stays in one line of a message, whatever characters it has."""

    def __format__(self, form: str) -> str:
        name = shortened(str(self))
        return format(name if name.isprintable() else repr(name), form)


def shortened(text: str, most: int = 400) -> str:
    """Return a text, of which the middle is left out where it is too long for a message."""
    return text if len(text) <= most else f"{text[: most // 2]} ... {text[-most // 4 :]}"


def quoted(text: str) -> str:
    """Return a text in quotation marks, in one short line, whatever characters it has."""
    return f'"{repr(text[:60])[1:-1][:60]}"'


def number(found: Any, name: str) -> float:
    """Return a real number as a float."""
    if type(found) is float:
        return found
    if isinstance(found, Real | Decimal):
        try:
            return float(found)
        except OverflowError:
            allowed = "at most 1.8e308 in size"
            raise refusal(name, found, allowed) from None
        except ValueError:  # a signalling NaN
            raise refusal(name, found, "a number") from None
    if getattr(found, "ndim", None) == 0:
        return float(real_array(found, name))
    raise refusal(name, found, "a number")


def number_or_none(found: Any, name: str) -> float | None:
    """Return a real number as a float, or None."""
    return None if found is None else number(found, name)


def whole(found: Any, name: str, *, lowest: int = 0, highest: int = 2**62) -> int:
    """Return a whole number of a range."""
    if isinstance(found, int | np.integer) and lowest <= found <= highest:
        return int(found)
    allowed = f"from {lowest} to {highest}" if highest != 2**62 else f"{lowest} or more"
    raise refusal(name, found, f"a whole number, {allowed}")


def flag(found: Any, name: str) -> bool:
    """Return True or False."""
    if found is True or found is False:
        return found
    if isinstance(found, np.bool_):
        return bool(found)
    raise refusal(name, found, "True or False")


def choice(found: Any, name: str, allowed: Sequence[str | None]) -> int:
    """Return the place of an option among those allowed, which is its number in the core."""
    if (isinstance(found, str) or found is None) and found in allowed:
        return allowed.index(found)
    names = ", ".join("None" if option is None else f'"{option}"' for option in allowed)
    shown = quoted(found) if isinstance(found, str) else brief(found)
    raise refusal(name, found, f"one of {names}", text=shown)


def real_array(found: Any, name: str) -> Array:
    """Return an array-like of real numbers as float64, of the shape that it has."""
    if type(found) is float:
        return np.array(found)
    array = real_numbers(found, name)
    if array.dtype == np.float64:
        return array
    with np.errstate(invalid="ignore"):  # signalling NaN, of which the core says what is wrong
        return array.astype(np.float64)


def real_numbers(found: Any, name: str) -> NDArray[Any]:
    """Return an array-like of real numbers in the type that it has."""
    if is_masked(found) or (isinstance(found, list | tuple) and any(map(is_masked, found))):
        hint = "leave masked entries out with compressed()"
        raise InvalidInput(Argument(name), f" is a masked array; {hint}")
    try:
        array = np.asarray(found)
    except (TypeError, ValueError):
        array = np.array(None)
    if array.dtype.kind in "biuf":
        return array
    raise refusal(name, found, "a number or an array of real numbers")


def is_masked(found: Any) -> bool:
    """Whether this is a NumPy masked array, told without importing `numpy.ma`."""
    return isinstance(found, np.ndarray) and hasattr(found, "mask")


def vector(found: Any, name: str) -> Array:
    """Return a copy of a one-dimensional array-like that nobody can write to."""
    array = real_array(found, name)
    if array.ndim != 1:
        raise InvalidInput(Argument(name), f" has {array.ndim} dimensions; it must have 1")
    return frozen(np.array(array, order="C"))


def vector_or_none(found: Any, name: str) -> Array | None:
    """Return a vector, or None."""
    return None if found is None else vector(found, name)


def covariance_matrix(found: Any) -> Array:
    """Return the covariance of three parameters, read-only."""
    matrix = real_array(found, "covariance")
    if matrix.shape != (3, 3):
        raise InvalidInput(Argument("covariance"), f" has shape {matrix.shape}", MUST_BE, "(3, 3)")
    if not np.isfinite(matrix).all() or np.diag(matrix).min() < 0:
        raise refusal("covariance", found, "finite, its diagonal not negative")
    return frozen(np.array(matrix, order="C"))


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Return the array itself, made read-only."""
    array.setflags(write=False)
    return array


def of_kind(found: Any, name: str, *kinds: type) -> Any:
    """Return an object of one of the classes of the package."""
    if isinstance(found, kinds):
        return found
    names = [("an " if kind.__name__[0] in "AI" else "a ") + kind.__name__ for kind in kinds]
    raise refusal(name, found, f"{' or '.join(names)}")


def many(found: Any, name: str, kind: type) -> list[Any]:
    """Return objects of one class of the package, given as an iterable."""
    if not isinstance(found, Iterable):
        raise refusal(name, found, "an iterable")
    return [of_kind(one, f"{name}[{at}]", kind) for at, one in enumerate(found)]


def notes_of(found: Any, name: str) -> tuple[Note, ...]:
    """Return a tuple of notes, of which some may be plain texts."""
    if isinstance(found, Iterable) and not isinstance(found, str | dict):
        given = tuple(found)
        if all(isinstance(one, str) for one in given):
            return tuple(one if isinstance(one, Note) else Note(one) for one in given)
    raise refusal(name, found, "a tuple of str")


def path_of(found: Any, name: str) -> Path:
    """Return where a file is."""
    if isinstance(found, str | os.PathLike):
        with suppress(TypeError):  # of a __fspath__ that gives bytes
            return FilePath(found)
    raise refusal(name, found, "the path of a file")


def broadcast(**given: Any) -> tuple[Shape, list[Any]]:
    """Return the shape that arguments have together, and each of them flat in that shape.

    Numbers stay numbers, which the core takes as arrays of one entry.
    """
    flat = [*given.values()]
    if all([type(one) is float for one in flat]):  # the common scalar, without NumPy's rules
        return (), flat
    arrays = {name: real_array(one, name) for name, one in given.items()}
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


def over(found: Any, name: str, compute: Callable[[Array], NDArray[Any]]) -> Any:
    """Return f of every entry, in the shape of the argument."""
    array = real_array(found, name)
    return shaped(compute(np.ascontiguousarray(array).ravel()), array.shape)
