"""The contact of a scan itself as a correction of the theory."""

import io
import zlib
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import field
from os import PathLike
from typing import Any, Literal, Self, get_args
from zipfile import BadZipFile

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import Array, frozen, path_of, reading
from asperity.base.diagnostics import InvalidInput, must_be, refusal
from asperity.base.parameters import parameter
from asperity.base.table import Column, Columns, Table
from asperity.base.value import Value, value
from asperity.io.archive import read_arrays
from asperity.io.files import check_file, write_whole
from asperity.surface import HeightMap, Periodic

Closing = Literal["blend", "mirror", True]
# of the core's rows
COLUMNS = {
    "rubber": ("1", "fingerprint of the rubber"),
    "heat": ("1", "fingerprint of the heat, 0 without"),
    "strain": ("1", "fingerprint of the strain factors, 0 without"),
    "poisson_ratio": ("1", "Poisson's ratio"),
    "q0": ("1/m", "lower end of the band"),
    "q1": ("1/m", "upper end of the band"),
    "part": ("1", "of the scan: -1 all, 0 to 3 quarters, 4 to 7 pieces, 8 to 11 these low-passed"),
    "coarse": ("1", "1 on half as many points along a side, for the error of the pixels"),
    "pressure": ("Pa", "nominal pressure"),
    "velocity": ("m/s", "v a_T"),
    "direction": ("rad", "of sliding, from x towards y"),
    "contact_area": ("1", "real over nominal contact area"),
    "hysteresis": ("1", "hysteresis"),
    "lateral": ("1", "force across the sliding over the load"),
    "rule_area": ("1", "the same by PartialContact on the map's own rings"),
    "rule_hysteresis": ("1", "the same by PartialContact on the map's own rings"),
    "error": ("1", "complementarity"),
    "seconds": ("s", "to solve it"),
    "points_y": ("1", "of the grid along y"),
    "points_x": ("1", "of the grid along x"),
    "contact_points": ("1", "points of the grid in contact"),
    "interpolation": ("1", "relative error of mu: of the interpolation that this contact checked"),
    "pixels": ("1", "relative error of mu: of the grid"),
    "scan": ("1", "relative error of mu: of having one scan, half of the scatter of its quarters"),
    "joining": ("1", "relative error of mu: of short waves that were solved on pieces alone"),
}


@value
class SolvedContacts(Table):
    """The exact contacts that a `ScanContact` has solved, a row each.

    Attributes
    ----------
    rows : ndarray, shape (n, 25)
        In the order of the columns of `to_dataframe()`. The last four, what `model_error` is made
        of beside `error`, are NaN where they were not judged at that contact.
    """

    rows: Array

    def __len__(self) -> int:
        return len(self.rows)

    def _summary(self) -> dict[str, Any]:
        seconds = self.rows[:, [*COLUMNS].index("seconds")]
        return {"contacts": len(self.rows), "seconds": float(seconds.sum())}

    def _columns(self) -> Columns:
        columns = {
            name: Column(("contact",), self.rows[:, i], *COLUMNS[name])
            for i, name in enumerate(COLUMNS)
        }
        return Columns({}, columns)

    def _draw(self, axes: Any) -> None:
        named = dict(zip(COLUMNS, self.rows.T, strict=True))
        fine = (named["coarse"] == 0) & (named["part"] == named["part"].min(initial=-1))
        for load in np.unique(named["pressure"][fine]):
            here = fine & (named["pressure"] == load)
            order = np.argsort(named["velocity"][here])
            v, mu = named["velocity"][here][order], named["hysteresis"][here][order]
            axes.plot(v, mu, "o-", label=f"{load:.4g} Pa")
        axes.set(xscale="log", xlabel=r"$v\,a_T$ [m/s]", ylabel="hysteresis")
        axes.legend()


