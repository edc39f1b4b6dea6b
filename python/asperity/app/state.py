"""What the app knows: the tables of one scene, and what is computed of them. No page is in here."""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from asperity._core import Error, InvalidInput
from asperity.app.corrections import OF_PEAKS, usual
from asperity.app.dma import rubber_of
from asperity.app.files import Folder
from asperity.app.guess import Guess, guess_columns
from asperity.app.opened import Dropped, Tables, opened
from asperity.app.remembered import Remembered, RememberedCorrection
from asperity.app.words import in_words
from asperity.demo import hot_scene_text, input_files
from asperity.io import plausible
from asperity.scene.model import Curves, Scene
from asperity.scene.rubber import build_measured, build_rubber
from asperity.scene.scene import Builders, load_scene
from asperity.scene.surface import build_surface
from asperity.scene.write import scene_text

OPTIONAL = ("correction", "adhesion", "heating", "solver", "uncertainty")
MOST_VARIANTS = 7  # curves beside the present one: so many colours are told apart
_Built = TypeVar("_Built")

LAW = {
    "rms_height_m": 265.7e-6,
    "hurst": 0.87,
    "q0_per_m": 2000.0,
    "q1_per_m": 1e6,
    "slope_cutoff": 1.3,
}


@dataclass(frozen=True)
class Variant:
    """A curve that was kept for comparison, with the scene that it came from."""

    name: str
    tables: Tables
    scene: Scene
    curves: Curves


