"""A scene: a TOML file that names the parts of a computation, read into objects of the core."""

import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.adhesion import Adhesion, AdhesionFit
from asperity.base.arguments import path_of
from asperity.contact import contact_area, contact_notes, pressure_distribution
from asperity.correction import Correction
from asperity.friction import Friction, friction
from asperity.heating import Heating
from asperity.io import plausible
from asperity.io.fields import (
    MOST_ROWS,
    Field,
    arguments,
    count,
    names_of,
    nearest,
    number,
    read_table,
    refuse,
    rename_in_errors,
    require,
    sweep,
    text,
)
from asperity.io.files import check_file
from asperity.rubber import Rubber
from asperity.scene.heat import TEMPERATURE, check_heated, temperatures_of
from asperity.scene.parts import (
    build_adhesion,
    build_correction,
    build_heating,
    heating_in_errors,
)
from asperity.scene.rubber import BuiltRubber, build_rubber, stiffest
from asperity.scene.surface import Surface, build_surface
from asperity.spectrum import Spectrum
from asperity.uncertainty.band import Bounds, DrawAdhesion, swept_band

_POINTS = {
    "pressure_pa": Field(sweep, "pressure", plausible.PRESSURE),
    "velocity_m_s": Field(sweep, "velocity", plausible.VELOCITY),
}
_CONDITIONS = {**_POINTS, **TEMPERATURE, "poisson_ratio": Field(number, "poisson_ratio")}
_SOLVER = {"rtol": Field(number, "rtol")} | {name: Field(text, name) for name in ("form", "method")}
_NAMES = {**names_of("conditions", _CONDITIONS), **names_of("solver", _SOLVER)}
_UNCERTAINTY = {
    "samples": Field(count, "samples"),
    "seed": Field(count, "seed"),
    "level": Field(number, "level"),
}
_TABLES = dict.fromkeys(
    (
        "surface",
        "rubber",
        "conditions",
        "correction",
        "adhesion",
        "heating",
        "solver",
        "uncertainty",
    )
)

COLUMNS = ("mu", "hysteresis", "adhesion", "contact_area", "shift_factor", "error_estimate")
_CHUNK = 64  # points between two steps of a progress bar, or two looks at Ctrl-C

Progress = Callable[[list[slice]], AbstractContextManager[Iterable[slice]]]


@dataclass(frozen=True, eq=False)
class Curves:
    """Results of a scene, arrays of shape (pressures, velocities)."""

    notes: list[str]
    mu: NDArray[np.float64]
    hysteresis: NDArray[np.float64]
    adhesion: NDArray[np.float64]
    contact_area: NDArray[np.float64]
    shift_factor: NDArray[np.float64]
    error_estimate: NDArray[np.float64]
    model_error: NDArray[np.float64] | None = None  # relative, of the hysteresis; NaN: unknown
    hot_temperature: NDArray[np.float64] | None = None  # T(q1) [K], and mu without heat
    mu_cold: NDArray[np.float64] | None = None
    band: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None  # lower and upper mu

    def within(self, band: Bounds) -> "Curves":
        """The same with a band on mu, and what there is to say of it."""
        return replace(self, band=(band.lower, band.upper), notes=[*self.notes, *band.notes])