@value
class ScanContact(Value):
    """The exact contact of the scan itself, solved at a few velocities and pressures.

    What a spectrum does not know, that tops are worn or peaks are sharp, is worth 20 to 200 % of
    mu. This solves steady sliding of the scan (`asperity.validation.slide`) at some velocities and
    pressures and carries the ratio of exact to theory, `PartialContact` on the map's own rings,
    to all others. At a solved velocity and pressure the result is that of `slide`. `friction(...,
    direction=)` turns the scan, whatever its spectrum knows of directions, and `lateral` is the
    scan's own; each direction has contacts of its own.

    Parameters
    ----------
    height_map : HeightMap
        The scan. Drop-outs are filled (up to 10 %), a plane is taken off unless periodic=True, and
        waves outside of the band of the spectrum are left out.
    periodic : "blend", "mirror" or True
        How the map goes on beyond its sides: its end blended into its beginning over two of its
        shortest waves, by its mirror images, or as it stands.
    tolerance : float
        Estimated largest relative error of mu between solved contacts [-], 0.001 to 0.1. The grid
        has 8 points to the shortest wave that carries slope at 0.02, as many more as the root of
        the tolerance is smaller.

    Attributes
    ----------
    contacts : SolvedContacts
        What has been solved, a table.

    Notes
    -----
    Velocities v a_T lie on a lattice that is halved where the error asks; one lattice serves all
    temperatures. Up to 8 pressures are solved as they are, more on a lattice of a quarter of a
    decade (docs/howto/scan_contact.md). What is solved is kept in the object, which threads may
    share. Of a scan that needs more than 1024 x 1024 points short waves are solved on four pieces
    alone. Where the spectrum goes on beyond the scan the theory goes on.

    `model_error` is of interpolation, pixels, one scan (half of the scatter of its quarters),
    contacts that did not converge and short waves solved on pieces alone, together.

    Examples
    --------
    >>> import asperity
    >>> road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2513, q1=2e4)
    >>> scan = asperity.synthesize(road, shape=(128, 128), pixel_size=0.01 / 128, seed=1)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3]
    ... )
    >>> exact = asperity.ScanContact(scan, periodic=True)
    >>> result = asperity.friction(road, rubber, pressure=1e5, velocity=0.1, correction=exact)
    >>> len(exact.contacts) > 4 and result.model_error < 0.3
    True
    """

    _title = "exact contact of the scan itself"
    height_map: HeightMap = field(kw_only=False)
    periodic: Closing = "blend"
    tolerance: float = parameter(default=0.02, usual=(0.001, 0.1))

    def __post_init__(self) -> None:
        self._take()
        closing = get_args(Periodic).index(self.periodic)
        self._set(_core=_core.ScanContact(self.height_map._core, closing, self.tolerance))

    @property
    def contacts(self) -> SolvedContacts:
        """What has been solved."""
        return SolvedContacts._made(rows=frozen(self._core.contacts()))

    def progress(self, tell: Callable[[int, int], object]) -> AbstractContextManager[None]:
        """Return a context in which calls with this correction show how far they are.

        Parameters
        ----------
        tell : callable
            Is called as `tell(solved, needed)` when more contacts are known to be needed, and after
            each that this thread's call has solved: both count from the beginning of the block.
            What it raises ends the call; what has been solved is kept.

        Examples
        --------
        >>> import asperity
        >>> road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2513, q1=1e4)
        >>> scan = asperity.synthesize(road, shape=(64, 64), pixel_size=0.01 / 64, seed=1)
        >>> rubber = asperity.PronySeries(
        ...     equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3]
        ... )
        >>> exact, seen = asperity.ScanContact(scan, periodic=True), []
        >>> with exact.progress(lambda solved, needed: seen.append((solved, needed))):
        ...     result = asperity.friction(
        ...         road, rubber, pressure=1e5, velocity=0.1, correction=exact
        ...     )
        >>> seen[0][0], seen[-1] == (len(exact.contacts), len(exact.contacts))
        (0, True)
        """
        if not callable(tell):
            raise refusal("tell", tell, "callable")
        watched: AbstractContextManager[None] = _core.WatchedContacts(self._core, tell)
        return watched

    def save(self, path: str | PathLike[str]) -> None:
        """Write the map and what has been solved to `path`, whole or not at all, as .npz."""
        content = io.BytesIO()
        np.savez(
            content,
            heights=self.height_map.heights,
            pixel_size=self.height_map.pixel_size,
            periodic=str(self.periodic),
            tolerance=self.tolerance,
            contacts=self.contacts.rows,
        )
        write_whole(path_of(path, "path"), content.getvalue())

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Return what `save` wrote to `path`. InvalidInput for any other file."""
        file = path_of(path, "path")
        with reading(file):
            try:
                check_file(file)
                saved = read_arrays(file)
                closing = str(saved["periodic"])
                surface = HeightMap(saved["heights"], pixel_size=tuple(saved["pixel_size"]))
                arguments: dict[str, Any] = {
                    "height_map": surface,
                    "tolerance": float(saved["tolerance"]),
                }
                arguments["periodic"] = True if closing == "True" else closing
                return cls(**arguments)._add(saved["contacts"])
            except (InvalidInput, ValueError, TypeError, KeyError, BadZipFile, zlib.error) as error:
                raise InvalidInput(f"is no saved ScanContact: {error}") from error

    def _summary(self) -> dict[str, Any]:
        shape = {"shape": self.height_map.heights.shape, "periodic": self.periodic}
        return shape | {"tolerance": self.tolerance, "contacts": len(self.contacts)}

    def _add(self, contacts: ArrayLike) -> Self:
        """Take contacts as solved; return the object itself."""
        rows = np.asarray(contacts, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] != len(COLUMNS):
            raise must_be("contacts", f"(n, {len(COLUMNS)})", f" has the shape {rows.shape}")
        self._core.add(rows)
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _with_contacts, (self._arguments(), np.array(self.contacts.rows))


def _with_contacts(arguments: Mapping[str, Any], contacts: ArrayLike) -> ScanContact:
    return ScanContact(**arguments)._add(contacts)