class State:
    """One session: a folder with its files, the alternatives of each part, and which is chosen."""

    def __init__(self) -> None:
        self.folder = Folder()
        tables = tomllib.loads(hot_scene_text())
        name = self.folder.keep("scan.npy", input_files()["scan.npy"])
        self.surfaces: dict[str, dict[str, Any]] = {
            "shipped scan": {**tables["surface"], "file": name},
            "law": dict(LAW),
        }
        self.rubbers: dict[str, dict[str, Any]] = {"shipped surrogate": tables["rubber"]}
        self.surface, self.rubber = "shipped scan", "shipped surrogate"
        self.conditions: dict[str, Any] = tables["conditions"]
        self.correction: dict[str, Any] = usual("partial-contact", None)
        self.adhesion = self._shipped_adhesion = tables["adhesion"]
        self.adhesion_left = False  # since it does not fit files that were dropped
        self.heating: dict[str, Any] = tables["heating"]
        self.solver: dict[str, Any] = {}
        self.uncertainty: dict[str, Any] = {}
        self.used = {"correction", "adhesion"}  # of the tables that a scene can be without
        self.scan: str | None = None  # the file that was dropped last
        self.guesses: dict[str, Guess] = {}  # by the names of files
        self.variants: list[Variant] = []
        remembered = (Remembered(build_surface), _rubber_builder())
        self._builders = Builders(*remembered, RememberedCorrection())

    # --- what is edited ---

    @property
    def tables(self) -> Tables:
        """The scene as it is now: what is not used is not in it."""
        all_tables = {
            "surface": self.surfaces[self.surface],
            "rubber": self.rubbers[self.rubber],
            "conditions": self.conditions,
            "correction": self.correction,
            "adhesion": self.adhesion,
            "heating": self.heating,
            "solver": self.solver,
            "uncertainty": self.uncertainty,
        }
        tables = {
            name: dict(table)
            for name, table in all_tables.items()
            if name not in OPTIONAL or name in self.used
        }
        if "heating" in tables and "adhesion" not in tables:
            tables["heating"].pop("interface_share", None)  # of what adhesion makes
        if not self.knows_temperature:
            for key in ("temperature_k", "temperature_c"):
                tables["conditions"].pop(key, None)
        return tables

    @property
    def knows_temperature(self) -> bool:
        """Whether the rubber is known at others than its own."""
        return bool({"isotherms", "shift", "wlf_c1"} & self.rubbers[self.rubber].keys())

    @property
    def text(self) -> str:
        """The scene file."""
        return self.text_of(self.tables)

    def text_of(self, tables: Tables) -> str:
        """A scene file, which says as what its files were dropped."""
        text = scene_text(tables)
        said = [f"# {n} was dropped as {s}\n" for n, s in self.folder.shown.items() if n in text]
        return "".join(said) + text

    def use(self, table: str, wanted: bool) -> None:
        """Let the scene have a table, or be without it."""
        (self.used.add if wanted else self.used.discard)(table)
        self.adhesion_left = self.adhesion_left and table != "adhesion"

    def choose_correction(self, kind: str, scene: Scene | None = None) -> None:
        """One of those that are offered for the scene, with its usual arguments, or none."""
        self.use("correction", kind != "none")
        if kind != "none":
            self.correction = usual(kind, scene)

    def set_velocities(self, low: float, high: float) -> None:
        """A sweep between two velocities [m/s], four points a decade."""
        points = max(round(4 * abs(math.log10(high / low))) + 1, 9)
        sweep = {"from": low, "to": high, "points": points}
        self.conditions = {**self.conditions, "velocity_m_s": sweep}

    @property
    def velocities(self) -> tuple[float, float]:
        """The slowest and the fastest [m/s], however the scene has them."""
        given = self.conditions["velocity_m_s"]
        if isinstance(given, dict):
            return given["from"], given["to"]
        return float(np.min(given)), float(np.max(given))

    def keep_velocities(self, low: float, high: float) -> None:
        """Of the velocities those within the two [m/s]; the two, where none is."""
        ends = self.velocities
        kept = max(low, min(ends)), min(high, max(ends))
        self.set_velocities(*(kept if kept[0] < kept[1] else (low, high)))

    def open_scene(self, dropped: Dropped) -> str:
        """Let a scene file be what is shown, and return its name; of other files only those that
        were dropped with it are read. One that is refused changes nothing."""
        before = dict(vars(self))
        shown = dict(self.folder.shown)
        name, tables = opened(dropped, self.folder)
        try:
            _check_shown(name, tables)
            self._take(name, tables)
            self.load()
        except Error as error:
            said = self.said(error)
            vars(self).update(before)
            for one in self.folder.shown.keys() - shown.keys():
                self.folder.forget(one)
            raise type(error)(said) from None
        return name

    def _take(self, name: str, tables: Tables) -> None:
        self.surface, self.rubber = f"surface of {name}", f"rubber of {name}"
        rubber, conditions = tables["rubber"], tables["conditions"]
        for key in ("temperature_k", "temperature_c"):  # the slider's place
            if key in rubber:
                rubber, conditions = dict(rubber), {**conditions, key: rubber[key]}
                del rubber[key]
        self.surfaces = {**self.surfaces, self.surface: tables["surface"]}
        self.rubbers = {**self.rubbers, self.rubber: rubber}
        self.conditions = conditions
        self.used = {table for table in OPTIONAL if table in tables}
        self.adhesion_left = False
        for table in self.used:
            setattr(self, table, tables[table])

    def keep_scan(self, shown: str, content: bytes) -> None:
        """Keep a scan, which is to be read with its pixel size and unit, if it states none."""
        if self.scan is not None and self.scan not in self._named:
            self.folder.forget(self.scan)
        self.scan = self.folder.keep(shown, content)

    def use_scan(self, settings: Mapping[str, Any]) -> None:
        """Let the scan that was kept be the surface. What cannot be read is refused, and the
        surface stays as it was."""
        if self.scan is None:
            raise InvalidInput("no scan was dropped yet")
        table = {"file": self.scan, "detrend": "quadratic", "slope_cutoff": 1.3, **settings}
        self._builders.surface(self._path, table)
        self.surfaces["your scan"] = table
        self.surface = "your scan"
        self._leave_shipped_adhesion()

    @property
    def _named(self) -> str:
        """All that names files."""
        return repr([self.surfaces, self.rubbers, [one.tables for one in self.variants]])

    @property
    def _path(self) -> Path:
        return self.folder.path / "scene.toml"

    def keep_dma(self, shown: str, content: bytes) -> str:
        """Keep a file of sweeps and guess its columns; what they are is for the user to say."""
        name = self.folder.keep(shown, content)
        try:
            self.guesses[name] = guess_columns(self.folder.path / name)
        except Error as error:
            said = self.said(error)
            self.folder.forget(name)
            raise type(error)(said) from None
        return name

    def take_dma(self, names: list[str], settings: Mapping[str, Any]) -> str:
        """Let measured moduli be the rubber: `columns`, `units` and `modulus` as a scene has them.
        Returns what there is to say of the files."""
        with plausible.collected():  # notes are those of the scene
            table, said = rubber_of(self.folder, names, settings)
        conditions = self.conditions
        if "temperature_k" not in conditions:
            middle = table.get("reference_temperature_k", 293.15) - 273.15
            conditions = {**conditions}
            conditions.setdefault("temperature_c", round(middle, 2))
        kelvin = conditions.get("temperature_k") or conditions["temperature_c"] + 273.15
        self._builders.rubber(self._path, table, kelvin if "isotherms" in table else None)
        name = "your sweeps" if "isotherms" in table else "your master curve"
        self.conditions, self.rubber = conditions, name
        self.rubbers[name] = table
        self._leave_shipped_adhesion()
        return said

    def _leave_shipped_adhesion(self) -> None:
        """The shear stress of the demo was fitted to the shipped scan and rubber: with other files
        it would say anything."""
        if self.adhesion is self._shipped_adhesion and "adhesion" in self.used:
            self.use("adhesion", False)
            self.adhesion_left = True

    # --- what is computed ---

    def load(self) -> Scene:
        """The scene, read from its file as the shell reads it."""
        of_peaks = self.correction["kind"] in OF_PEAKS if "correction" in self.used else False
        if of_peaks and "file" not in self.surfaces[self.surface]:
            problem = "this correction takes the peaks of a scan: choose a scan, or another one"
            raise InvalidInput(problem)
        self._path.write_text(self.text, encoding="utf-8")
        return load_scene(self._path, for_friction=True, builders=self._builders)

    def said(self, error: Exception) -> str:
        """An error in the words of the page."""
        return in_words(self.folder.as_shown(" ".join(str(error).split())))

    def keep_variant(self, name: str, scene: Scene, curves: Curves) -> None:
        """Keep the present curve beside those to come."""
        if len(self.variants) >= MOST_VARIANTS:
            raise InvalidInput(f"{MOST_VARIANTS} curves are kept: must remove one first")
        taken = {one.name for one in self.variants}
        plain = "".join(one for one in name if one.isprintable()).replace("/", "-").strip()[:40]
        plain = plain or f"variant {len(self.variants) + 1}"
        while plain in taken:
            plain += "'"
        self.variants.append(Variant(plain, self.tables, scene, curves))

    def close(self) -> None:
        self.folder.close()


def _rubber_builder() -> Remembered:
    """The rubber, whose isotherms are shifted once for all temperatures."""
    return Remembered(partial(build_rubber, measured=Remembered(build_measured)))


def _check_shown(name: str, tables: Tables) -> None:
    """Refuse what the shell computes but the page has no place for."""
    conditions = tables["conditions"]
    for key in ("pressure_pa", "temperature_k", "temperature_c"):
        if isinstance(conditions.get(key, 0.0), list | dict):
            problem = "the page shows one pressure and one temperature: must be a number"
            raise InvalidInput(f"{name}: [conditions] {key}: {problem}")
