"""Friction maps for simulators: built to a tolerance, certified, looked up in nanoseconds."""

import os
from collections.abc import Callable
from dataclasses import field
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity._core import InvalidInput, OutOfRange
from asperity.adhesion import Adhesion, adhesion_core
from asperity.base.arguments import (
    MOST_THREADS,
    Array,
    brief,
    broadcast,
    choice,
    flag,
    number,
    path_of,
    real_array,
    whole,
)
from asperity.base.table import Column, Columns, Table
from asperity.base.value import value
from asperity.contact import Form, Method, contact_model, surface_and_rubber
from asperity.correction import Correction
from asperity.io.files import check_file, write_whole
from asperity.rubber import Rubber
from asperity.spectrum import Spectrum

__all__ = ["FrictionMap", "FrictionSlopes", "friction_map"]

Outside = Literal["error", "nan", "clamp"]
POLICIES = ("error", "nan", "clamp")
# of the core's look-ups, and of their status
_NAN, _CLAMP = 0, 1
_PRESSURE_OUTSIDE, _VELOCITY_OUTSIDE = 1, 2
_MAGIC, _HEAD = b"ASPERMAP", 512


@value
class FrictionSlopes(Table):
    """What `FrictionMap.derivatives` returns. Scalars for scalar arguments, else arrays.

    Attributes
    ----------
    dmu_dlnp : float or ndarray
        d mu / d ln p [-].
    dmu_dlnv : float or ndarray
        d mu / d ln |v| [-].
    """

    dmu_dlnp: Any
    dmu_dlnv: Any

    def _columns(self) -> Columns:
        axes = tuple(f"axis_{i}" for i in range(np.ndim(self.dmu_dlnp)))
        names = ("dmu_dlnp", "dmu_dlnv")
        return Columns({}, {name: Column(axes, getattr(self, name), "1") for name in names})

    def _draw(self, axes: Any) -> None:
        for name in ("dmu_dlnp", "dmu_dlnv"):
            axes.plot(np.ravel(getattr(self, name)), "o-", label=name)
        axes.set(xlabel="point", ylabel="slope of mu")
        axes.legend()


