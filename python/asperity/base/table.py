"""Results and measured objects as tables; pandas, xarray and matplotlib only when asked for."""

import shlex
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from importlib import import_module
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.base.value import Value


@dataclass(frozen=True)
class Column:
    """Numbers along some of a table's dimensions, with their unit and meaning."""

    dimensions: tuple[str, ...]
    values: ArrayLike
    unit: str
    meaning: str = ""

    def attributes(self) -> dict[str, str]:
        """Return what xarray shows beside the numbers."""
        return {"units": self.unit} | ({"long_name": self.meaning} if self.meaning else {})


@dataclass(frozen=True)
class Columns:
    """Coordinates, which say where, and variables, which say what; and facts of the whole."""

    coordinates: Mapping[str, Column]
    variables: Mapping[str, Column]
    attributes: Mapping[str, Any] = field(default_factory=dict)


def declared_columns(cls: Any) -> dict[str, tuple[str, str, tuple[str, ...]]]:
    """Return unit, meaning and own dimensions of each field that is a column."""
    return {one.name: one.metadata["column"] for one in fields(cls) if "column" in one.metadata}


class Table(Value):
    """What measured objects and results can do beside other values."""

    _facts: ClassVar[tuple[str, ...]] = ()  # attributes that hold for the whole table

    def _columns(self) -> Columns:
        """Return the columns of the table: by default the fields that are declared as such."""
        coordinates: dict[str, Column] = {}
        variables: dict[str, Column] = {}
        for name, (unit, meaning, along) in declared_columns(type(self)).items():
            if (values := getattr(self, name)) is not None:
                points = range(np.ndim(values) - len(along))
                dimensions = (*(f"axis_{i}" for i in points), *along)
                kind = coordinates if dimensions == (name,) else variables
                kind[name] = Column(dimensions, values, unit, meaning)
        facts = {name: getattr(self, name, None) for name in self._facts}
        known = {name: one for name, one in facts.items() if one is not None}
        return Columns(coordinates, variables, known)

    def _draw(self, axes: Any) -> None:
        raise NotImplementedError

    def to_xarray(self) -> Any:
        """Return an `xarray.Dataset`: a variable a column, with its unit as attribute."""
        xarray = imported("xarray", "tables")
        columns = self._columns()

        def arrays(part: Mapping[str, Column]) -> dict[str, tuple[Any, ...]]:
            return {
                name: (c.dimensions, np.array(c.values), c.attributes()) for name, c in part.items()
            }

        return xarray.Dataset(
            arrays(columns.variables), arrays(columns.coordinates), dict(columns.attributes)
        )

    def to_dataframe(self) -> Any:
        """Return a `pandas.DataFrame`: a row an entry, coordinates before variables."""
        pandas = imported("pandas", "tables")
        columns = self._columns()
        named = {**columns.coordinates, **columns.variables}
        sizes: dict[str, int] = {}
        for column in named.values():
            sizes.update(zip(column.dimensions, np.shape(column.values), strict=True))
        flat = {name: _in_full(column, sizes).ravel() for name, column in named.items()}
        return pandas.DataFrame(flat)

    @property
    def _is_polar(self) -> bool:
        """Whether its own axes are polar."""
        return False

    def plot(self, ax: Any = None) -> Any:
        """Draw into the matplotlib axes `ax`, new ones unless given, and return them."""
        if ax is None:
            how = {"projection": "polar"} if self._is_polar else {}
            pyplot = imported("matplotlib.pyplot", "plot")
            ax = pyplot.subplots(layout="constrained", subplot_kw=how)[1]
        self._draw(ax)
        return ax


def imported(module: str, extra: str) -> Any:
    """Return a module, or say what to install."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        missing = (error.name or module).partition(".")[0]
        raise ImportError(f"{missing} is missing: {to_install(extra)}") from None


def _in_full(column: Column, sizes: Mapping[str, int]) -> NDArray[Any]:
    """Return the numbers of a column repeated along the dimensions that it does not have."""
    lengths = [sizes[name] if name in column.dimensions else 1 for name in sizes]
    places = [[*sizes].index(name) for name in column.dimensions]
    order = sorted(range(len(places)), key=places.__getitem__)
    values = np.transpose(np.asarray(column.values), order).reshape(lengths)
    return np.broadcast_to(values, tuple(sizes.values()))


def to_install(extra: str) -> str:
    """A line for the Python that runs: a shell's `pip` may be of another one."""
    return f"{shlex.quote(sys.executable or 'python3')} -m pip install 'asperity[{extra}]'"
