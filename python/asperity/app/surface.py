"""The part of the surface: a scan that is dropped, the shipped one, or a law."""

import base64
import io
from typing import Any

import numpy as np
from nicegui import background_tasks, ui

from asperity._core import Error
from asperity.app.charts import spectrum_chart
from asperity.app.parts import Changed, Quantity, chart, controls, part, redraw
from asperity.app.state import State
from asperity.app.upload import Upload
from asperity.app.words import in_one_line
from asperity.app.worker import Shows, Worker, in_thread
from asperity.base.arguments import brief
from asperity.scene.model import Scene
from asperity.scene.scan import LAY, flat
from asperity.scene.surface import SURFACE
from asperity.surface import HeightMap

_UNITS = {"": "as the file says", "m": "m", "mm": "mm", "um": "µm", "nm": "nm"}
_DETREND = {"plane": "tilted", "quadratic": "curved", "offset": "neither"}
_MOST_PIXELS = 360  # of a side of the picture


class SurfacePart(Shows):
    """Where the surface is chosen, its map and its spectrum."""

    def __init__(self, state: State, worker: Worker) -> None:
        self._state, self._worker = state, worker
        self._drawn: object = None
        with part("Surface", "surface-title"):
            self._choice = (
                ui.select(
                    list(state.surfaces),
                    value=state.surface,
                    label="Surface",
                    on_change=self._chosen,
                )
                .props("dense outlined")
                .classes("w-full")
            )
            self._scan_fields()
            with ui.element("div").classes("w-full") as self._law:
                self._law_fields()
            self._problem = ui.label("").classes("problem").props('role="alert"')
            self._facts = ui.label("").classes("soft")
            self._map = ui.image("").props('no-spinner fit="contain"').classes("w-full")
            self._map.props('alt="Map of the heights"').set_visibility(False)
            self._map_facts = ui.label("").classes("soft")
            self._chart = chart({}, "Roughness spectrum", renderer="canvas")
        self._see()

    def _scan_fields(self) -> None:
        self._upload = Upload("Drop a scan here, or choose a file", self._taken, self._say)
        self._settings: dict[str, Any] = {}  # what is not in here is as in the shell
        with ui.expansion("How the scan is read").classes("w-full").props("dense"):
            field = "dense outlined debounce=500"
            ui.input("Pixel size [µm]: one number, or dy, dx", on_change=self._pixel).props(
                f'{field} hint="empty where the file states it"'
            ).classes("w-full")
            ui.select(_UNITS, value="", label="Unit of the heights", on_change=self._unit).props(
                "dense outlined"
            ).classes("w-full")
            tilted = SURFACE["detrend"].default
            ui.select(_DETREND, value=tilted, label="The scan is", on_change=self._detrend).props(
                "dense outlined"
            ).classes("w-full")
            self._end("q0_per_m", "q0 [1/m], where the spectrum begins", "as the scan is long")
            self._end("q1_per_m", "q1 [1/m], where it ends", "at pi / pixel")
            self._end("slope_cutoff", "rms slope at which it ends", "no such end")
            ui.input("Most drop-outs [%]", on_change=self._dropouts).props(
                f'{field} hint="of the points: 10 where it is empty"'
            ).classes("w-full")
            ui.checkbox("Take the self-affine fit instead of the rings", on_change=self._fit)
            ui.checkbox("Keep the directions of its roughness", on_change=self._directional)

    def _law_fields(self) -> None:
        law = self._state.surfaces["law"]
        controls(SURFACE, law, self._set)
        end = self._set("slope_cutoff")
        Quantity("rms slope at which it ends", law["slope_cutoff"], (0.01, 5), end)

    def _set(self, key: str) -> Changed:
        async def changed(value: Any) -> None:
            self._state.surfaces["law"][key] = value
            await self._worker.changed()

        return changed

    async def _chosen(self, event: Any) -> None:
        if event.value == self._state.surface:
            return
        self._state.surface = event.value
        self._see()
        await self._worker.changed()

    async def _taken(self, files: list[tuple[str, bytes]]) -> None:
        name, content = files[-1]
        try:
            await in_thread(lambda: self._state.keep_scan(name, content))
        except Error as error:
            self._say(in_one_line(self._state.said(error)))
            return
        await self._read()

    async def _use(self) -> None:
        """Read it again where a field has changed."""
        async with self._upload.turn:
            await self._read()

    async def _read(self) -> None:
        """Read the scan that was dropped as the fields say."""
        if self._state.scan is None:
            return
        given = {key: value for key, value in self._settings.items() if value not in ("", None)}
        self._say("reading the scan ...")
        try:
            take = await in_thread(lambda: self._state.use_scan(given))
        except Error as error:
            self._say(in_one_line(self._state.said(error)))
            return
        take()
        self._say("")
        self.refresh()
        await self._worker.changed()

    async def _pixel(self, event: Any) -> None:
        try:
            sizes = [float(one) * 1e-6 for one in str(event.value).split(",") if one.strip()]
        except ValueError:
            self._say(f"pixel size {brief(event.value)}: must be a number, or two: dy, dx")
            return
        sizes = [float(f"{one:.12g}") for one in sizes]
        self._settings["pixel_size_m"] = (
            None if not sizes else sizes[0] if len(sizes) == 1 else sizes
        )
        await self._use()

    async def _unit(self, event: Any) -> None:
        self._settings["unit"] = event.value
        await self._use()

    async def _detrend(self, event: Any) -> None:
        self._settings["detrend"] = event.value
        await self._use()

    def _end(self, key: str, label: str, empty: str) -> None:
        """A field for an end of the spectrum, which is as `empty` says where it is empty."""

        async def changed(event: Any) -> None:
            try:
                self._settings[key] = float(event.value) if event.value else None
            except ValueError:
                self._say(f"{label} {brief(event.value)}: must be a number")
                return
            await self._use()

        shown = ui.input(label, on_change=changed).classes("w-full")
        shown.props(f'dense outlined debounce=500 hint="empty: {empty}"')

    async def _dropouts(self, event: Any) -> None:
        try:
            share = float(str(event.value).replace(",", ".")) / 100 if event.value else None
        except ValueError:
            self._say(f"drop-outs {brief(event.value)}: must be a number")
            return
        self._settings["max_dropouts"] = None if share is None else float(f"{share:.6g}")
        await self._use()

    async def _fit(self, event: Any) -> None:
        self._settings["fit"] = "self-affine" if event.value else None
        await self._use()

    async def _directional(self, event: Any) -> None:
        self._settings["directional"] = True if event.value else None
        await self._use()

    def _see(self) -> None:
        self._law.set_visibility(self._state.surface == "law")

    def _say(self, problem: str) -> None:
        self._problem.set_text(problem)

    def refresh(self) -> None:
        """Show the choices of another scene."""
        self._choice.set_options(list(self._state.surfaces), value=self._state.surface)
        self._see()

    def show_scene(self, scene: Scene) -> None:
        if scene.surface is self._drawn:
            return
        self._drawn = scene.surface
        spectrum = scene.spectrum
        self._facts.set_text(
            f"rms height {1e6 * spectrum.rms_height:.4g} µm, rms slope {spectrum.rms_slope:.3g}, "
            f"from {spectrum.q0:.4g} to {spectrum.q1:.4g} 1/m" + _lay_text(scene)
        )
        name = f"Roughness spectrum C(q) over the wavenumber; {self._facts.text}"
        redraw(self._chart, spectrum_chart(scene), name)
        background_tasks.create(self._show_map(scene))

    async def _show_map(self, scene: Scene) -> None:
        shown = await in_thread(lambda: map_of(scene))
        if scene.surface is not self._drawn:
            return
        self._map.set_visibility(shown is not None)
        self._map_facts.set_visibility(shown is not None)
        if shown is not None:
            picture, facts = shown
            self._map.set_source(picture)
            self._map.props(f'alt="Map of the heights; {facts}"')
            self._map_facts.set_text(facts)


