"""What the app knows: the tables of one scene, and what is computed of them. No page is in here."""

import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from asperity.app.files import Folder
from asperity.app.guess import Guess, guess_columns, rubber_of
from asperity.app.loaded import OPTIONAL, editable, loaded, usable, usual
from asperity.app.opened import Dropped, Tables, opened
from asperity.app.words import in_words
from asperity.base.diagnostics import Error, InvalidInput, Note
from asperity.base.quantities import ZERO_CELSIUS
from asperity.demo import hot_scene_text, input_files
from asperity.io import plausible
from asperity.scene.kept import KeptBuilders
from asperity.scene.model import Scene, SceneFriction
from asperity.scene.scene import scene_text

Said = TypeVar("Said", Error, Note)
_MOST_KEPT = 20  # parts of scenes: of one there are up to five
MOST_VARIANTS = 7  # curves beside the present one: so many colours are told apart
# Files are read in a thread; what is edited meanwhile must not be lost, so what was read becomes a
# part of the state only where this is called, in the thread that edits. It returns what is to say.
Take = Callable[[], str]

LAW = {
    "rms_height_m": 265.7e-6,
    "hurst": 0.87,
    "q0_per_m": 2000.0,
    "q1_per_m": 1e6,
    "slope_cutoff": 1.3,
}


@dataclass(frozen=True)
class Variant:
    name: str
    tables: Tables
    scene: Scene
    curves: SceneFriction


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
        self._builders = KeptBuilders(_MOST_KEPT)

    # --- what is edited ---

    @property
    def tables(self) -> Tables:
        """The scene as it is now: what is not used is not in it."""
        of_parts = {"surface": self.surfaces[self.surface], "rubber": self.rubbers[self.rubber]}
        others = {name: getattr(self, name) for name in ("conditions", *OPTIONAL)}
        all_tables = {**of_parts, **others}
        used = {*all_tables} - {*OPTIONAL} | self.used
        return usable({name: table for name, table in all_tables.items() if name in used})

    @property
    def text(self) -> str:
        return self.text_of(self.tables)

    def text_of(self, tables: Tables) -> str:
        """A scene file, which says as what its files were dropped."""
        text, shown = scene_text(tables), list(self.folder.shown.items())
        said = [f"# {n} was dropped as {s}\n" for n, s in shown if n in text]
        return "".join(said) + text

    def use(self, table: str, wanted: bool) -> None:
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

    def open_scene(self, dropped: Dropped) -> Take:
        """Read a scene file, and of other files only those that were dropped with it. What cannot
        be shown is refused; to take it returns the name of the scene."""
        name, tables, kept = opened(dropped, self.folder)
        try:
            tables = editable(name, tables)
            loaded(self._path, usable(tables), self._builders)
        except Error as error:
            said = self.said(error)
            for one in kept:
                self.folder.forget(one)
            raise said from None

        def take() -> str:
            self._show(name, tables)
            return name

        return take

    def _show(self, name: str, tables: Tables) -> None:
        self.surface, self.rubber = f"surface of {name}", f"rubber of {name}"
        self.surfaces = {**self.surfaces, self.surface: tables["surface"]}
        self.rubbers = {**self.rubbers, self.rubber: tables["rubber"]}
        self.conditions = tables["conditions"]
        self.used = {table for table in OPTIONAL if table in tables}
        self.adhesion_left = False
        for table in self.used:
            setattr(self, table, tables[table])

    def keep_scan(self, shown: str, content: bytes) -> str:
        """Keep a scan, which is to be read with its pixel size and unit, if it states none."""
        if self.scan is not None and self.scan not in self._named:
            self.folder.forget(self.scan)
        self.scan = self.folder.keep(shown, content)
        return self.scan

    def use_scan(self, settings: Mapping[str, Any]) -> Take:
        """Read the scan that was kept, to be the surface. What cannot be read is refused."""
        if self.scan is None:
            raise InvalidInput("no scan was dropped yet")
        table = {"file": self.scan, **settings}
        self._builders.surface(self._path, table)

        def take() -> str:
            self.surfaces["your scan"] = table
            self.surface = "your scan"
            self._leave_shipped_adhesion()
            return ""

        return take

    @property
    def _named(self) -> str:
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
            raise said from None
        return name

    def use_dma(self, names: list[str], settings: Mapping[str, Any]) -> Take:
        """Read measured moduli, to be the rubber: `columns`, `units` and `modulus` as a scene has
        them. To take them returns what there is to say of the files."""
        with plausible.collected():  # notes are those of the scene
            table, middle, said = rubber_of(self.folder, names, settings)
        celsius = round((middle or 293.15) - ZERO_CELSIUS, 2)

        def warmed(conditions: dict[str, Any]) -> dict[str, Any]:
            stated = {"temperature_k", "temperature_c"} & conditions.keys()
            return conditions if stated else {**conditions, "temperature_c": celsius}

        conditions = warmed(self.conditions)
        kelvin = conditions.get("temperature_k") or conditions["temperature_c"] + ZERO_CELSIUS
        self._builders.rubber(self._path, table, kelvin if "isotherms" in table else None)
        name = "your sweeps" if "isotherms" in table else "your master curve"

        def take() -> str:
            self.rubbers[name], self.rubber = table, name
            self.conditions = warmed(self.conditions)
            self._leave_shipped_adhesion()
            return said

        return take

    def _leave_shipped_adhesion(self) -> None:
        """The shear stress of the demo was fitted to the shipped scan and rubber: with other files
        it would say anything."""
        if self.adhesion is self._shipped_adhesion and "adhesion" in self.used:
            self.use("adhesion", False)
            self.adhesion_left = True

    # --- what is computed ---

    def load(self, tables: Tables | None = None) -> Scene:
        """The scene of the tables, which a thread is given; without any, that of now."""
        return loaded(self._path, self.tables if tables is None else tables, self._builders)

    def said(self, one: Said) -> Said:
        return one.said(self.folder.as_shown).said(in_words)

    def keep_variant(self, name: str, tables: Tables, scene: Scene, curves: SceneFriction) -> None:
        """Keep a curve beside those to come; `tables` are those that it was computed of."""
        if len(self.variants) >= MOST_VARIANTS:
            raise InvalidInput(f"{MOST_VARIANTS} curves are kept: must remove one first")
        taken = {one.name for one in self.variants}
        plain = "".join(one for one in name if one.isprintable()).replace("/", "-").strip()[:40]
        plain = plain or f"variant {len(self.variants) + 1}"
        while plain in taken:
            plain += "'"
        self.variants.append(Variant(plain, tables, scene, curves))

    def close(self) -> None:
        self.folder.close()
