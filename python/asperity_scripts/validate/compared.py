"""mu(v) and A(v) of a map by exact sliding contact, beside what the theory says of it."""

import math
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import Note
from asperity.correction import Correction, NayakSFactor, PartialContact, SFactor
from asperity.draw.figure import legend, new_figure, picture
from asperity.draw.style import colours, grey
from asperity.friction import friction
from asperity.rubber import Rubber
from asperity.scene.progress import Progress, line_on
from asperity.surface import HeightMap
from asperity.validation.sliding import SlidingStep, continued, slide
from asperity_scripts.validate.boundary_elements import spectrum_of_modes

_Array = NDArray[np.float64]

CORRECTIONS: dict[str, Correction | None] = {
    "none": None,
    "S in Eq. 22, 0.40": SFactor(gamma=0.4),
    "S in Eq. 22, 0.50": SFactor(gamma=0.5),
    "S in G, 5/9": SFactor(gamma=5 / 9, applies_to="area"),
    "Nayak S": NayakSFactor(),
    "partial contact": PartialContact(),
}
_DRAWN = {"none": ":", "Nayak S": "--", "partial contact": "-"}
_POINTS = 60  # of a curve
_COARSE = 0.05  # of mu: more between the work of the slopes and the dissipation is told


@dataclass(frozen=True, eq=False)
class Comparison:
    """Exact and predicted figures, arrays of shape (pressures, velocities)."""

    pressure: _Array
    velocity: _Array
    hysteresis: _Array
    work_of_slopes: _Array
    area: _Array
    predicted: dict[str, tuple[_Array, _Array]]  # hysteresis and area by the correction's name
    between: _Array  # velocities at which curves are drawn
    curves: dict[str, tuple[_Array, _Array]]  # predictions there
    notes: list[Note]

    def columns(self) -> dict[str, list[float]]:
        p, v = np.meshgrid(self.pressure, self.velocity, indexing="ij")
        named = {"pressure_pa": p, "velocity_m_s": v, "hysteresis_exact": self.hysteresis}
        named |= {"work_of_slopes": self.work_of_slopes, "contact_area_exact": self.area}
        for name, (mu, area) in self.predicted.items():
            named |= {f"hysteresis, {name}": mu, f"contact_area, {name}": area}
        return {name: values.ravel().tolist() for name, values in named.items()}

    def summary(self) -> str:
        """Markdown: errors in % of every correction, root mean square and worst either way."""
        lines = [
            "# Exact sliding contact against the theory",
            "",
            f"Relative errors in % over {self.hysteresis.size} contacts of this map: hysteresis "
            "and area, root mean square, lowest and highest.",
            "",
            "| correction | mu rms | mu | A rms | A |",
            "| --- | --- | --- | --- | --- |",
        ]
        for name, of_model in self.predicted.items():
            cells = []
            for values, truth in zip(of_model, (self.hysteresis, self.area), strict=True):
                error = 100 * (values / truth - 1)
                rms = math.sqrt(float(np.mean(error**2)))
                cells += [f"{rms:.1f}", f"{error.min():+.1f} / {error.max():+.1f}"]
            lines.append(f"| {name} | {' | '.join(cells)} |")
        return "\n".join([*lines, ""])

    def figure(self, path: Path) -> bytes:
        """mu and A over velocity: exact as marks, predicted as lines, a colour a pressure."""
        figure, panels = new_figure(2)
        labels = ("Hysteresis $\\mu_H$ [-]", "Contact area $A/A_0$ [-]")
        exact = (self.hysteresis, self.area)
        for i, (axes, label) in enumerate(zip(panels, labels, strict=True)):
            for j, colour in enumerate(colours(self.pressure.size)):
                title = f"exact, {self.pressure[j] / 1e3:.4g} kPa"
                axes.plot(self.velocity, exact[i][j], "o", color=colour, label=title)
                for name, dash in _DRAWN.items():
                    axes.plot(self.between, self.curves[name][i][j], dash, color=colour)
            axes.set_xscale("log")
            axes.set_ylim(bottom=0)
            axes.set_xlabel("Sliding velocity $v$ [m/s]")
            axes.set_ylabel(label)
        for name, dash in _DRAWN.items():
            panels[0].plot([], [], dash, color=grey(0.3), label=name)
        legend(panels[0])
        return picture(figure, path)


def compare(
    surface: HeightMap,
    rubber: Rubber,
    *,
    pressure: Sequence[float],
    velocity: Sequence[float],
    poisson_ratio: float = 0.5,
    periodic: bool = False,
    progress: Progress = nullcontext,
) -> Comparison:
    """Solve a map at every pressure and velocity, and predict the same from its own spectrum.

    The theory is given the spectrum of the very map that is solved, all its modes, at its rms
    slope. Arguments and errors as of `slide` and `friction`; `periodic` False blends its sides.
    """
    solved = surface if periodic else continued(surface, "blend")
    loads, speeds = np.array(pressure, dtype=float), np.array(velocity, dtype=float)
    points = [(p, v) for p in loads for v in speeds]
    rows = []
    with (
        progress([slice(i, i + 1) for i in range(len(points))]) as shown,
        line_on(shown) as show,
    ):

        def tell(at: SlidingStep) -> None:
            ny, nx = at.shape
            show(f"{ny} x {nx} points, step {at.step}, error {at.error:.0e}")

        for chunk in shown:
            ((p, v),) = points[chunk]
            contact = slide(
                solved,
                rubber,
                pressure=p,
                velocity=v,
                poisson_ratio=poisson_ratio,
                periodic=True,
                progress=tell,
            )
            rows.append((contact.hysteresis, contact.work_of_slopes, contact.contact_area))
    mu, slopes, area = np.array(rows).T.reshape(3, loads.size, speeds.size)
    spectrum = spectrum_of_modes(solved)

    def theory(name: str, at: _Array) -> tuple[_Array, _Array]:
        result: Any = friction(
            spectrum,
            rubber,
            pressure=loads[:, None],
            velocity=at,
            poisson_ratio=poisson_ratio,
            correction=CORRECTIONS[name],
        )
        return result.hysteresis, result.contact_area

    between = np.geomspace(speeds.min(), speeds.max(), _POINTS)
    between = np.clip(between, speeds.min(), speeds.max())  # whatever rounding made of the ends
    faded = "the map was made periodic: its end is blended into its beginning over two short waves"
    notes = [] if periodic else [Note(faded, code="map-continued")]
    apart = float(np.abs(slopes / mu - 1).max())
    if apart > _COARSE:
        text = (
            f"the work of the slopes and the dissipation differ by up to {100 * apart:.0f} %: the "
            "shortest waves are a few pixels long, or what dissipates are waves across the way"
        )
        notes.append(Note(text, code="coarse-map"))
    return Comparison(
        *(loads, speeds, mu, slopes, area),
        predicted={name: theory(name, speeds) for name in CORRECTIONS},
        between=between,
        curves={name: theory(name, between) for name in _DRAWN},
        notes=notes,
    )