@value
class FrictionMap(Table):
    """A friction map: mu over pressure and velocity, to a known error (made by `friction_map`).

    A query takes `pressure` [Pa] and `velocity` [m/s] of either sign, which broadcast, and

    a_T : array_like
        Shift factor of another temperature than that which the map was made for: hysteresis and
        area are those at the velocity a_T v.
    shift_adhesion : bool
        Shift the adhesion too, as if v0 were v0 / a_T.
    outside : {"error", "nan", "clamp"}
        What points outside of the box give: OutOfRange, NaN, or the value at the nearest point of
        the box.

    and raises OutOfRange, or InvalidInput for a NaN where `outside` is not "nan".

    Parameters
    ----------
    content : bytes
        Those of a file.

    Attributes
    ----------
    pressure, velocity : (float, float)
        The map's box [Pa], [m/s].
    rtol : float
        What was asked for [-].
    max_error : float
        Twice the largest relative error of hysteresis and area, on 12 unseen points a cell and its
        lattice [-].
    checked, exceeded : int
        Random points that the finished map was checked on, and how many of them were off by more
        than `max_error`.
    largest_checked_error : float
        The largest relative error among them [-].
    cells : int
        Number of polynomials.
    """

    content: bytes = field(repr=False)
    pressure: tuple[float, float] = field(init=False)
    velocity: tuple[float, float] = field(init=False)
    rtol: float = field(init=False)
    max_error: float = field(init=False)
    checked: int = field(init=False)
    exceeded: int = field(init=False)
    largest_checked_error: float = field(init=False)
    cells: int = field(init=False)

    def __post_init__(self) -> None:
        self._read("content")

    def _read(self, name: str) -> None:
        if not isinstance(self.content, bytes):
            raise InvalidInput(f"{name} = {brief(self.content)}: must be bytes")
        core = _core.FrictionMap(self.content, name)
        self._set(_core=core, **{key: one for key, one in core.info().items() if key in _SHOWN})

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "FrictionMap":
        """Read a map from the file at a `path`.

        Raises
        ------
        InvalidInput
            The file is damaged, truncated or of another version, or it is no regular file.
        OSError
            There is none, or it cannot be read.
        """
        file = path_of(path, "path")
        try:
            check_file(file)
        except InvalidInput as error:
            raise InvalidInput(f"{file}: {error}") from error
        with file.open("rb") as opened:
            content = opened.read(_HEAD)
            if content.startswith(_MAGIC):  # else it is no map, however long
                content += opened.read()
        loaded = cls._made(content=content)
        loaded._read(f"{file}")
        return loaded

    @classmethod
    def from_bytes(cls, content: bytes) -> "FrictionMap":
        """Make a map from the `content` of a file, bytes."""
        return cls(content=content)

    def to_bytes(self) -> bytes:
        """Return the bytes of a file."""
        return self.content

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the map, whole or not at all. InvalidInput where `path` cannot be written."""
        write_whole(path_of(path, "path"), self.content)

    @cached_property
    def text(self) -> str:
        """Lines that say what the map was made of."""
        content: bytes = self._core.info()["text"]
        return content.decode("utf-8", "replace")

    @property
    def notes(self) -> tuple[str, ...]:
        """Where the theory or its input leaves its range, as `friction` notes it on 81 points."""
        lines = (line for line in self.text.split("\n") if line.startswith("note: "))
        return tuple(line.removeprefix("note: ") for line in lines)

    @property
    def adhesion_law(self) -> Adhesion | None:
        """The Adhesion that is added, or None."""
        stress, velocity, width = self._core.info()["adhesion"]
        if stress == 0:
            return None
        return Adhesion(shear_stress=stress, reference_velocity=velocity, width=width)

    def mu(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803  # the field's symbol
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> Any:
        """Return the friction coefficient, hysteresis + adhesion [-]."""
        plain = type(pressure) is type(velocity) is type(a_T) is float and a_T == 1.0
        if plain and shift_adhesion is False and type(outside) is str and outside in POLICIES:
            mu: float = self._core.mu_at(pressure, velocity)
            if mu == mu:  # what is outside takes the long way round
                return mu
        return self._query("mu", pressure, velocity, a_T, shift_adhesion, outside)

    def hysteresis(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> Any:
        """Return mu_H (Eq. 22) [-]."""
        return self._query("points", pressure, velocity, a_T, shift_adhesion, outside)[1]

    def adhesion(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> Any:
        """Return mu_A (Eq. 23) [-]."""
        return self._query("points", pressure, velocity, a_T, shift_adhesion, outside)[2]

    def contact_area(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> Any:
        """Return A/A0 at q1 [-]."""
        return self._query("points", pressure, velocity, a_T, shift_adhesion, outside)[3]

    def traction(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> Any:
        """Return the shear traction sign(v) mu p [Pa].

        It is 0 where v = 0 or p <= 0, whatever the map covers.
        """
        return self._query("traction", pressure, velocity, a_T, shift_adhesion, outside)

    def derivatives(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> FrictionSlopes:
        """Return d mu / d ln p and d mu / d ln |v|, those of the stored polynomials."""
        rows = self._query("points", pressure, velocity, a_T, shift_adhesion, outside)
        return FrictionSlopes(dmu_dlnp=rows[4], dmu_dlnv=rows[5])

    def _query(
        self,
        name: str,
        pressure: ArrayLike,
        velocity: ArrayLike,
        a_T: ArrayLike,  # noqa: N803
        shift_adhesion: bool,
        outside: Outside,
    ) -> Any:
        """Return one of the core's look-ups: its last axis in the shape of the arguments."""
        policy = choice(outside, "outside", POLICIES)
        shape, columns = _columns_of(pressure=pressure, velocity=velocity, a_T=a_T)
        options = flag(shift_adhesion, "shift_adhesion"), _CLAMP if policy == 2 else _NAN
        found, first = getattr(self._core, name)(*columns, *options)
        if policy != 1 and first < found.shape[-1]:
            point = [column[first if column.size > 1 else 0].item() for column in columns]
            self._refuse(point, options, f"[{first}]" if shape else "")
        if not shape:
            return found[..., 0].item() if found.ndim == 1 else found[:, 0].tolist()
        return found.reshape(*found.shape[:-1], *shape)

    def _refuse(self, point: list[float], options: tuple[bool, int], index: str) -> None:
        """Say why a point has no value."""
        status = self._core.status(*point, *options)
        if status == _PRESSURE_OUTSIDE:
            lo, hi = self.pressure
            allowed = f"the map covers [{lo:.12g}, {hi:.12g}] Pa"
            raise OutOfRange(f"pressure{index} = {point[0]:.12g}: {allowed}")
        if status == _VELOCITY_OUTSIDE:
            lo, hi = self.velocity
            rule = "the map covers" if point[2] == 1 else "a_T times it must be in"
            raise OutOfRange(
                f"velocity{index} = {point[1]:.12g}: {rule} [{lo:.12g}, {hi:.12g}] m/s"
            )
        for name, found in zip(("pressure", "velocity"), point[:2], strict=True):
            if np.isnan(found):
                raise InvalidInput(f"{name}{index} = nan: must be a number")
        raise InvalidInput(f"a_T{index} = {point[2]:.12g}: must be positive and finite")

    def _summary(self) -> dict[str, Any]:
        return {
            name: getattr(self, name) for name in ("pressure", "velocity", "max_error", "cells")
        }

    def _columns(self) -> Columns:
        p, v = np.geomspace(*self.pressure, 61), np.geomspace(*self.velocity, 121)
        rows = self._query("points", p[:, None], v, 1.0, False, "clamp")
        axes = ("pressure", "velocity")
        names = ("mu", "hysteresis", "adhesion", "contact_area")
        return Columns(
            {"pressure": Column(axes[:1], p, "Pa"), "velocity": Column(axes[1:], v, "m/s")},
            {name: Column(axes, row, "1") for name, row in zip(names, rows[:4], strict=True)},
            {"max_error": self.max_error, "notes": list(self.notes)},
        )

    def _draw(self, axes: Any) -> None:
        columns = self._columns()
        p, v = (columns.coordinates[name].values for name in ("pressure", "velocity"))
        drawn = axes.contourf(v, p, columns.variables["mu"].values, levels=20)
        axes.figure.colorbar(drawn, ax=axes, label="friction coefficient")
        axes.set(xscale="log", yscale="log", xlabel="velocity [m/s]", ylabel="pressure [Pa]")


