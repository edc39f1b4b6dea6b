"""What the parts of the page are made of: headings, uploads, sliders with a number beside them."""

import asyncio
import json
import math
from collections.abc import Awaitable, Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

from nicegui import background_tasks, events, ui

from asperity.app import downloads
from asperity.app.charts import Options
from asperity.app.worker import in_thread
from asperity.base.parameters import Parameter
from asperity.io.fields import Field

_PAUSE = 0.02  # s between two values of a slider that is moved, or of a number that is typed
_LATER = 0.1  # s after which the field is told what its slider already shows in it
_STILL = 0.3  # s without another scene, after which a picture is drawn: curves go first
_PATIENCE = 0.7  # s that a number may be out of its range, since it is being typed
# The page is drawn anew with each update, which takes longer than the curve: the number beside the
# slider does not wait for one.
_ITS_VALUE = """(event) => {
  const said = String(Number(Number(SAID).toPrecision(3)));
  event.target.setAttribute('aria-valuetext', said);
  event.target.parentElement.querySelector('input:not([type=range])').value = said;
  emit(event.target.value);
}"""


def heading(text: str, level: str) -> None:
    ui.html(escape(text), sanitize=False, tag=level)


@contextmanager
def part(title: str, name: str) -> Iterator[ui.element]:
    """A section of the page with a heading that names it."""
    with ui.element("section").classes("part").props(f'aria-labelledby="{name}"') as section:
        ui.html(escape(title), sanitize=False, tag="h2").props(f'id="{name}"')
        yield section


def chart(options: Options, name: str, height: str = "17rem") -> ui.echart:
    """A chart with a name for who does not see it."""
    made = ui.echart(options, renderer="svg").style(f"height: {height}")
    return made.props(f'role="img" aria-label="{escape(name)}"')


def redraw_series(drawn: ui.echart, options: Options) -> None:
    """Let a chart show other curves at once, without an update of the page."""
    shown = {"series": options["series"], "legend": {"data": options["legend"]["data"]}}
    shown["xAxis"] = {key: options["xAxis"][key] for key in ("min", "max")}
    code = f"?.chart?.setOption({json.dumps(shown)}, {{ replaceMerge: ['series'] }})"
    drawn.client.run_javascript(f"getElement({drawn.id}){code}")


def redraw(drawn: ui.echart, options: Options, name: str) -> None:
    drawn.options.clear()
    drawn.options.update(options)
    drawn.props(f'aria-label="{escape(name)}"')
    drawn.update()


def menu(label: str, options: Any, value: Any, changed: Any = None) -> ui.select:
    made = ui.select(options, value=value, label=label, on_change=changed)
    return made.props("dense outlined").classes("w-full")


class Picture:
    """One of the package's own, drawn in a thread: the last that was asked for, once no other is.
    It stands in a column of the page unless it is `wide`."""

    def __init__(self, *, wide: bool = False) -> None:
        self._style = "print" if wide else "single"
        self._image = ui.image("").props('no-spinner fit="contain"').classes("w-full")
        self._drawing = False
        self.hide()

    def hide(self) -> None:
        self._wanted: tuple[Callable[[Path], bytes], str] | None = None
        self._image.set_visibility(False)

    def show(self, draw: Callable[[Path], bytes], name: str) -> None:
        """Show what `draw` makes, by a name for who does not see it."""
        self._wanted = draw, name
        if not self._drawing:
            background_tasks.create(self._draw())

    async def _draw(self) -> None:
        self._drawing = True
        try:
            while (mine := self._wanted) is not None:
                await asyncio.sleep(_STILL)
                if mine is not self._wanted:
                    continue
                draw, name = mine
                address = await in_thread(partial(downloads.drawn, draw, self._style))
                if mine is self._wanted:
                    self._wanted = None
                    self._image.props["alt"] = name
                    self._image.set_source(address)
                    self._image.set_visibility(True)
        finally:
            self._drawing = False


