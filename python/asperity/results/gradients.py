"""The slopes of mu over all that it follows from: what makes the friction."""

from typing import Any

import numpy as np

from asperity.base.arguments import Array, Shape, frozen
from asperity.base.table import Column, Columns, Table
from asperity.base.value import value

DENSITIES = ("spectrum", "storage", "loss")
SEVERAL = {"moduli": "term", "relaxation_times": "term"}  # scalars of which there are several
SEVERAL |= {"storage_factors": "row", "loss_factors": "row"}
PER = {"temperature": "1/K", "lay": "1/rad", "direction": "1/rad"}  # not over a logarithm
DECADE = np.log(10)


@value
class Gradients(Table):
    """Slopes of mu, as `friction(..., gradients=True)` gives them.

    A density is a mean over hats, which are 1 at a row and fall to 0 at its neighbours, linearly in
    the logarithm: the trapezoid rule over `ln wavenumber` or `ln angular_frequency` is exact, and a
    value times its weight in that rule is d mu for the logarithm of the row.

    Attributes
    ----------
    wavenumber : ndarray, shape (n,)
        Rows of C [1/m]: those of a table, or two a unit of ln q of a law.
    spectrum : ndarray, shape mu.shape + (n,)
        Density over ln q of d mu / d ln C. For the hysteresis alone its integral is
        (mu - d mu / d ln pressure) / 2.
    angular_frequency : ndarray, shape (m,)
        Rows of the modulus, reduced: omega a_T [rad/s]; those of a master curve, or fifths of
        decades. The lowest has all below it, too.
    storage, loss : ndarray, shape mu.shape + (m,)
        Densities over ln omega of d mu / d ln E' and d mu / d ln E''. For the hysteresis alone the
        integral of both is -d mu / d ln pressure.
    pressure, velocity : float or ndarray
        d mu / d ln p and d mu / d ln v.
    temperature : float or ndarray, or None
        d mu / dT [1/K].
    equilibrium_modulus, moduli, relaxation_times : float or ndarray, or None
        d mu / d ln of each, of a Prony series; the last two have shape mu.shape + (terms,).
    rms_height, hurst, q0, q1, rolloff : float or ndarray, or None
        d mu / d ln of each, of a self-affine spectrum. q0 and q1 move the end of the band at a kept
        rms height.
    axis_ratio, lay, direction : float or ndarray, or None
        Of a spectrum that knows directions: d mu / d ln of the axis ratio of a law, and d mu over
        its lay and over the direction of sliding [1/rad]. `spectrum` has rings at kept harmonics.
    strain_per_slope, storage_factors, loss_factors : float or ndarray, or None
        d mu / d ln of each, of strain factors; the last two are their rows `storage` and `loss`,
        shape mu.shape + (rows,).
    poisson_ratio : float or ndarray
        d mu / d ln of it: mu knows E / (1 - nu^2) alone.
    gamma, friction_gamma, p, z_max, z_min : float or ndarray, or None
        d mu / d ln of each, of a correction; of z_min over its size.
    correction_rms_height, correction_q0 : float or ndarray, or None
        The same of its `rms_height` and `q0` where it has its own: names that a spectrum has too.
    shear_stress, reference_velocity, width : float or ndarray, or None
        d mu / d ln of each, of the adhesion.
    density, heat_capacity, conductivity, contact_diameter : float or ndarray, or None
        d mu / d ln of each, of the heating. The macro-asperities' wavenumber follows the diameter
        where it is not given.
    macro_wavenumber, macro_area, interface_share : float or ndarray, or None
        The same, where they are given, and the last with adhesion.
    error_estimate : float or ndarray
        Absolute error of a slope, and of the integral of a density over any range: twice what a
        finer grid changes, and 2e-4 of mu or so.
    """

    wavenumber: Array
    spectrum: Array
    angular_frequency: Array
    storage: Array
    loss: Array
    pressure: Any
    velocity: Any
    temperature: Any = None
    equilibrium_modulus: Any = None
    moduli: Array | None = None
    relaxation_times: Array | None = None
    rms_height: Any = None
    hurst: Any = None
    q0: Any = None
    q1: Any = None
    rolloff: Any = None
    axis_ratio: Any = None
    lay: Any = None
    direction: Any = None
    strain_per_slope: Any = None
    storage_factors: Array | None = None
    loss_factors: Array | None = None
    poisson_ratio: Any = None
    gamma: Any = None
    friction_gamma: Any = None
    p: Any = None
    z_max: Any = None
    z_min: Any = None
    correction_rms_height: Any = None
    correction_q0: Any = None
    shear_stress: Any = None
    reference_velocity: Any = None
    width: Any = None
    density: Any = None
    heat_capacity: Any = None
    conductivity: Any = None
    contact_diameter: Any = None
    macro_wavenumber: Any = None
    macro_area: Any = None
    interface_share: Any = None
    error_estimate: Any = None

    def _summary(self) -> dict[str, Any]:
        shape = {"shape": np.shape(self.pressure)} if np.shape(self.pressure) else {}
        slopes = {name: at for name, at in self._arguments().items() if np.ndim(at) == 0}
        return shape | {name: at for name, at in slopes.items() if at is not None}

    def _columns(self) -> Columns:
        axes = tuple(f"axis_{i}" for i in range(np.ndim(self.pressure)))
        coordinates = {
            "wavenumber": Column(("wavenumber",), self.wavenumber, "1/m"),
            "angular_frequency": Column(("angular_frequency",), self.angular_frequency, "rad/s"),
        }
        along = {"spectrum": "wavenumber", "storage": "angular_frequency"}
        along |= {"loss": "angular_frequency", **SEVERAL}
        variables = {}
        for name, slope in self._arguments().items():
            if name in coordinates or slope is None:
                continue
            over = (*axes, along[name]) if name in along else axes
            unit, of = (PER[name], name) if name in PER else ("1", f"ln {name}")
            meaning = "error estimate" if name == "error_estimate" else f"d mu / d {of}"
            variables[name] = Column(over, slope, unit, meaning)
        return Columns(coordinates, variables)

    def _draw(self, axes: Any) -> None:
        """Draw slopes of mu over each decade of the modulus, a line a point, the first faint."""
        x = self.angular_frequency
        parts = {"E'": (self.storage, "C0"), "E''": (self.loss, "C3")}
        for label, (density, color) in parts.items():
            rows = density.reshape(-1, x.size)
            faint = np.linspace(1, 0.3, len(rows))[::-1]
            for i, row in enumerate(rows):
                last = i + 1 == len(rows)
                axes.plot(x, row * DECADE, color=color, alpha=faint[i], label=label * last or None)
        axes.axhline(0, color="0.7", lw=0.8, zorder=0)
        axes.set(xscale="log", xlabel=r"$\omega a_T$ [rad/s]")
        axes.set_ylabel(r"d$\mu$ / d ln $E$ of a decade")
        points = np.size(self.pressure)
        axes.legend(frameon=False, title="faint: first point" if points > 1 else None)


def reshaped(gradients: Gradients, shape: Shape) -> Gradients:
    """Return the gradients of points that are flat in a shape of as many."""
    made: dict[str, Any] = {}
    for name, slope in gradients._arguments().items():
        of_points = slope is not None and name not in ("wavenumber", "angular_frequency")
        made[name] = slope.reshape(*shape, *slope.shape[1:]) if of_points else slope
    return Gradients._made(made)


def of_core(parts: tuple[Any, ...], shape: Shape) -> Gradients:
    q, spectrum, w, storage, loss, p, v, temperature, arguments, error = parts
    columns = {"pressure": p, "velocity": v, "error_estimate": error, **arguments}
    if temperature.size:
        columns["temperature"] = temperature
    tables = {"spectrum": spectrum, "storage": storage, "loss": loss}
    tables |= {name: columns.pop(name) for name in SEVERAL if name in columns}
    made: dict[str, Any] = {"wavenumber": frozen(q), "angular_frequency": frozen(w)}
    points = max(p.size, 1)
    made |= {name: frozen(a).reshape(*shape, a.size // points) for name, a in tables.items()}
    for name, slope in columns.items():
        made[name] = frozen(slope).reshape(shape) if shape else slope.item()
    return Gradients._made(made)
