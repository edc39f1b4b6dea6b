"""A scene as objects of the core, and what is computed of it."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from functools import partial
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import extrapolation_notes
from asperity.adhesion import Adhesion, AdhesionFit
from asperity.base.arguments import Array, known
from asperity.base.codes import FATAL, NOTES
from asperity.base.diagnostics import Note, OutOfRange, fatal_first
from asperity.base.quantities import temperature_text
from asperity.base.value import value
from asperity.contact import contact_area, contact_notes, pressure_distribution
from asperity.correction import Correction
from asperity.friction import ROUGHLY, Friction, friction
from asperity.heating import Heating
from asperity.io.fields import in_keys, names_of, rename_in_errors
from asperity.results.friction import joined, small_friction_notes
from asperity.results.gradients import reshaped
from asperity.results.heat_notes import with_size_of_heat
from asperity.rubber import Rubber
from asperity.scan_contact import ScanContact
from asperity.scene.celsius import all_in_celsius, celsius_in_errors
from asperity.scene.keys import NAMES, NOTED, UNCERTAINTY, files_of
from asperity.scene.progress import Progress as Progress
from asperity.scene.progress import with_contacts
from asperity.scene.rubber import BuiltRubber
from asperity.scene.surface import Surface
from asperity.spectrum import Spectrum
from asperity.uncertainty.band import Bounds, DrawAdhesion, relative_band, swept_band
from asperity.uncertainty.draws import Inputs

COLUMNS = ("mu", "hysteresis", "adhesion", "contact_area", "shift_factor", "error_estimate")
_SAMPLING = names_of("uncertainty", UNCERTAINTY)
_CHUNK = 64  # points between two steps of a progress bar, or two looks at Ctrl-C

# notes on all points together, and on numbers that a scene checks by its keys
_OF_ALL = {"modulus-extrapolated", "modulus-unmeasured", "small-friction", "lay"}
_OF_ALL |= {code for code in NOTES if code.startswith(("absurd-", "unusual-", "squashed-"))}
_OF_STRAIN = "strain-beyond-sweeps"
# what a spectrum does not know of a surface
_KNOWN_TO_SCANS = {"lines-in-spectrum", "heights-not-gaussian", "gathered-waves"}


@value
class SceneFriction(Friction):
    """Friction of a scene, arrays of shape (pressures, velocities), perhaps with a band on mu."""

    band: tuple[Array, Array] | None = None  # lower and upper mu

    def within(self, band: Bounds) -> "SceneFriction":
        """The same with a band on mu, and what there is to say of it."""
        notes = (*self.notes, *band.notes)
        return self._made(vars(self), band=(band.lower, band.upper), notes=notes)


@dataclass(frozen=True, eq=False)
class Scene:
    """The parts that a scene file names, as objects of the core.

    `inputs` holds what was used, defaults included, by table and key; `derived` what the surface
    turned out to be.
    """

    path: Path
    surface: Surface
    built_rubber: BuiltRubber
    pressure: Array  # [Pa], shape (n,)
    velocity: Array  # [m/s], shape (m,)
    correction: Correction | None
    adhesion: Adhesion | None
    options: Mapping[str, Any]  # poisson_ratio, rtol, form, method
    inputs: Mapping[str, Mapping[str, Any]]
    sampling: Mapping[str, Any]  # samples, seed and level of a band
    stated_rtol: float | None  # of [solver], None where the default holds
    unusual: Sequence[Note]  # numbers that their units make unlikely
    typed: Mapping[str, Any]  # what the file has, by the names that messages use
    temperature: float | None = None  # of [conditions] [K]
    heating: Heating | None = None
    direction_deg: float | None = None  # of [conditions]
    others: Sequence["Scene"] = ()  # the same at further temperatures and directions of lists
    tables: Mapping[str, Any] = field(default_factory=dict)  # that it was built of

    @property
    def spectrum(self) -> Spectrum:
        return self.surface.spectrum

    @property
    def rubber(self) -> Rubber:
        return self.built_rubber.rubber

    @property
    def conditions(self) -> dict[str, Any]:
        """Where friction is wanted, as arguments of `friction`."""
        points = {"pressure": self.pressure[:, None], "velocity": self.velocity}
        heated = {} if self.heating is None else {"temperature": self.temperature}
        others = ("poisson_ratio", "direction", "strain_factors")
        return {**points, **{k: self.options[k] for k in others if k in self.options}, **heated}

    @property
    def notes(self) -> list[Note]:
        """What the inputs give to note, before anything is computed."""
        of_surface = [*self.surface.notes, *self.surface.fitted_heights]
        if isinstance(self.correction, ScanContact):
            of_surface = [note for note in of_surface if note.code not in _KNOWN_TO_SCANS]
        return self._in_its_unit([*self.unusual, *of_surface, *self.built_rubber.notes])

    @property
    def _unsaid(self) -> set[str]:
        """Codes of notes of results that the scene has itself, or answers."""
        return _OF_ALL if self.direction_deg is None else {*_OF_ALL, "along-x"}

    @property
    def derived(self) -> Mapping[str, Any]:
        return self.surface.derived

    @property
    def knows_directions(self) -> bool:
        """Whether a force across the sliding is asked for."""
        return self.spectrum.is_directional or "direction" in self.options

    @property
    def in_celsius(self) -> bool:
        return any(f"[{table}] temperature_c" in self.typed for table in ("conditions", "rubber"))

    def notes_with(self, remarks: Iterable[Note]) -> list[Note]:
        """Its notes and those of a result, in its words."""
        return fatal_first([*self.notes, *self.said(remarks)])

    def said(self, remarks: Iterable[Note]) -> list[Note]:
        """Notes of a result in the words of the scene."""
        named = partial(in_keys, names=NOTED)
        return self._in_its_unit(note.said(named) for note in remarks)

    def _in_its_unit(self, notes: Iterable[Note]) -> list[Note]:
        """Notes with temperatures as the scene, or its isotherms, have them."""
        units = self.built_rubber.values.get("units", {})
        if self.in_celsius or (self.temperature is None and units.get("temperature") == "C"):
            return [note.said(all_in_celsius) for note in notes]
        return [*notes]

    @property
    def temperature_text(self) -> str:
        if self.temperature is None:
            return ""
        return temperature_text(self.temperature, celsius=self.in_celsius)

    def toward(self, direction_deg: float | None) -> "Scene":
        if direction_deg is None:
            return self
        options = {**self.options, "direction": math.radians(direction_deg)}
        return replace(self, direction_deg=direction_deg, options=options)

    @property
    def place_text(self) -> str:
        """Where of the lists of its file it is: its temperature and its direction."""
        direction = "" if self.direction_deg is None else f"{self.direction_deg:.4g}°"
        return ", ".join(filter(None, (self.temperature_text, direction)))

    @property
    def sources(self) -> list[Path]:
        return [self.path, *(self.path.parent / name for name in files_of(self.inputs))]

    @property
    def points(self) -> tuple[Array, Array]:
        """Every pressure with every velocity, flat; a pressure's velocities side by side."""
        pressure, velocity = np.meshgrid(self.pressure, self.velocity, indexing="ij")
        return pressure.ravel(), velocity.ravel()

    def friction(
        self, progress: Progress = nullcontext, *, gradients: bool = False
    ) -> SceneFriction:
        """Friction at every pressure and velocity, perhaps with its slopes; `progress` sees the
        chunks of points, which slopes do not have: they share their rows."""
        if gradients:
            parts = [self.friction_at(*self.points, gradients=True)]
        else:
            parts = self._at_points(self._friction, progress)
        shape = (self.pressure.size, self.velocity.size)
        whole = joined(parts, shape)
        remarks = [note for part in parts for note in part.notes if note.code not in self._unsaid]
        p, v = self.points
        if self._law:
            remarks[:] = with_size_of_heat(
                remarks,
                v,
                self.adhesion is not None,
                lambda k, heating: self.roughly(pressure=p[k], velocity=v[k], heating=heating),
            )
        remarks += extrapolation_notes(v, whole.extrapolated_share.ravel())
        held = [note for note in remarks if note.code == _OF_STRAIN]
        most = max(held, key=attrgetter("value"), default=None)  # of all points
        remarks = [note for note in remarks if note.code != _OF_STRAIN or note is most]
        remarks += small_friction_notes(whole.mu)
        slopes = reshaped(known(parts[0].gradients), shape) if gradients else None
        notes = tuple(self.notes_with(remarks))
        return SceneFriction._made(vars(whole), gradients=slopes, notes=notes)

    @property
    def _friction(self) -> Callable[..., Friction]:
        """`friction` with all that the scene says but for spectrum, rubber, correction, points."""
        compute = partial(friction, adhesion=self.adhesion, **self.options)
        if self.heating is None:
            return compute
        return partial(compute, heating=self.heating, **self._law)

    @property
    def _law(self) -> dict[str, Any]:
        """The temperature and the shift that takes the rubber there from its reference; empty
        where a_T is not known."""
        built = self.built_rubber
        if built.shift is None or built.at_reference is None or built.temperature is None:
            return {}
        return {"temperature": built.temperature, "shift": built.shift}

    def friction_at(
        self,
        pressure: Array,
        velocity: Array,
        *,
        gradients: bool = False,
        contributions: bool = False,
    ) -> Friction:
        """Friction at points of one's own, in one call; errors name the scene's keys. With slopes
        the rubber is that of the reference, shifted, which tells the slope over T."""
        compute = partial(self._friction, contributions=contributions)
        if gradients:
            compute = partial(compute, gradients=True, **self._law)
        with self._in_its_words():
            result: Friction = self._at(compute, pressure, velocity, bool(gradients and self._law))
            return result

    @property
    def roughly(self) -> Callable[..., Friction]:
        """`friction` to a few digits with heat, of the rubber at its reference, shifted."""
        how: Any = {**self.options, **self._law, "adhesion": self.adhesion, "rtol": ROUGHLY}
        rubber: Any = self.built_rubber.at_reference
        return partial(friction, self.spectrum, rubber, correction=self.correction, **how)

    @property
    def asks_for_band(self) -> bool:
        return "uncertainty" in self.inputs

    @property
    def has_errors(self) -> bool:
        """Whether errors of the surface, the rubber, the adhesion or the scan are known."""
        with_errors = isinstance(self.adhesion, AdhesionFit)
        return with_errors or self.has_measured_errors or isinstance(self.correction, ScanContact)

    @property
    def has_measured_errors(self) -> bool:
        """Whether those of the surface or of the rubber are."""
        return self.surface.drawn.draw is not None or self.built_rubber.drawn.draw is not None

    def band(
        self, mu: Array, progress: Progress = nullcontext, refit: DrawAdhesion | None = None
    ) -> Bounds:
        """Lower and upper mu, of the shape of `mu`, as the standard errors would have it."""
        with self._inputs() as inputs:
            progress = with_contacts(progress, self.correction)
            points = self.pressure, self.velocity
            band = swept_band(inputs, *points, progress=progress, refit=refit, **self.sampling)
        return Bounds(mu * band.lower, mu * band.upper, band.notes)

    def band_at(self, pressure: Array, velocity: Array) -> Bounds:
        """The band at points of one's own, over their mu."""
        with self._inputs() as inputs:
            at_points = inputs.with_options(pressure=pressure, velocity=velocity)
            return relative_band(at_points, **self.sampling)

    @contextmanager
    def _inputs(self) -> Iterator[Inputs]:
        """What a band is drawn of, without points."""
        held = ("poisson_ratio", "form", "strain_factors", "direction")
        options = {name: self.options[name] for name in held if name in self.options}
        options["correction"] = self.correction
        built = self.built_rubber
        rubber = built.drawn
        linear = self.sampling["method"] == "linear" and built.drawn_at_reference is not None
        if self.heating is not None or linear:  # slopes know T by the shift
            temperature = built.temperature if self.temperature is None else self.temperature
            options |= {"temperature": temperature, "heating": self.heating}
            rubber = known(built.drawn_at_reference)
        with rename_in_errors(self.path, {**NAMES, **_SAMPLING}, self.typed):
            yield Inputs(self.surface.drawn, rubber, self.adhesion, options)

    def contact_area(self, wavenumber: Array, progress: Progress = nullcontext) -> Array:
        """A/A0 of shape (pressures, velocities, wavenumbers); `progress` as in `friction`."""
        compute = partial(contact_area, wavenumber=wavenumber, **self.options)
        parts: list[Array] = self._at_points(compute, progress)
        return np.concatenate(parts).reshape(self.pressure.size, self.velocity.size, -1)

    def contact_notes(self) -> list[Note]:
        """Where the theory leaves its range at some of the points."""
        compute = partial(contact_notes, **self.options)
        parts: list[tuple[Note, ...]] = self._at_points(compute, nullcontext)
        remarks = [note for part in parts for note in part if note.code not in self._unsaid]
        return self.notes_with(remarks)

    def _at_points(self, compute: Callable[..., Any], progress: Progress) -> list[Any]:
        pressure, velocity = self.points
        chunks = [slice(i, i + _CHUNK) for i in range(0, pressure.size, _CHUNK)]
        with self._in_its_words():
            try:
                with with_contacts(progress, self.correction)(chunks) as shown:
                    return [self._at(compute, pressure[chunk], velocity[chunk]) for chunk in shown]
            except OutOfRange as error:  # of a chunk: it is to offer what serves all velocities
                if error.code != "unknown-modulus":
                    raise
                ends = np.array([self.velocity.min(), self.velocity.max()])
                self._at(compute, pressure[[0, 0]], ends)
                raise

    @contextmanager
    def _in_its_words(self) -> Iterator[None]:
        """Let errors name its keys, and one on a range say at which temperature it is, and whether
        the spectrum did not end where the scene wants."""
        table = "rubber" if self.temperature is None else "conditions"
        names = {**NAMES, "temperature": f"[{table}] temperature_k", **NOTED}
        try:
            with celsius_in_errors(self.typed), rename_in_errors(self.path, names, self.typed):
                yield
        except OutOfRange as error:
            if error.code != "unknown-modulus":
                raise
            more = [" (these differ in mu, see 'Choose where the spectrum ends')"]
            if self.temperature is not None:
                more.append(f"; this is at {self.temperature_text}")
            for note in self.surface.notes:
                more += ["; ", *note.sentence] if note.severity == FATAL else []
            raise error.followed_by(*more) from error

    def _at(
        self, compute: Callable[..., Any], pressure: Array, velocity: Array, shifted: bool = False
    ) -> Any:
        shifted |= self.heating is not None
        rubber = self.built_rubber.at_reference if shifted else self.rubber
        return compute(
            self.spectrum,
            rubber,
            pressure=pressure,
            velocity=velocity,
            correction=self.correction,
        )

    def pressure_distribution(self, stress: Array, wavenumber: float) -> Array:
        """P(sigma) [1/Pa] at the first pressure and velocity; only the exact form has one."""
        kept = self.options.keys() - {"form", "direction"}
        options = {key: self.options[key] for key in kept}
        with rename_in_errors(self.path, NAMES, self.typed):
            density: Array = pressure_distribution(
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