class Quantity:
    """A slider and a field for one number; both in the unit that is shown.

    The slider is the browser's own: it takes the focus, keys and names as programs for the blind
    expect it.
    """

    def __init__(
        self,
        name: str,
        value: float,
        ends: tuple[float, float],
        changed: Callable[[float], Awaitable[None]],
        *,
        logarithmic: bool = False,
        step: float = 0.01,
    ) -> None:
        self._log, self._changed, self._ends = logarithmic, changed, ends
        self._value = value
        low, high = (self._place(one) for one in ends)
        with ui.element("div").classes("flex items-center gap-3 w-full no-wrap"):
            self._slider = ui.element("input").classes("grow min-w-0")
            self._slider.props(f'type="range" min="{low:g}" max="{high:g}" step="{step:g}"')
            self._slider.props["aria-label"] = f"{name}, slider"
            said = "10 ** event.target.value" if logarithmic else "event.target.value"
            its_value = _ITS_VALUE.replace("SAID", said)
            self._slider.on("input", self._slid, js_handler=its_value, throttle=_PAUSE)
            self._field = ui.input(label=name, value=f"{value:.4g}")
            self._field.props("dense outlined inputmode=decimal")
            self._field.classes("w-44 shrink-0").on_value_change(self._typed)
        self._move()

    def _place(self, value: float) -> float:
        return math.log10(value) if self._log else value

    def _move(self) -> None:
        """Let the slider stand where the number is, and say the number. No property of the element
        has its value: each update of the page would set it back while it is moved."""
        ui.run_javascript(
            f"const slider = document.getElementById('{self._slider.html_id}');"
            f"slider.value = {self._place(self._value):.6g};"
            f"slider.setAttribute('aria-valuetext', '{self._value:.4g}');"
        )

    async def _slid(self, event: events.GenericEventArguments) -> None:
        try:
            place = float(event.args)
        except (TypeError, ValueError):  # no browser of ours sends that
            return
        if not math.isfinite(place):
            return
        value = float(f"{10**place if self._log else place:.3g}")
        value = min(max(value, self._ends[0]), self._ends[1])
        if value == self._value:
            return
        self._value = value
        await self._changed(value)
        await asyncio.sleep(_LATER)
        if value == self._value:
            self._field.error = None
            self._field.value = f"{value:.4g}"

    async def _typed(self, event: Any) -> None:
        try:
            value = float(str(event.value).replace(",", "."))
        except ValueError:
            value = math.nan
        if not self._ends[0] <= value <= self._ends[1]:
            await asyncio.sleep(_PATIENCE)
            if self._field.value == event.value:
                self._field.error = f"{self._ends[0]:g} to {self._ends[1]:g}"
            return
        if value != self._value:
            self._value = value
            await self._changed(value)
            self._move()
        self._field.error = None


_FROM = 50.0  # ratio of a slider's ends above which it is logarithmic

Changed = Callable[[Any], Awaitable[None]]


def controls(
    fields: Mapping[str, Field], table: Mapping[str, Any], changes: Callable[[str], Changed]
) -> None:
    """A slider or a menu for each key whose parameter is declared to have one, and has a value.

    `table` is that of the scene; `changes` gives, for a key of it, what is called with its value.
    """
    for key, field in fields.items():
        value, one = table.get(key, field.default), field.declared
        if one is None or not one.usual or value is None:
            continue
        if one.choices:
            _menu(one, value, changes(key))
        else:
            slider(one, value, changes(key))


def _menu(one: Parameter, value: Any, changed: Changed) -> None:
    async def chosen(event: Any) -> None:
        await changed(event.value)

    menu(_label(one), list(one.usual), value, chosen)


def slider(one: Parameter, value: float, changed: Changed) -> None:
    factor = 1.0
    if one.quantity is not None and one.shown_unit:
        factor, _ = one.quantity.units[one.shown_unit]
    low, high = (float(f"{end / factor:.12g}") for end in one.usual)

    async def shown(number: float) -> None:
        await changed(float(f"{number * factor:.12g}"))

    logarithmic = low > 0 and high / low > _FROM
    Quantity(_label(one), value / factor, (low, high), shown, logarithmic=logarithmic)


def _label(one: Parameter) -> str:
    """Its name with the unit of the slider: "Contact diameter [mm]"."""
    words = one.name.replace("_", " ")
    name = one.label or (words.capitalize() if len(words) > 2 else words)
    unit = (one.shown_unit or one.si_unit).replace("um", "µm")
    return f"{name} [{unit}]" if unit else name
