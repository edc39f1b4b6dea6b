"""Friction maps for simulators: certified, looked up in nanoseconds."""

import os
import struct
from collections.abc import Callable
from dataclasses import field
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity._core import InvalidInput, OutOfRange
from asperity.adhesion import Adhesion
from asperity.base.arguments import Array, brief, broadcast, choice, flag, path_of, real_array
from asperity.base.diagnostics import MUST_BE, Argument, Note, fatal_first, must_be, refusal, valued
from asperity.base.parameters import column
from asperity.base.table import Column, Columns, Table
from asperity.base.value import value
from asperity.io.files import check_file, write_whole

Outside = Literal["error", "nan", "clamp"]
POLICIES = ("error", "nan", "clamp")
# of the core's look-ups, and of their status
_PLACES = ("pressure", "velocity", "a_T", "temperature", "distance", "direction")
_NAN, _CLAMP = 0, 1
_OUTSIDE = {1: ("pressure", "Pa"), 2: ("velocity", "m/s"), 4: ("temperature", "K")}
_MAGIC, _HEAD = b"ASPERMAP", 512
_TEXT_AT, _COLD_AT = 188, 144  # bytes from the beginning of a file's head
NOTE_LINE = "note: "  # such a line of the text holds a note


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

    dmu_dlnp: Any = column("1")
    dmu_dlnv: Any = column("1")

    def _draw(self, axes: Any) -> None:
        for name in ("dmu_dlnp", "dmu_dlnv"):
            axes.plot(np.ravel(getattr(self, name)), "o-", label=name)
        axes.set(xlabel="point", ylabel="slope of mu")
        axes.legend()


def _look_up(name: str, told: str) -> Callable[..., Any]:
    """Return the method of a map that gives one of the core's look-ups [-] or, as derivatives,
    `FrictionSlopes`."""

    def look_up(
        self: "FrictionMap",
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        a_T: ArrayLike = 1.0,  # noqa: N803
        temperature: ArrayLike | None = None,
        distance: ArrayLike | None = None,
        direction: ArrayLike | None = None,
        shift_adhesion: bool = False,
        outside: Outside = "error",
    ) -> Any:
        if name == "mu":
            plain = type(pressure) is type(velocity) is type(a_T) is float and a_T == 1.0
            plain = plain and temperature is distance is direction is None
            if plain and shift_adhesion is False and type(outside) is str and outside in POLICIES:
                mu: float = self._core.mu_at(pressure, velocity)
                if mu == mu:  # what is outside takes the long way round
                    return mu
        places = pressure, velocity, a_T, temperature, distance, direction
        result = self._query(name, places, shift_adhesion, outside)
        if name != "slopes":
            return result
        return FrictionSlopes(dmu_dlnp=result[0], dmu_dlnv=result[1])

    look_up.__name__ = "derivatives" if name == "slopes" else name
    look_up.__qualname__ = f"FrictionMap.{look_up.__name__}"
    look_up.__doc__ = told
    return look_up


