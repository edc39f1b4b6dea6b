"""The part of the result: mu(v), which roughness makes it, notes, variants and downloads."""

import asyncio
from collections.abc import Callable
from functools import partial
from html import escape
from typing import Any

import numpy as np
from nicegui import background_tasks, ui

from asperity.app import downloads
from asperity.app.charts import Options, contributions_chart, friction_chart
from asperity.app.parts import Picture, chart, menu, part, redraw, redraw_series
from asperity.app.state import State
from asperity.app.words import allowed_velocities, in_one_line
from asperity.app.worker import Found, Shows, Worker, contributions, in_thread
from asperity.base.diagnostics import Error, Note, html_items
from asperity.plot.design import design_figure
from asperity.report.contents import numbers_of
from asperity.report.errors import errors_of, solved_contacts
from asperity.scene.design import design_at_largest, worth_text
from asperity.scene.model import Scene, SceneFriction

_NONE = "There are no slopes for this scene: with heat, strain, directions or the contact of a scan"


class DesignPart:
    """What each decade of the modulus and of the wavelength is worth; once it is looked at."""

    def __init__(self, worker: Worker) -> None:
        self._worker = worker
        self._drawn: Scene | None = None  # that is shown
        opened = ui.expansion("What makes the friction: 10 % more", on_value_change=self._seen)
        with opened.classes("w-full").props("dense") as self._opened:
            self._picture = Picture(wide=True)
            self._others = ui.label("").classes("soft")

    def show(self) -> None:
        """Follow the scene, where this is open."""
        background_tasks.create(self._compute())

    async def _seen(self, event: Any) -> None:
        if event.value:
            await self._compute()

    async def _compute(self) -> None:
        found: Found | None = self._worker.found
        if found is None or not self._opened.value or found.scene is self._drawn:
            return
        scene, mu = found.scene, found.best.mu
        design = await in_thread(partial(design_at_largest, scene, mu))
        self._drawn = scene
        if design is None:
            self._picture.hide()
            self._others.set_text(_NONE)
            return
        others = worth_text(design)
        self._others.set_text(f"More of the others: {others}")
        said = "What 10 % more is worth in mu, by decade of frequency and of wavelength"
        self._picture.show(partial(design_figure, design), f"{said}; {others}")


_NOTHING = "There are no notes: input, correction and theory are within their ranges."


