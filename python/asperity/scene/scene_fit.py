"""What `fit_scene` returns: numbers of a scene by measured friction, and mu beside it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from asperity.base.arguments import Array
from asperity.base.diagnostics import Note
from asperity.base.parameters import column
from asperity.base.table import Columns, Table
from asperity.base.value import value
from asperity.scene.scene import scene_text


@value
class SceneFit(Table):
    """Measured friction beside a scene: what was fitted, and how well mu is predicted.

    Attributes
    ----------
    free : tuple of str
        Keys of the numbers that were fitted; empty where the scene was compared as it is.
    value, lower, upper : dict
        Of each key the number, and the ends of its 95 % interval: symmetric in the logarithm, of
        temperatures and angles in themselves. The inputs that are not free count as exact.
    covariance : ndarray, shape (k, k)
        Of the logarithms of the numbers, of temperatures and angles themselves; in the order of
        `free`.
    slopes : dict
        Of each key "gradients" or "differences": where the derivatives of mu came from.
    pressure, velocity, temperature : ndarray, shape (n,)
        Of the points [Pa], [m/s], [K]; the last None where the file has none.
    measured, mu : ndarray, shape (n,)
        mu as it was measured, and as the scene has it with the fitted numbers [-].
    left_out : ndarray, shape (n,), or None
        mu of each point by a fit to all others [-]; None without free numbers.
    numbers_error, inputs_error, model_error : ndarray, shape (n,)
        Relative standard errors of mu [-]: of the computation; of the inputs, without free numbers
        by the errors of scan, isotherms or adhesion, else by those of the fitted numbers; of the
        theory, as exact contacts show it. NaN where nothing is known.
    band_lower, band_upper : ndarray, shape (n,)
        95 % interval on a measured mu by the three together, as far as they are known, and by the
        scatter of the points [-].
    scatter : float or None
        Relative standard deviation of the points about the truth [-], as it was given, or found by
        a fit; None where it is not known.
    rms, rms_left_out, rms_same_mu : float
        Rms of ln(measured / predicted) [-]: of the fit, of points left out of it, and of the
        baseline, the same mu everywhere, which is the mean of ln mu of all other points.
    inside : float
        Share of the points within the interval [-].
    sentence : str
        What may be published.
    tables : dict
        The scene with the fitted numbers, as `sweep` takes it; `toml` is the text of its file.
    notes : tuple of Note
        What a reader must know.
    """

    free: tuple[str, ...]
    value: Mapping[str, float]
    lower: Mapping[str, float]
    upper: Mapping[str, float]
    covariance: Array
    slopes: Mapping[str, str]
    pressure: Array = column("Pa", "nominal pressure", "point")
    velocity: Array = column("m/s", "sliding velocity", "point")
    temperature: Array | None = column("K", "temperature", "point")
    measured: Array = column("1", "measured friction coefficient", "point")
    mu: Array = column("1", "friction coefficient of the scene", "point")
    left_out: Array | None = column("1", "friction coefficient of a fit without the point", "point")
    numbers_error: Array = column("1", "relative error of the computation", "point")
    inputs_error: Array = column("1", "relative error by the inputs", "point")
    model_error: Array = column("1", "relative error of the theory", "point")
    band_lower: Array = column("1", "lower end of the interval on mu", "point")
    band_upper: Array = column("1", "upper end of the interval on mu", "point")
    scatter: float | None
    rms: float
    rms_left_out: float
    rms_same_mu: float
    inside: float
    sentence: str
    tables: Mapping[str, Any]
    notes: tuple[Note, ...] = ()

    @property
    def toml(self) -> str:
        """The scene with the fitted numbers, as the text of its file."""
        return scene_text(self.tables)

    def _summary(self) -> dict[str, Any]:
        return {
            "points": self.mu.size,
            **self.value,
            "rms": self.rms,
            "rms_left_out": self.rms_left_out,
            "rms_same_mu": self.rms_same_mu,
            "inside": self.inside,
        }

    def _columns(self) -> Columns:
        variables = super()._columns().variables
        return Columns({}, variables, {"sentence": self.sentence, **self.value})

    def _draw(self, axes: Any) -> None:
        """Draw predicted over measured mu, with the interval, and the line where they agree."""
        ends = self.measured.min(), self.measured.max()
        away = np.array([self.mu - self.band_lower, self.band_upper - self.mu])
        axes.errorbar(self.measured, self.mu, away, fmt="o", ms=3.5, lw=1, label="scene")
        if self.left_out is not None:
            axes.plot(self.measured, self.left_out, "x", ms=4, label="point left out")
        axes.plot(ends, ends, color="0.6", lw=0.8, zorder=0)
        axes.set(xlabel="measured mu [-]", ylabel="predicted mu [-]")
        axes.legend(frameon=False)