@dataclass(frozen=True, eq=False)
class Scene:
    """The parts that a scene file names, as objects of the core.

    `inputs` holds what was used, defaults included, by table and key; `derived` what the surface
    turned out to be.
    """

    path: Path
    surface: Surface
    built_rubber: BuiltRubber
    pressure: NDArray[np.float64]  # [Pa], shape (n,)
    velocity: NDArray[np.float64]  # [m/s], shape (m,)
    correction: Correction | None
    adhesion: Adhesion | None
    options: Mapping[str, Any]  # poisson_ratio, rtol, form, method
    inputs: Mapping[str, Mapping[str, Any]]
    sampling: Mapping[str, Any]  # samples, seed and level of a band
    stated_rtol: float | None  # of [solver], None where the default holds
    unusual: Sequence[str]  # numbers that their units make unlikely
    temperature: float | None = None  # of [conditions] [K]
    heating: Heating | None = None
    others: Sequence["Scene"] = ()  # the same at the further temperatures of a list

    @property
    def spectrum(self) -> Spectrum:
        return self.surface.spectrum

    @property
    def rubber(self) -> Rubber:
        return self.built_rubber.rubber

    @property
    def notes(self) -> list[str]:
        """What the inputs give to note, before anything is computed."""
        return [*self.unusual, *self.surface.notes, *self.built_rubber.notes]

    @property
    def derived(self) -> Mapping[str, Any]:
        return self.surface.derived

    @property
    def sources(self) -> list[Path]:
        """The scene file and the files that it names."""
        rubber = self.inputs["rubber"]
        names = [self.inputs["surface"].get("file"), rubber.get("master_curve")]
        names += [rubber.get("shift"), *rubber.get("isotherms", [])]
        return [self.path, *(self.path.parent / name for name in names if name is not None)]

    @property
    def points(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Every pressure with every velocity, flat; a pressure's velocities side by side."""
        pressure, velocity = np.meshgrid(self.pressure, self.velocity, indexing="ij")
        return pressure.ravel(), velocity.ravel()

    def friction(self, progress: Progress = nullcontext) -> Curves:
        """Friction at every pressure and velocity; `progress` sees the chunks of points."""
        compute = partial(friction, adhesion=self.adhesion, **self.options)
        if self.heating is not None:
            compute = partial(
                compute,
                temperature=self.temperature,
                shift=self.built_rubber.shift,
                heating=self.heating,
            )
        with heating_in_errors(self.path) if self.heating else nullcontext():
            parts: list[Friction] = self._at_points(compute, progress)
        shape = (self.pressure.size, self.velocity.size)
        notes = dict.fromkeys(self.notes)
        notes |= dict.fromkeys(note for part in parts for note in part.notes)
        columns = {
            name: np.concatenate([getattr(part, name) for part in parts]).reshape(shape)
            for name in (*COLUMNS, "model_error")
        }
        if self.heating is not None:
            columns["hot_temperature"] = np.concatenate([_known(p.temperature) for p in parts])
            columns["mu_cold"] = np.concatenate([_known(p.cold).mu for p in parts])
            columns |= {n: columns[n].reshape(shape) for n in ("hot_temperature", "mu_cold")}
        return Curves(notes=list(notes), band=None, **columns)

    @property
    def asks_for_band(self) -> bool:
        return "uncertainty" in self.inputs

    @property
    def has_errors(self) -> bool:
        """Whether standard errors of the surface, the rubber or the adhesion are known."""
        return self.has_measured_errors or isinstance(self.adhesion, AdhesionFit)

    @property
    def has_measured_errors(self) -> bool:
        """Whether those of the surface or of the rubber are."""
        return self.surface.drawn.draw is not None or self.built_rubber.drawn.draw is not None

    def band(
        self,
        mu: NDArray[np.float64],
        progress: Progress = nullcontext,
        refit: DrawAdhesion | None = None,
    ) -> Bounds:
        """Lower and upper mu, of the shape of `mu`, as the standard errors would have it."""
        with rename_in_errors(self.path, {**_NAMES, **names_of("uncertainty", _UNCERTAINTY)}):
            band = swept_band(
                self.surface.drawn,
                self.built_rubber.drawn,
                self.adhesion,
                self.pressure,
                self.velocity,
                {
                    "poisson_ratio": self.options["poisson_ratio"],
                    "form": self.options["form"],
                    "correction": self.correction,
                },
                progress=progress,
                refit=refit,
                **self.sampling,
            )
        return Bounds(mu * band.lower, mu * band.upper, band.notes)

    def contact_area(
        self, wavenumber: NDArray[np.float64], progress: Progress = nullcontext
    ) -> NDArray[np.float64]:
        """A/A0 of shape (pressures, velocities, wavenumbers); `progress` as in `friction`."""
        compute = partial(contact_area, wavenumber=wavenumber, **self.options)
        parts: list[NDArray[np.float64]] = self._at_points(compute, progress)
        return np.concatenate(parts).reshape(self.pressure.size, self.velocity.size, -1)

    def contact_notes(self) -> list[str]:
        """Where the theory leaves its range at some of the points."""
        compute = partial(contact_notes, **self.options)
        parts: list[tuple[str, ...]] = self._at_points(compute, nullcontext)
        notes = dict.fromkeys(self.notes)
        return list(notes | dict.fromkeys(note for part in parts for note in part))

    def _at_points(self, compute: Callable[..., Any], progress: Progress) -> list[Any]:
        """What the core's `compute` gives for each chunk of the points."""
        pressure, velocity = self.points
        chunks = [slice(i, i + _CHUNK) for i in range(0, pressure.size, _CHUNK)]
        rubber = self.built_rubber.at_reference if self.heating else self.rubber
        with progress(chunks) as shown, rename_in_errors(self.path, _NAMES):
            return [
                compute(
                    self.spectrum,
                    rubber,
                    pressure=pressure[chunk],
                    velocity=velocity[chunk],
                    correction=self.correction,
                )
                for chunk in shown
            ]

    def pressure_distribution(
        self, stress: NDArray[np.float64], wavenumber: float
    ) -> NDArray[np.float64]:
        """P(sigma) [1/Pa] at the first pressure and velocity; only the exact form has one."""
        options = {key: value for key, value in self.options.items() if key != "form"}
        with rename_in_errors(self.path, _NAMES):
            density: NDArray[np.float64] = pressure_distribution(
                stress,
                self.spectrum,
                self.rubber,
                pressure=self.pressure[0],
                velocity=self.velocity[0],
                wavenumber=wavenumber,
                correction=self.correction,
                **options,
            )
        return density


def _known(one: Any) -> Any:
    assert one is not None
    return one


def load_scene(path: str | Path, *, for_friction: bool = False) -> Scene:
    """Read a scene file and build the parts that it names.

    `for_friction`: it may ask for heat and for several temperatures, which only friction and its
    map know.

    Raises
    ------
    InvalidInput, OutOfRange
        In one line: file, table and key, the value found and what is allowed.
    """
    with plausible.collected() as notes:
        scene = _load(path_of(path, "path"), for_friction)
    return replace(scene, unusual=tuple(notes))


def _load(path: Path, for_friction: bool) -> Scene:
    tables = _read_toml(path)
    conditions = read_table(path, "conditions", tables["conditions"], _CONDITIONS)
    require(path, "conditions", conditions, tuple(_POINTS))
    solver = read_table(path, "solver", tables.get("solver", {}), _SOLVER)
    points = {key: conditions.pop(key) for key in _POINTS}
    conditions = {"poisson_ratio": 0.5, **conditions}
    stated_rtol = solver.get("rtol")
    solver = {"rtol": 1e-6, "form": "exact", "method": "gauss", **solver}

    rows = points["pressure_pa"].size * points["velocity_m_s"].size
    if rows > MOST_ROWS:
        problem = f"pressure_pa times velocity_m_s are {rows} points: must be at most {MOST_ROWS}"
        refuse(path, "[conditions]", problem)

    surface = build_surface(path, tables["surface"])
    temperatures = temperatures_of(path, conditions)
    if not for_friction:
        if len(temperatures) > 1:
            problem = "several are for asperity friction and map alone: must be one"
            refuse(path, "[conditions] temperature", problem)
        if "heating" in tables:
            refuse(
                path, "[heating]", "is known to asperity friction and map alone: must be left out"
            )
    rubbers = [build_rubber(path, tables["rubber"], t) for t in temperatures]
    rubber = rubbers[0]
    where = f"{path}: [conditions] pressure_pa"
    plausible.check_load(where, points["pressure_pa"], stiffest(rubber.rubber))
    inputs = {
        "surface": surface.values,
        "rubber": rubber.values,
        "conditions": {
            **{key: tables["conditions"][key] for key in _POINTS},
            **{key: one for key, one in tables["conditions"].items() if key in TEMPERATURE},
            **conditions,
        },
    }
    correction = adhesion = None
    if "correction" in tables:
        correction, inputs["correction"] = build_correction(
            path, tables["correction"], surface.spectrum, surface.scan, surface.values
        )
    if "adhesion" in tables:
        adhesion, inputs["adhesion"] = build_adhesion(path, tables["adhesion"])
    heating = None
    if "heating" in tables:
        heating, inputs["heating"] = build_heating(path, tables["heating"])
        check_heated(path, tables, temperatures[0], rubber)
    inputs["solver"] = solver
    sampling = {"samples": 100, "seed": 0, "level": 0.95}
    if "uncertainty" in tables:
        sampling |= read_table(path, "uncertainty", tables["uncertainty"], _UNCERTAINTY)
        inputs["uncertainty"] = sampling
        if surface.drawn.draw is None and rubber.drawn.draw is None:
            problem = (
                "no standard errors are known: the surface must be a file, or the rubber isotherms"
            )
            refuse(path, "[uncertainty]", problem)
    first = Scene(
        path=path,
        surface=surface,
        built_rubber=rubber,
        pressure=points["pressure_pa"],
        velocity=points["velocity_m_s"],
        correction=correction,
        adhesion=adhesion,
        options={**arguments(conditions, _CONDITIONS), **arguments(solver, _SOLVER)},
        inputs=inputs,
        sampling=sampling,
        stated_rtol=stated_rtol,
        unusual=(),
        temperature=temperatures[0],
        heating=heating,
    )
    further = zip(rubbers[1:], temperatures[1:], strict=True)
    others = [replace(first, built_rubber=one, temperature=t) for one, t in further]
    return replace(first, others=others)


def _read_toml(path: Path) -> dict[str, Any]:
    """Tables of a scene file, of which the three that every scene needs are there."""
    try:
        check_file(path)
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        refuse(path, "cannot be read", error.strerror or str(error))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        refuse(path, "not a TOML file", str(error))
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error
    except (ValueError, RecursionError):  # Python's limits
        refuse(path, "not a TOML file", "nested too deeply, or a number of thousands of digits")
    for name, table in tables.items():
        if name not in _TABLES:
            hint = nearest(name, _TABLES, "[{}]")
            kind, field = ("table", f"[{name}]") if isinstance(table, dict) else ("key", name)
            refuse(path, field, f"unknown {kind}, {hint}")
    for name in ("surface", "rubber", "conditions"):
        if name not in tables:
            refuse(path, f"[{name}]", "missing: a scene needs this table")
    return tables