def _lay_text(scene: Scene) -> str:
    """How much steeper it is across its ridges, where it has any."""
    lay = scene.surface.lay
    if lay is None or not lay.ratio > LAY:
        return ""
    return f"; {lay.ratio:.3g} times as steep across its ridges, at {lay.degrees:.0f}° from x to y"


def map_of(scene: Scene) -> tuple[str, str] | None:
    """A picture of the map's heights as an address, and what it shows; None of lines and laws."""
    from matplotlib.image import imsave

    scan = scene.surface.scan
    if not isinstance(scan, HeightMap):
        return None
    detrend = scene.surface.values["detrend"]
    shown = flat(scan, None if detrend == "none" else detrend)
    assert isinstance(shown, HeightMap)
    ny, nx = shown.heights.shape
    step = -(-max(ny, nx) // _MOST_PIXELS)
    heights = np.asarray(shown.heights[::step, ::step], float)
    low, high = np.nanpercentile(heights, [0.2, 99.8])
    out = io.BytesIO()
    imsave(out, heights, cmap="cividis", vmin=float(low), vmax=float(high), format="png")
    dy, dx = shown.pixel_size
    facts = (
        f"{1e3 * nx * dx:.4g} by {1e3 * ny * dy:.4g} mm, {nx} by {ny} points; heights from "
        f"{1e6 * low:.3g} (dark) to {1e6 * high:.3g} µm (light), trend removed"
    )
    return "data:image/png;base64," + base64.b64encode(out.getvalue()).decode(), facts
