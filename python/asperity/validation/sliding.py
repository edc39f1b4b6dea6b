"""Exact steady sliding contact of a map: the friction that the theory is held against."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from asperity import _core
from asperity.base.arguments import Array, choice, frozen, number, of_kind
from asperity.base.diagnostics import Note, fatal_first, refusal
from asperity.base.table import Column, Columns, Table
from asperity.base.value import around, value
from asperity.dma import AnyRubber, rubber_of
from asperity.surface import HeightMap, Periodic, draw_map

_MOST_PIXELS = 1000  # along a side of a picture; a larger map is thinned out


class SlidingStep(NamedTuple):
    """A step of the iteration, as `progress` of `slide` is told it.

    Attributes
    ----------
    shape : (int, int)
        (ny, nx) of the grid; coarser ones come first.
    step : int
        From 1 on, on every grid.
    error : float
        Complementarity error reached, as of `SlidingContact`; at most `rtol` ends the iteration.
    """

    shape: tuple[int, int]
    step: int
    error: float


@value
class SlidingContact(Table):
    """What `slide` returns.

    Attributes
    ----------
    contact_area : float
        A/A0 without the excess of the pixels' perimeter [-].
    contact_area_raw : float
        Share of the points that carry pressure [-].
    hysteresis : float
        mu_H, the energy that the rubber dissipates over load and way [-].
    work_of_slopes : float
        -<p grad h . s> / sigma0 [-], s along the way: mu_H but for the mesh and for what waves
        across the way dissipate.
    lateral : float
        -<p grad h . n> / sigma0 [-], n being s turned by +90 degrees from x towards y: the force on
        the moving body is -sigma0 (mu s + lateral n).
    elastic_energy : float
        <p u> / 2 [J/m^2], u being the displacement without its mean.
    error : float
        Complementarity, <p (gap - least gap)> / (sigma0 h_rms) [-].
    pressure, gap : ndarray, shape (ny, nx)
        Of the map that was solved [Pa], [m]; it slides along its second axis.
    pixel_size : (float, float)
        (dy, dx) [m].
    nominal_pressure, velocity : float
        As given [Pa], [m/s].
    notes : tuple of Note
        How the map was made periodic.
    """

    contact_area: float
    contact_area_raw: float
    hysteresis: float
    work_of_slopes: float
    lateral: float
    elastic_energy: float
    error: float
    pressure: Array
    gap: Array
    pixel_size: tuple[float, float]
    nominal_pressure: float
    velocity: float
    notes: tuple[Note, ...] = ()

    def _summary(self) -> dict[str, Any]:
        names = ("contact_area", "hysteresis", "work_of_slopes", "error")
        shown = {name: getattr(self, name) for name in names}
        shown |= {"shape": self.pressure.shape, "velocity": self.velocity}
        return shown | ({"notes": self.notes} if self.notes else {})

    def _columns(self) -> Columns:
        axes = zip(("y", "x"), self.pressure.shape, self.pixel_size, strict=True)
        places = {name: Column((name,), np.arange(n) * step, "m") for name, n, step in axes}
        maps = {
            "pressure": Column(("y", "x"), self.pressure, "Pa", "contact pressure"),
            "gap": Column(("y", "x"), self.gap, "m", "gap between rubber and surface"),
        }
        facts = ("contact_area", "hysteresis", "work_of_slopes", "lateral", "error", "velocity")
        return Columns(
            places, maps, {name: getattr(self, name) for name in facts} | {"notes": [*self.notes]}
        )

    def _draw(self, axes: Any) -> None:
        step = -(-max(self.pressure.shape) // _MOST_PIXELS)
        shown = self.pressure[::step, ::step]
        axes.set_facecolor("0.9")  # no contact
        pressed = np.where(shown > 0, shown, math.nan)
        size = self.pressure.shape, self.pixel_size
        draw_map(axes, pressed, *size, "contact pressure [Pa]")
        axes.set_xlabel(f"{axes.get_xlabel()}, along the way")


def slide(
    height_map: HeightMap,
    rubber: AnyRubber,
    *,
    pressure: float,
    velocity: float,
    poisson_ratio: float = 0.5,
    periodic: Periodic = "blend",
    rtol: float = 1e-6,
    time_limit: float | None = None,
    direction: float = 0.0,
    progress: Callable[[SlidingStep], object] | None = None,
) -> SlidingContact:
    """Return the contact and the friction of a rigid map that slides steadily on rubber.

    Nothing is averaged: every point of the map touches or does not. In the frame of the map, which
    slides along its second axis, the rubber answers a pressure p_q exp(i q x) with u_q = K_q p_q,
    K_q = 2 (1 - nu^2) / (|q| conj E(v q_x)); gap = u - h - delta >= 0, p >= 0, p gap = 0 and
    <p> = sigma0. The rubber dissipates mu_H = sum q_x Im K_q |p_q|^2 / sigma0. Waves with q_x = 0
    have the mean compliance of their band, |q_x| < pi / L: they would stay relaxed at any speed.

    Parameters
    ----------
    height_map : HeightMap
        Without drop-outs and trend, 16 x 16 points or more.
    rubber : PronySeries, MasterCurve or MasterCurveBuild
        A master curve must reach from 2 pi v / L to pi v / dx.
    pressure : float
        sigma0 [Pa].
    velocity : float
        v [m/s]; 0 is elastic contact at the relaxed modulus.
    poisson_ratio : float
        In [0, 0.5].
    periodic : True, "blend", "mirror" or "fade"
        How the map goes on beyond its sides. True: at its opposite sides, as those of `synthesize`
        do. "blend": about two of its shortest waves at its end are blended into its beginning, with
        weights that sum to 1. "fade": the last eighth along either axis is, with weights that keep
        the variance and not the skewness. "mirror": by its mirror images, which takes four times
        the points and slides over the slopes in both directions.
    rtol : float
        Largest complementarity error, 1e-12 to 0.1.
    time_limit : float, optional
        [s], after which the computation ends with NotConverged.
    direction : float
        Of sliding [rad], from the map's second axis (x) towards its first (y, rising row).
    progress : callable, optional
        Called with a `SlidingStep` after every step.

    Returns
    -------
    SlidingContact

    Raises
    ------
    InvalidInput
        Also for a map that is flat or has drop-outs.
    OutOfRange
        v q_x outside of a measured master curve; the message has the velocities that are allowed.
    NotConverged
        Says which error, area and friction were reached.

    Notes
    -----
    Semismooth Newton steps on the set of points in contact, each solved by GMRES in single
    precision, with a proximal term that keeps lossy rubbers from flipping; coarser grids first.
    512^2 points take half a second in the median, 95 % of contacts within 5 s, the steepest modulus
    (a factor of 1000 within the map's waves) up to 80 s; 2048^2 take 12 s and 0.6 GB (one thread).

    Quarters of maps of 512^2 points (H 0.8, 8 to 64 waves to a side), closed, against the whole, in
    the mean of five maps at three speeds, mu in %: "blend" -0.9 to -0.6 on Gaussian heights, 0.0 to
    +1.7 on worn, -2.1 to -1.1 on peaked ones (standard errors 0.6, 0.6, 1.5), the area within 1.0,
    1.0 and 3.4; "fade" -0.8 to +1.4, +4 to +14 (the area -8.4 to -1.3) and -2.8 to +0.7; "mirror"
    -3.7 to +0.9, -0.9 to +1.0 and -6.1 to +0.4. Single quarters scatter by 3 to 17 % in mu.

    The pixel's size hardly enters mu: -0.4 to +2.3 % at 4 pixels a shortest wave. Maps of one
    spectrum scatter by 2 % in mu while A/A0 is above 0.03, by up to 15 % at 0.02 and 40 % at 0.007.

    The area is free of the perimeter's excess (Yastrebov, Anciaux and Molinari, Tribology
    International 114 (2017) 161), (pi - 1 + ln 2) / 24 of a pixel a free side.

    Examples
    --------
    >>> import asperity
    >>> from asperity.validation import slide
    >>> road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2513, q1=2e4)
    >>> map = asperity.synthesize(road, shape=(64, 64), pixel_size=0.01 / 64, seed=1)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3]
    ... )
    >>> found = slide(map, rubber, pressure=1e5, velocity=0.1, periodic=True)
    >>> found.hysteresis > 0.1 and found.error < 1e-6
    True
    """
    limit = math.inf if time_limit is None else number(time_limit, "time_limit")
    load, speed = number(pressure, "pressure"), number(velocity, "velocity")
    pixel_size, *figures, p, gap, notes = _core.slide(
        of_kind(height_map, "height_map", HeightMap)._core,
        rubber_of(rubber)._core,
        load,
        speed,
        number(poisson_ratio, "poisson_ratio"),
        choice(periodic, "periodic", Periodic),
        number(rtol, "rtol"),
        limit,
        number(direction, "direction"),
        _reporter(progress),
    )
    names = ("contact_area", "contact_area_raw", "hysteresis", "work_of_slopes", "lateral")
    return SlidingContact._made(
        dict(zip((*names, "elastic_energy", "error"), figures, strict=True)),
        pressure=frozen(p),
        gap=frozen(gap),
        pixel_size=pixel_size,
        nominal_pressure=load,
        velocity=speed,
        notes=tuple(fatal_first((*rubber_of(rubber).notes, *notes))),
    )


def _reporter(progress: Callable[[SlidingStep], object] | None) -> Callable[..., object] | None:
    if progress is None:
        return None
    if not callable(progress):
        raise refusal("progress", progress, "callable, or None")

    def tell(ny: int, nx: int, step: int, error: float) -> None:
        progress(SlidingStep((ny, nx), step, error))

    return tell


def continued(height_map: HeightMap, periodic: Periodic) -> HeightMap:
    """Return the map that `slide` solves, its heights about their mean."""
    return around(
        HeightMap, _core.continued(height_map._core, choice(periodic, "periodic", Periodic))
    )
