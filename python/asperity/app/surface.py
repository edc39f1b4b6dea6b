"""The part of the surface: a scan that is dropped, the shipped one, or a law."""

from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from nicegui import ui

from asperity.app.alternatives import AlternativesPart
from asperity.app.parts import Changed, Quantity, controls, menu
from asperity.app.upload import Upload
from asperity.base.arguments import brief
from asperity.plot.scene import surface_figure
from asperity.scene.model import Scene
from asperity.scene.scan import LAY
from asperity.scene.surface import SURFACE
from asperity.surface import HeightMap

_UNITS = {"": "as the file says", "m": "m", "mm": "mm", "um": "µm", "nm": "nm"}
_DETREND = {"plane": "tilted", "quadratic": "curved", "offset": "neither"}
_ENDS = (
    ("q0_per_m", "q0 [1/m], where the spectrum begins", "as the scan is long"),
    ("q1_per_m", "q1 [1/m], where it ends", "at pi / pixel"),
    ("slope_cutoff", "rms slope at which it ends", "no such end"),
)


class SurfacePart(AlternativesPart):
    table = "surface"

    def _add_fields(self) -> None:
        self._scan_fields()
        with ui.element("div").classes("w-full") as self._law:
            self._law_fields()

    def _scan_fields(self) -> None:
        self._upload = Upload("Drop a scan here, or choose a file", self._taken, self._say)
        self._settings: dict[str, Any] = {}  # what is not in here is as in the shell
        with ui.expansion("How the scan is read").classes("w-full").props("dense"):
            micrometres = "Pixel size [µm]: one number, or dy, dx"
            self._field("pixel_size_m", micrometres, "empty where the file states it", _pixel_size)
            menu("Unit of the heights", _UNITS, "", self._takes("unit"))
            detrend = SURFACE["detrend"].default
            menu("The scan is", _DETREND, detrend, self._takes("detrend"))
            for key, label, empty in _ENDS:
                self._field(key, label, f"empty: {empty}", float)
            share = "of the points: 10 where it is empty"
            self._field("max_dropouts", "Most drop-outs [%]", share, _share)
            fit = self._takes("fit", "self-affine")
            ui.checkbox("Take the self-affine fit instead of the rings", on_change=fit)
            directional = self._takes("directional", True)
            ui.checkbox("Keep the directions of its roughness", on_change=directional)

    def _field(self, key: str, label: str, hint: str, read: Callable[[str], Any]) -> None:
        """A field for a number of the scan, which is as `hint` says where it is empty."""

        async def changed(event: Any) -> None:
            text = str(event.value or "").strip()
            try:
                self._settings[key] = read(text) if text else None
            except ValueError:
                self._say(f"{label} {brief(event.value)}: must be a number")
                return
            await self._use()

        shown = ui.input(label, on_change=changed).classes("w-full")
        shown.props(f'dense outlined debounce=500 hint="{hint}"')

    def _takes(self, key: str, value: Any = None) -> Callable[[Any], Awaitable[None]]:
        """What is called with a choice, for which `value` stands where it is given."""

        async def changed(event: Any) -> None:
            self._settings[key] = event.value if value is None else value if event.value else None
            await self._use()

        return changed

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

    async def _taken(self, files: list[tuple[str, bytes]]) -> None:
        name, content = files[-1]
        if await self._worker.attempt(lambda: self._state.keep_scan(name, content), self._say):
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
        await self._take_up(lambda: self._state.use_scan(given), "reading the scan ...")

    def refresh(self) -> None:
        super().refresh()
        self._law.set_visibility(self._state.surface == "law")

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
        scan = scene.surface.scan
        if isinstance(scan, HeightMap):
            (ny, nx), (dy, dx) = scan.heights.shape, scan.pixel_size
            size = f"{1e3 * nx * dx:.4g} by {1e3 * ny * dy:.4g} mm"
            name = f"Map of the heights; {size}, {nx} by {ny} points. {name}"
        self._picture.show(partial(surface_figure, scene), name)


def _pixel_size(micrometres: str) -> float | list[float]:
    sizes = [float(f"{float(one) * 1e-6:.12g}") for one in micrometres.split(",") if one.strip()]
    return sizes[0] if len(sizes) == 1 else sizes


def _share(percent: str) -> float:
    return float(f"{float(percent.replace(',', '.')) / 100:.6g}")


def _lay_text(scene: Scene) -> str:
    """How much steeper it is across its ridges, where it has any."""
    lay = scene.surface.lay
    if lay is None or not lay.ratio > LAY:
        return ""
    return f"; {lay.ratio:.3g} times as steep across its ridges, at {lay.degrees:.0f}° from x to y"
