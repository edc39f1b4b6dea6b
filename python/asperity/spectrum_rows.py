"""Spectra that are given row by row: their columns, checked, as tables and as pictures."""

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity.base.arguments import Array, Conversion, frozen, number, real_array, vector
from asperity.base.diagnostics import Argument, InvalidInput, Must, must_be, must_have, valued
from asperity.base.table import Table, declared_columns
from asperity.base.value import like

Flags = Conversion[ArrayLike | None, NDArray[np.uint8] | None]
Grid = Conversion[ArrayLike | None, NDArray[Any] | None]  # of two axes


class Rows(Table):
    """What spectra that are given row by row can do alike."""

    wavenumber: Any
    density: Any
    count: Any
    standard_error: Any
    flag: Any
    correlation: Any
    _facts: ClassVar[tuple[str, ...]] = ("skewness", "kurtosis", "curvature_kurtosis")
    _grids: ClassVar[Mapping[str, str]] = {"correlation": "lags"}  # columns of rows and these
    _pairs: ClassVar[tuple[tuple[str, str], ...]] = (  # the first is not given without the second
        ("skewness", "kurtosis"),
        ("kurtosis", "skewness"),
        ("curvature_kurtosis", "kurtosis"),
    )

    def __post_init__(self) -> None:
        self._take()
        self._set(flag=_flags(self.flag))
        for name, columns in self._grids.items():
            self._set(**{name: _two_axes(getattr(self, name), name, columns)})
        for name in ("count", "standard_error", "flag", "correlation"):
            column = getattr(self, name)
            if column is not None and column.size == 0:  # to the core, a column that is not given
                raise must_have(name, "one for each wavenumber", " has 0 entries")
        for name, needed in self._pairs:
            if getattr(self, name) is not None and getattr(self, needed) is None:
                raise must_be(needed, f"given with {name}", " = None")
        of_core = [getattr(self, name) for name in self._of_core()]
        self._set(_core=getattr(_core, type(self).__name__)(*of_core))

    @property
    def reliable(self) -> NDArray[np.bool_]:
        """Whether a row has no flag: bool, shape (n,)."""
        trusted = np.ones(self.wavenumber.size, bool) if self.flag is None else self.flag == 0
        return frozen(trusted)

    def log_binned(self, *, per_decade: float = 10.0) -> Self:
        """Return count-weighted means over bins of equal width in ln q, from the lowest row on.

        Each row is brought to the bin's mean wavenumber along the local power law. Flagged rows
        are left out of bins that have others. Errors of bins, and the correlation of neighbouring
        ones, follow from the errors and the correlation of the rows.

        Parameters
        ----------
        per_decade : float
            Number of bins in a factor 10 of the wavenumber.
        """
        return like(self, self._core.log_binned(number(per_decade, "per_decade")))

    def _summary(self) -> dict[str, Any]:
        band = {"q0": float(self.wavenumber[0]), "q1": float(self.wavenumber[-1])}
        return {"rows": self.wavenumber.size, **band, "reliable": int(self.reliable.sum())}

    def _draw(self, axes: Any) -> None:
        shown, good = self.density > 0, self.reliable
        measured = self._draw_where(axes, shown & good, label="measured")
        if np.any(shown & ~good):
            self._draw_where(axes, shown & ~good, color="0.65", label="flagged: do not trust")
        if self.standard_error is not None:
            mean, error = self.density[shown], self.standard_error[shown]
            lower = np.maximum(mean - error, mean / 10)
            shade = {"color": measured.get_color(), "alpha": 0.2, "label": "± standard error"}
            axes.fill_between(self.wavenumber[shown], lower, mean + error, **shade)
        axes.set_xscale("log")
        if shown.any():
            axes.set_yscale("log")
        unit, label, _ = declared_columns(type(self))["density"]
        axes.set(xlabel="Wavenumber $q$ [1/m]", ylabel=f"{label} [m$^{unit[-1]}$]")
        if len(axes.get_legend_handles_labels()[1]) > 1:
            axes.legend(fontsize="small")

    def _draw_where(self, axes: Any, rows: NDArray[np.bool_], **style: Any) -> Any:
        q, density = self.wavenumber[rows], self.density[rows]
        return axes.plot(q, density, ".", markersize=3, **style)[0]


def _flags(flags: Any) -> NDArray[np.uint8] | None:
    """Return the flags of rows, sums of 1, 2 and 4."""
    if flags is None:
        return None
    numbers = vector(flags, "flag")
    wrong = ~np.isin(numbers, range(8))
    if wrong.any():
        i = int(wrong.argmax())
        raise must_be("", "a whole number from 0 to 7", f"flag[{i}] = {numbers[i]}")
    return frozen(numbers.astype(np.uint8))


def _two_axes(entries: Any, name: str, columns: str) -> Array | None:
    if entries is None:
        return None
    array = np.array(real_array(entries, name), order="C")
    if array.ndim != 2:
        allowed = Must(": must have "), f"two axes, rows and {columns}"
        raise InvalidInput(Argument(name), " = ", valued(array), *allowed)
    return frozen(array)
