"""The pictures of a report, each for a page and for a telephone."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

from asperity.draw.style import drawn_in
from asperity.plot import friction as plot_friction
from asperity.plot import scene as plot_scene
from asperity.plot.design import design_figure
from asperity.report.texts import printable
from asperity.scene.design import design_at_largest, worth_text
from asperity.scene.model import Scene, SceneFriction
from asperity.spectrum import SelfAffineSpectrum

_HEAD = re.compile(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<metadata>.*?</metadata>", re.DOTALL)
_STYLE = re.compile(r"<defs>\s*<style.*?</style>\s*</defs>", re.DOTALL)
_SIZE = re.compile(r'\s(?:width|height)="[\d.]+pt"|\sversion="1.1"')
_NAMED = re.compile(r'(\bid="|url\(#|href="#)')


def inline_svg(picture: bytes, name: str, text: str) -> str:
    """The picture as an element of a page. `name` keeps its ids from those of others, and `text` is
    read out in its place."""
    svg = _STYLE.sub("", _HEAD.sub("", picture.decode()))  # the page has that style
    svg = _NAMED.sub(rf"\g<1>{name}-", svg).strip()
    head, end, rest = svg.partition(">")
    head = _SIZE.sub("", head)  # the viewBox stays, the page says how wide
    return f'{head} role="img" aria-label="{escape(text)}"{end}{rest}'


_SVG = Path("picture.svg")  # the kind that is drawn
# Points of letters by the number of panels side by side: the page makes all pictures equally wide.
_LETTERS = {1: 10, 2: 11.5, 3: 14}


@dataclass(frozen=True)
class Figure:
    """A picture as wide as the page, the same in one column, and what stands below it."""

    wide: Any
    narrow: Any
    caption: str


Draw = Callable[[], Figure | None]


class Drawings:
    """Draws for one page: ids are numbered through it."""

    def __init__(self, environment: Any) -> None:
        self._markup: Callable[[str], Any] = environment.filters["safe"]
        self._drawn = 0

    def plain(self, text: str) -> Any:
        return self._markup(text)

    def friction(self, scenes: Sequence[Scene], curves: Sequence[SceneFriction]) -> Figure:
        names = [
            f"{printable(Path(s.path.name))}: mu from {c.mu.min():.3g} to {c.mu.max():.3g}"
            for s, c in zip(scenes, curves, strict=True)
        ]
        heat = "; with heat also mu without it and the rise of the temperature"
        heated = any(scene.heating is not None for scene in scenes)
        caption = (
            "Friction coefficient mu, its hysteresis and adhesion. Shaded: the errors of the "
            "inputs; hatched: the error of the model, where it is known" + heat * heated + "."
        )
        text = f"Friction coefficient over velocity. {'; '.join(names)}."
        profiled = any(s.heating is not None and s.velocity.size > 1 for s in scenes)
        draw = partial(plot_friction.friction_figure, scenes, curves, _SVG)
        return self._figure(draw, text, caption, 1 + heated + profiled)

    def of_file(self, scene: Scene, result: SceneFriction, name: str) -> list[Draw]:
        """What draws the surface of a file, its rubber, and what makes its friction."""
        parts: list[Draw] = [partial(draw, scene, name) for draw in (self._surface, self._rubber)]
        return [*parts, partial(self._design, scene, result, name)]

    def _surface(self, scene: Scene, name: str) -> Figure:
        spectrum = scene.spectrum
        band = f"{spectrum.q0:.4g} to {spectrum.q1:.4g} 1/m"
        law = isinstance(spectrum, SelfAffineSpectrum) and scene.surface.scan is None
        what = "Self-affine roughness spectrum" if law else "Heights of the scan, and its spectrum"
        caption = (
            f"{what}. Grey: the band that is used, {band}, with an rms height of "
            f"{1e6 * spectrum.rms_height:.4g} um and an rms slope of {spectrum.rms_slope:.3g}."
        )
        draw = partial(plot_scene.surface_figure, scene, _SVG)
        panels = 1 if scene.surface.scan is None else 2
        return self._figure(draw, f"Surface of {name}. {caption}", caption, panels)

    def _rubber(self, scene: Scene, name: str) -> Figure:
        built = scene.built_rubber
        made = "" if built.build is None else ", its isotherms and their shift factors"
        at = "" if built.temperature is None else f" at {built.temperature:.5g} K"
        low, high = scene.velocity.min(), scene.velocity.max()
        caption = (
            f"Storage and loss modulus of the rubber{at}{made}. Grey: the frequencies v q that "
            f"sliding at {low:.3g} to {high:.3g} m/s asks for."
        )
        draw = partial(plot_scene.rubber_figure, scene, _SVG)
        panels = 1 if built.build is None else 3
        return self._figure(draw, f"Rubber of {name}. {caption}", caption, panels)

    def _design(self, scene: Scene, result: SceneFriction, name: str) -> Figure | None:
        """What 10 % more of each part is worth where mu is largest; None where nothing tells."""
        found = design_at_largest(scene, result.mu)
        if found is None:
            return None
        known = any(one.temperature is not None for one in found.worths)
        of_dma = ", with the temperature that it has in a DMA at 10 Hz" if known else ""
        caption = (
            "What 10 % more is worth in mu where it is largest: of the modulus by decade of the "
            f"reduced frequency{of_dma}, and of C(q) by decade of wavelength. More of the others: "
            f"{worth_text(found)}."
        )
        draw = partial(design_figure, found, _SVG)
        return self._figure(draw, f"Design of {name}. {caption}", caption, 2)

    def _figure(self, draw: Callable[[], bytes], text: str, caption: str, panels: int) -> Figure:
        from matplotlib import rc_context

        drawn = {}
        for style, kind in (("print", "wide"), ("single", "narrow")):
            self._drawn += 1
            letters: Any = {"font.size": _LETTERS[panels]} if kind == "wide" else {}
            with rc_context(letters), drawn_in(style):
                svg = inline_svg(draw(), f"p{self._drawn}", text)
            drawn[kind] = self._markup(svg.replace("<svg ", f'<svg class="{kind}" ', 1))
        return Figure(drawn["wide"], drawn["narrow"], caption)