_SHOWN = {name for name, one in FrictionMap.__dataclass_fields__.items() if not one.init}


def _columns_of(**given: ArrayLike) -> tuple[tuple[int, ...], list[Array]]:
    """Return the shape that the arguments have together and each flat in it, or of one entry."""
    arrays = {name: real_array(one, name) for name, one in given.items()}
    shapes = {array.shape for array in arrays.values() if array.size != 1 or array.ndim}
    full = all(array.size for array in arrays.values())
    if full and len(shapes) <= 1:  # one of them, or several alike: nothing has to be repeated
        shape = shapes.pop() if shapes else ()
        return shape, [np.ascontiguousarray(array).ravel() for array in arrays.values()]
    return broadcast(**given)


def friction_map(
    spectrum: Spectrum,
    rubber: Rubber,
    *,
    pressure: tuple[float, float],
    velocity: tuple[float, float],
    rtol: float = 1e-4,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    adhesion: Adhesion | None = None,
    form: Form = "exact",
    method: Method = "gauss",
    checked: int = 1_000_000,
    text: str = "",
    threads: int | None = None,
) -> FrictionMap:
    """Build a map of the friction coefficient for simulators to `rtol`, and certify it.

    Cells are halved until hysteresis and contact area keep rtol / 2 on lattices of 5 x 5 and on
    random points that nothing was made from, 12 a cell. There they are held against polynomials
    through 12 x 12 points of the solver each, halved until they keep rtol / 20 on random points of
    their own. Then the finished map is checked against the solver itself on more random points,
    where a mistake of the polynomials would show. Where a Greenwood-Williamson correction changes
    its state (full contact, beyond its range) the map is split along the boundary, where mu has a
    kink.

    Parameters
    ----------
    spectrum, rubber, poisson_ratio, correction, adhesion, form, method
        As for `friction`.
    pressure, velocity : (lo, hi)
        The map's box [Pa], [m/s].
    rtol : float
        Relative, of hysteresis and area and so of mu, 1e-12 to 0.1. Cells grow in number as
        rtol^(-1/2).
    checked : int
        Random points of the last check, 200 random pressures at each of as many random velocities
        as make them up; a million take a second with a Prony series.
    text : str
        Lines to keep in the file, for whoever reads it; unless given, what stands for the
        arguments.
    threads : int, optional
        At most; by default as many as the machine has. The map is the same for any of them.

    Returns
    -------
    FrictionMap

    Raises
    ------
    InvalidInput
        Also where a part of the box has no contact.
    OutOfRange
        The box asks for the modulus outside of a measured master curve.
    NotConverged
        rtol is not met, with 100,000 cells or on a point of the last check; the message has what
        was.

    Examples
    --------
    >>> import asperity
    >>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6]
    ... )
    >>> box = {"pressure": (5e4, 5e5), "velocity": (1e-4, 1)}
    >>> fmap = asperity.friction_map(road, rubber, **box, checked=1000)
    >>> round(fmap.mu(81e3, 1e-2), 4)
    0.0205
    """
    return built(
        spectrum,
        rubber,
        None,
        pressure=pressure,
        velocity=velocity,
        rtol=rtol,
        poisson_ratio=poisson_ratio,
        correction=correction,
        adhesion=adhesion,
        form=form,
        method=method,
        checked=checked,
        text=text,
        threads=threads,
    )