class ResultPart(Shows):
    def __init__(self, state: State, worker: Worker, refreshed: Callable[[], None]) -> None:
        """`refreshed` is called where a button here has changed the conditions."""
        self._state, self._worker, self._refreshed = state, worker, refreshed
        self._at: float | None = None  # velocity of the contributions [m/s]
        with part("Result", "result-title") as self._whole:
            self._status = ui.label("computing ...").classes("soft").props('role="status"')
            self._problem = ui.label("").classes("problem").props('role="alert"')
            self._remedy = ui.button("", on_click=self._mend).props("no-caps outline color=blue-9")
            self._remedy.set_visibility(False)
            self._chart = chart({}, "Friction coefficient over velocity", "24rem")
            with ui.element("div").classes("flex items-center gap-2 w-full"):
                self._name = ui.input("Name of this curve").props("dense outlined").classes("grow")
                keep = ui.button("Keep for comparison", on_click=self._keep)
                keep.props('no-caps outline color="blue-9"')
            self._kept = ui.element("div").classes("flex gap-2 w-full")
            self._downloads()
            with ui.expansion("Errors and notes", value=True).classes("w-full").props("dense"):
                self._notes = ui.html("", sanitize=False, tag="ul").classes("list-disc pl-5")
            opened = ui.expansion("Which roughness makes the friction", on_value_change=self._seen)
            with opened.classes("w-full").props("dense") as self._origin:
                self._velocity = menu("At velocity [m/s]", [], None, self._chosen)
                self._velocity.classes("w-48", remove="w-full")
                self._shares = chart({}, "Contributions by wavenumber")
            self._design = DesignPart(worker)
            with ui.expansion("Numbers").classes("w-full").props("dense"):
                self._table = ui.html("", sanitize=False).classes("w-full overflow-auto max-h-96")
                self._table.props('tabindex="0" role="region" aria-label="Table of the numbers"')
            with ui.expansion("The scene file").classes("w-full").props("dense"):
                ui.label("asperity friction scene.toml gives the same digits.").classes("soft")
                self._text = ui.html("", sanitize=False, tag="pre")
                self._text.classes("text-xs overflow-auto max-h-96 w-full")
                self._text.props('tabindex="0" role="region" aria-label="Text of the scene file"')
        self._draw_variants()

    # --- what was computed ---

    def show_curve(self, found: Found) -> None:
        """The curve alone, at once: the rest of the page follows."""
        if not self._chart.options:  # there is nothing on the page yet
            self.show(found)
            return
        self._busy(True)
        redraw_series(self._chart, self._drawn(found))

    def show(self, found: Found) -> None:
        best = found.best
        k = int(best.mu[0].argmax())
        said = f"largest mu {best.mu[0, k]:.4g} at {found.scene.velocity[k]:.3g} m/s"
        follows = (
            "" if found.whole else "; heat follows" if found.curves is None else "; band follows"
        )
        self._status.set_text(f"{said}{follows}")
        self._problem.set_text("")
        self._remedy.set_visibility(False)
        redraw(self._chart, self._drawn(found), f"Friction coefficient mu over velocity: {said}")
        if found.curves is not None:
            self._tell(found)
            self._text.set_content(f"<code>{escape(self._state.text_of(found.tables))}</code>")
            self._offer_velocities(found)
            self._design.show()
        self._busy(not found.whole)

    def wait(self, said: str) -> None:
        self._status.set_text(said)

    def fail(self, error: Error) -> None:
        found = self._worker.found
        self._problem.set_text(in_one_line(error))
        self._busy(False)
        allowed = allowed_velocities(error)
        self._remedy.set_visibility(allowed is not None)
        if allowed is not None:
            self._remedy.set_text(f"Show {allowed[0]:g} to {allowed[1]:g} m/s, which are known")
            self._allowed = allowed
        if found is None or found.curves is not None:
            self._status.set_text("not computed: the curve is that of before")
            return
        self._status.set_text("computed without heat alone")
        self._tell(found)

    async def _mend(self) -> None:
        """Let the velocities be those of the present ones that the rubber is known at."""
        self._state.keep_velocities(*self._allowed)
        self._refreshed()
        await self._worker.changed()

    def _drawn(self, found: Found) -> Options:
        cold = None if found.curves is None else found.cold
        return friction_chart(found.scene, found.best, cold, self._state.variants)

    def _busy(self, busy: bool) -> None:
        """Whether more of this scene is to follow, for whoever reads the page with a program."""
        said = "true" if busy else "false"
        code = f"document.getElementById('{self._whole.html_id}').ariaBusy = '{said}'"
        self._chart.client.run_javascript(code)

    def _tell(self, found: Found) -> None:
        """Errors, notes and numbers, each as one piece of HTML: single elements take the page
        longer than the curve."""
        errors = [f"error of {one}: {size}" for one, size, _ in errors_of(found.scene, found.best)]
        solved = solved_contacts(found.scene)
        if solved is not None:
            errors.append(f"{solved[0]} contacts of the scan are solved, on up to {solved[1]}")
        items = "".join(f"<li>{escape(one)}</li>" for one in errors)
        notes = [self._state.said(one) for one in found.best.notes] or [Note(_NOTHING)]
        self._notes.set_content(html_items(notes) + items)
        self._table.set_content(_table(found.scene, found.best))

    def _offer_velocities(self, found: Found) -> None:
        v = found.scene.velocity
        offered = {float(one): f"{one:.3g}" for one in v[:: max(1, v.size // 12)]}
        k = int(found.best.mu[0].argmax())
        if self._at not in offered:
            self._at = min(offered, key=lambda one: abs(np.log(one / v[k])))
        self._velocity.set_options(offered, value=self._at)
        background_tasks.create(self._contribute())

    async def _seen(self, event: Any) -> None:
        if event.value:
            await self._contribute()

    async def _chosen(self, event: Any) -> None:
        if event.value is not None and event.value != self._at:
            self._at = event.value
            await self._contribute()

    async def _contribute(self) -> None:
        found, velocity = self._worker.found, self._at
        if found is None or velocity is None or not self._origin.value:
            return
        shares = partial(contributions, found.scene, velocity)
        made = await self._worker.attempt(shares, self._problem.set_text)
        if made is None:
            return
        q, density = made
        name = f"Contributions to the hysteresis by wavenumber at {velocity:.3g} m/s"
        redraw(self._shares, contributions_chart(q, density), name)

    # --- variants ---

    async def _keep(self) -> None:
        found = self._worker.found
        if found is None or found.curves is None:
            self._problem.set_text("there is no curve to keep yet")
            return
        try:
            name = self._name.value or ""
            self._state.keep_variant(name, found.tables, found.scene, found.curves)
        except Error as error:
            self._problem.set_text(in_one_line(self._state.said(error)))
            return
        self._name.value = ""
        self._draw_variants()
        self.show(found)

    def _draw_variants(self) -> None:
        self._kept.clear()
        with self._kept:
            for variant in self._state.variants:
                self._chip(variant.name)

    def _chip(self, name: str) -> None:
        def remove() -> None:
            self._state.variants = [one for one in self._state.variants if one.name != name]
            self._draw_variants()
            if self._worker.found is not None:
                self.show(self._worker.found)

        button = ui.button(name, icon="close", on_click=remove)
        button.props('no-caps dense outline color="grey-9"')
        button.props["aria-label"] = f"Remove {name} from the comparison"

    # --- downloads ---

    def _downloads(self) -> None:
        state, give = self._state, downloads
        makes: dict[str, tuple[str, Callable[[Any, downloads.Tell], downloads.Make]]] = {
            "Scene": ("scene.zip", lambda f, _: give.scene_archive(state)),
            "CSV": ("friction.csv", lambda f, _: lambda: give.table_csv(f.scene, f.curves)),
            "Picture": ("friction.svg", lambda f, _: self._picture(f)),
            "Report": ("report.html", lambda f, tell: give.report_of(state, tell)),
            "Map": ("friction.fmap", lambda f, tell: lambda: give.map_of(f.scene, tell).to_bytes()),
            "FMU": ("friction.fmu", lambda f, tell: lambda: give.fmu_of(f.scene, tell)),
        }
        with ui.element("div").classes("flex gap-2 py-2") as group:
            group.props('role="group" aria-label="Downloads"')
            for label, (name, make) in makes.items():
                self._download(label, name, make)

    def _picture(self, found: Found) -> downloads.Make:
        kept = list(self._state.variants)
        named = [("this scene", found.scene), *((one.name, one.scene) for one in kept)]
        curves = [found.best, *(one.curves for one in kept)]
        return lambda: downloads.picture(named, curves)

    def _download(
        self, label: str, name: str, make: Callable[[Any, downloads.Tell], downloads.Make]
    ) -> None:
        async def give() -> None:
            found = self._worker.found
            if found is None or found.curves is None:
                self._problem.set_text("there is nothing to download yet")
                return
            button.props("loading")
            self._status.set_text(f"{label} is made ...")
            loop = asyncio.get_running_loop()

            def tell(line: str) -> None:
                loop.call_soon_threadsafe(self._status.set_text, f"{label} is made: {line}")

            try:
                content = await self._worker.attempt(make(found, tell), self._problem.set_text)
                if content is not None:
                    ui.download.content(content, name)
                    self._status.set_text(f"{name} is downloaded")
            finally:
                button.props(remove="loading")

        button = ui.button(label, icon="download", on_click=give)
        button.props('no-caps dense unelevated color="blue-9"').classes("px-2")


def _table(scene: Scene, curves: SceneFriction) -> str:
    names, rows = numbers_of([scene], [curves])
    head = "".join(f'<th scope="col">{name}</th>' for name in names)
    cells = ["".join(f"<td>{one}</td>" for one in row) for row in rows]
    body = "".join(f"<tr>{row}</tr>" for row in cells)
    title = "<caption>Friction coefficient</caption>"
    return (
        f'<table class="numbers">{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'
    )