@value
class FrictionMap(Table):
    """A friction map: mu over pressure and velocity, to a known error (made by `friction_map`).

    A query takes `pressure` [Pa] and `velocity` [m/s] of either sign, which broadcast, and

    a_T : array_like
        Shift factor of another temperature than that which the map was made for: hysteresis and
        area are those at the velocity a_T v. A map with heat has none: a_T leads from no
        background to another there.
    temperature : array_like, optional
        T0 of the background [K], of a map with heat; needed where it holds more than one.
    distance : array_like, optional
        Slid since rest [m]; by default long ago. A map with heat gives mu_hot + (mu_cold - mu_hot)
        exp(-s / s0) after it, as `Friction.mu_at`, without heat mu does not depend on it.
    direction : array_like, optional
        Of sliding [rad], from the axis that the map was made for (`friction_map(direction=)`)
        towards y, of a map that takes it (`turns`); by default along that axis. Half a turn changes
        nothing. A map for one direction, with heat or of a scan, refuses it; the others are the
        same in every direction.
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
    directional : bool
        Whether there are forces across the sliding, `lateral`, which are off by max_error of
        hysteresis + |lateral| at most.
    turns : bool
        Whether look-ups take a direction.
    temperature : (float, float) or None
        T0 of the background [K], equal ends where the map is for one. None without heat.
    memory_error : float or None
        The relative error that the table of s0 makes in mu after a distance, beside max_error: 99 %
        of points keep it, evenly drawn in ln p, ln v, T0 and in distances up to 3 s0. It is the
        largest of 460 of them, so with a confidence of 99 %. No point is off by more than the heat
        changes mu there. None without heat.
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
    directional: bool = field(init=False)
    turns: bool = field(init=False)
    temperature: tuple[float, float] | None = field(init=False)
    memory_error: float | None = field(init=False)

    def __post_init__(self) -> None:
        self._read("content")

    def _read(self, name: str) -> None:
        if not isinstance(self.content, bytes):
            raise refusal(name, self.content, "bytes")
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
            raise error.within(file) from error
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
    def notes(self) -> tuple[Note, ...]:
        """Where the theory or its input leaves its range, as `friction` notes it on 81 points;
        fatal notes first."""
        lines = (line for line in self.text.split("\n") if line.startswith(NOTE_LINE))
        return tuple(fatal_first(Note.of_line(line.removeprefix(NOTE_LINE)) for line in lines))

    @property
    def adhesion_law(self) -> Adhesion | None:
        """The Adhesion that is added, or None."""
        stress, velocity, width = self._core.info()["adhesion"]
        if stress == 0:
            return None
        return Adhesion(shear_stress=stress, reference_velocity=velocity, width=width)

    @cached_property
    def cold(self) -> "FrictionMap | None":
        """The map without heat that lies in one with it, at its lowest temperature.

        Over the velocity a_T v, a_T that from the lowest temperature to another.
        """
        if self.temperature is None:
            return None
        [text] = struct.unpack_from("<I", self.content, _TEXT_AT)
        [size] = struct.unpack_from("<Q", self.content, _COLD_AT)
        end = len(self.content) - 8 - -(-text // 8) * 8
        return FrictionMap(content=self.content[end - size : end])

    mu = _look_up("mu", "Return the friction coefficient, hysteresis + adhesion [-].")
    hysteresis = _look_up("hysteresis", "Return mu_H (Eq. 22) [-].")
    adhesion = _look_up("adhesion", "Return mu_A (Eq. 23) [-].")
    contact_area = _look_up("contact_area", "Return A/A0 at q1 [-].")
    traction = _look_up(
        "traction",
        """Return the shear traction sign(v) mu p [Pa].

        It is 0 where v = 0 or p <= 0, whatever the map covers.
        """,
    )

    lateral = _look_up(
        "lateral",
        """Return the force across the sliding over the load [-], as `friction` has it.

        On the moving body -lateral p along n, the direction of sliding turned by 90 degrees from x
        towards y. 0 where the map knows no directions.
        """,
    )

    derivatives = _look_up(
        "slopes", "Return d mu / d ln p and d mu / d ln |v|, those of the stored polynomials."
    )

    def sliding_length(
        self,
        velocity: ArrayLike,
        *,
        temperature: ArrayLike | None = None,
        outside: Outside = "error",
    ) -> Any:
        """Return s0 [m], as `Friction.sliding_length` at a middle pressure; None without heat."""
        if self.temperature is None:
            choice(outside, "outside", POLICIES)
            self._check({} if temperature is None else {"temperature": temperature}, False)
            real_array(velocity, "velocity")
            return None
        places = self.pressure[0], velocity, 1.0, temperature, None, None
        return self._query("sliding_length", places, False, outside)[0]

    def _query(
        self, name: str, places: tuple[Any, ...], shift_adhesion: bool, outside: Outside
    ) -> Any:
        """Return one of the core's look-ups: its last axis in the shape of the arguments."""
        policy = choice(outside, "outside", POLICIES)
        shifts = flag(shift_adhesion, "shift_adhesion")
        given = zip(_PLACES, places, strict=True)
        asked = {key: one for key, one in given if one is not None}
        self._check(asked, shifts)
        shape, flat = _columns_of(**asked)
        columns = dict(zip(asked, flat, strict=True))
        options = shifts, _CLAMP if policy == 2 else _NAN
        result, first = getattr(self._core, name)([*map(columns.get, _PLACES)], *options)
        if policy != 1 and first < result.shape[-1]:
            point = {key: float(np.resize(one, first + 1)[first]) for key, one in columns.items()}
            self._refuse(point, options, f"[{first}]" if shape else "")
        if not shape:
            return result[..., 0].item() if result.ndim == 1 else result[:, 0].tolist()
        return result.reshape(*result.shape[:-1], *shape)

    def _check(self, asked: dict[str, Any], shifts: bool) -> None:
        """Refuse what this map has not, wherever the points are."""
        if "direction" in asked and self.directional and not self.turns:
            raise refusal("direction", brief(asked["direction"]), "left out, this map is for one")
        if self.temperature is None:
            if "temperature" in asked:
                result = brief(asked["temperature"])
                allowed = "left out, this map has no heat; give a_T"
                raise refusal("temperature", result, allowed, text=f"{result}")
            return
        if shifts:
            raise refusal("shift_adhesion", "True", "False on a map with heat", text="True")
        a_T = asked["a_T"]  # noqa: N806
        if not (type(a_T) is float and a_T == 1) and np.any(real_array(a_T, "a_T") != 1):
            allowed = "1 on a map with heat, which no a_T takes to another background"
            raise refusal("a_T", a_T, f"{allowed}; give temperature")
        lo, hi = self.temperature
        if "temperature" not in asked and lo != hi:
            raise must_be("temperature", f"given, the map covers [{lo:.12g}, {hi:.12g}] K")

    def _refuse(self, point: dict[str, float], options: tuple[bool, int], index: str) -> None:
        places = point["pressure"], point["velocity"], point["a_T"]
        heat = point.get("temperature", 0.0), point.get("distance", 0.0)
        turned = point.get("direction", 0.0)
        status = self._core.status(*places, *heat, turned, *options)
        if status in _OUTSIDE:
            name, unit = _OUTSIDE[status]
            lo, hi = getattr(self, name)
            shifted = name == "velocity" and point["a_T"] != 1
            rule = "a_T times it must be in" if shifted else "the map covers"
            value = valued(point[name], f"{point[name]:.12g}")
            box = f": {rule} [{lo:.12g}, {hi:.12g}] {unit}"
            raise OutOfRange(Argument(name), f"{index} = ", value, box, code="outside-map")
        rules = [(name, np.isnan(one), "a number") for name, one in point.items() if name != "a_T"]
        rules += [
            ("distance", heat[1] < 0, "0 or more"),
            ("direction", not np.isfinite(turned), "finite"),
            ("a_T", True, "positive and finite"),
        ]
        name, rule = next((name, rule) for name, broken, rule in rules if broken)
        value = valued(point[name], f"{point[name]:.12g}")
        raise InvalidInput(Argument(name), f"{index} = ", value, MUST_BE, rule)

    def _summary(self) -> dict[str, Any]:
        names = ("pressure", "velocity", "max_error", "cells")
        return {name: getattr(self, name) for name in names}

    def _columns(self) -> Columns:
        p, v = np.geomspace(*self.pressure, 61), np.geomspace(*self.velocity, 121)
        # of several temperatures the lowest
        at = None if self.temperature is None else self.temperature[0]
        rows = self._query("points", (p[:, None], v, 1.0, at, None, None), False, "clamp")
        axes = ("pressure", "velocity")
        names = {"mu": 0, "hysteresis": 1, "adhesion": 2, "contact_area": 3}
        names |= {"lateral": 6} if self.directional else {}
        return Columns(
            {"pressure": Column(axes[:1], p, "Pa"), "velocity": Column(axes[1:], v, "m/s")},
            {name: Column(axes, rows[i], "1") for name, i in names.items()},
            {"max_error": self.max_error, "notes": list(self.notes)}
            | ({} if at is None else {"temperature_k": at}),
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