def built(
    spectrum: Spectrum,
    rubber: Rubber,
    told: Callable[[float], None] | None,
    *,
    pressure: tuple[float, float],
    velocity: tuple[float, float],
    rtol: float = 1e-4,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    adhesion: Adhesion | None = None,
    form: Form = "exact",
    method: Method = "gauss",
    checked: int = 1_000_000,
    text: str = "",
    threads: int | None = None,
) -> FrictionMap:
    """`friction_map`, which calls `told` with the share of the work that is done, now and then."""
    if not isinstance(text, str):
        raise InvalidInput(f"text = {brief(text)}: must be a str")
    parts = surface_and_rubber(spectrum, rubber)
    model = contact_model(poisson_ratio, correction, form, 1e-6, method)
    added = adhesion_core(adhesion)
    made_of = {
        "spectrum": spectrum,
        "rubber": rubber,
        "correction": correction,
        "adhesion": adhesion,
    }
    lines = text or "".join(f"{name} = {part!r}\n" for name, part in made_of.items())
    content = _core.build_friction_map(
        *parts,
        model,
        added,
        _sides(pressure, "pressure"),
        _sides(velocity, "velocity"),
        number(rtol, "rtol"),
        whole(checked, "checked"),
        lines,
        0 if threads is None else whole(threads, "threads", lowest=1, highest=MOST_THREADS),
        told,
    )
    return FrictionMap(content=content)


def _sides(found: Any, name: str) -> list[float]:
    sides = real_array(found, name)
    if sides.shape != (2,):
        raise InvalidInput(f"{name} = {brief(found)}: must be (lo, hi)")
    return [float(side) for side in sides]
