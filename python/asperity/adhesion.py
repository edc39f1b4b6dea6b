"""The adhesion of Eq. 23, given or fitted to measured friction."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity.base.arguments import (
    Conversion,
    Covariance,
    broadcast,
    choice,
    frozen,
    number,
    real_array,
)
from asperity.base.diagnostics import Note, fatal_first, must_be, refusal
from asperity.base.parameters import parameter
from asperity.base.quantities import SHEAR_STRESS, VELOCITY
from asperity.base.table import Column, Columns, Table
from asperity.base.value import CoreValue, value
from asperity.contact import Form, Method, contact_model, surface_and_rubber
from asperity.correction import Correction
from asperity.dma import AnyRubber, rubber_of
from asperity.self_affine_fit import AnySpectrum
from asperity.sweeps import StrainFactors


@value
class Adhesion(CoreValue):
    """Friction of the real contact area (Eq. 23).

    mu_A = (tau_f0 / sigma0) (A/A0) exp(-c log10(v / v0)^2).

    Parameters
    ----------
    shear_stress : float
        tau_f0 [Pa]; 5.3 to 8.3 MPa in the article. It goes with the cut-off and the correction that
        the area is taken with.
    reference_velocity : float
        v0 [m/s].
    width : float
        c of Eq. 23 [-].
    """

    shear_stress: float = parameter(SHEAR_STRESS, usual=(1e4, 1e8), shown_unit="MPa")
    reference_velocity: float = parameter(
        VELOCITY, default=6e-3, usual=(1e-6, 1.0), shown_unit="mm/s"
    )
    width: float = parameter(default=0.1, usual=(0.01, 1))


PARAMETERS = ("shear_stress", "reference_velocity", "width")


def adhesion_core(adhesion: Adhesion | None) -> Any:
    if adhesion is None:
        return None
    if not isinstance(adhesion, Adhesion):
        raise refusal("adhesion", adhesion, "an Adhesion or None")
    return adhesion._core


@value
class AdhesionFit(Adhesion, Table):
    """An Adhesion that was fitted (`fit_adhesion`), with how well the measurement determines it.

    Attributes
    ----------
    shear_stress, reference_velocity, width : float
        tau_f0 [Pa], v0 [m/s], c [-].
    covariance : ndarray, shape (3, 3)
        Of shear_stress [Pa], reference_velocity [m/s], width [-]; rows of held ones are 0.
    residual : float
        Robust standard deviation of ln(mu / fit) [-].
    outliers : ndarray of bool
        Points put aside, in the shape of mu: more than 4.685 residuals off the fit.
    notes : tuple of Note
        What a reader must know.
    """

    reference_velocity: float
    width: float
    covariance: Covariance
    residual: float
    outliers: Conversion[ArrayLike, NDArray[np.bool_]]
    notes: tuple[Note, ...] = ()

    def __post_init__(self) -> None:
        self._take()
        outliers = frozen(real_array(self.outliers, "outliers").astype(bool))
        self._set(_core=self.adhesion._core, outliers=outliers)

    @property
    def adhesion(self) -> Adhesion:
        """The parameters alone, an Adhesion."""
        return Adhesion(**{name: getattr(self, name) for name in PARAMETERS})

    @property
    def standard_errors(self) -> dict[str, float]:
        """Of the three parameters, in their units, from the scatter of the points; 0 where held."""
        errors = np.sqrt(np.diag(self.covariance))
        return dict(zip(PARAMETERS, errors.tolist(), strict=True))

    @property
    def log10_reference_velocity_error(self) -> float:
        """Standard error of log10 v0 [-]: v0 is as uncertain upwards as downwards there."""
        error = self.standard_errors["reference_velocity"]
        return error / (math.log(10) * self.reference_velocity)

    def _summary(self) -> dict[str, Any]:
        shown = {name: getattr(self, name) for name in (*PARAMETERS, "residual")}
        return shown | {"points": self.outliers.size, "outliers": int(self.outliers.sum())}

    def _columns(self) -> Columns:
        axis = ("parameter",)
        return Columns(
            {"parameter": Column(axis, list(PARAMETERS), "")},
            {
                "value": Column(axis, [getattr(self, name) for name in PARAMETERS], "Pa, m/s, 1"),
                "standard_error": Column(axis, [*self.standard_errors.values()], "Pa, m/s, 1"),
            },
            {"residual": self.residual, "notes": list(self.notes)},
        )

    def _draw(self, axes: Any) -> None:
        v = self.reference_velocity * np.logspace(-6, 6, 200)
        stress = self.shear_stress * np.exp(
            -self.width * np.log10(v / self.reference_velocity) ** 2
        )
        axes.plot(v, stress)
        axes.set(xscale="log", xlabel="velocity [m/s]", ylabel="shear stress of the contact [Pa]")


def fit_adhesion(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    velocity: ArrayLike,
    mu: ArrayLike,
    pressure: ArrayLike,
    fixed: Mapping[str, float] | None = None,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    form: Form = "exact",
    rtol: float = 1e-6,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
) -> AdhesionFit:
    """Fit tau_f0, v0 and c of Eq. 23 to measured friction.

    mu = mu_H + (tau_f0 / sigma0) (A/A0) exp(-c log10(v / v0)^2), with mu_H and A/A0 as `friction`
    computes them, is fitted in ln mu: repeated friction measurements scatter in proportion to mu,
    so that a point counts by its relative error. Outliers, up to 30 % of the points in trials, are
    put aside by Tukey's biweight about a robust scale (an M-estimate that starts from S-estimates;
    Yohai 1987, Ann. Stat. 15, 642). tau_f0 goes with the cut-off of the spectrum that the area is
    taken at.

    Parameters
    ----------
    spectrum : SelfAffineSpectrum or TabulatedSpectrum
    rubber : PronySeries, MasterCurve or MasterCurveBuild
    velocity, pressure : array_like
        v [m/s] and sigma0 [Pa], positive; they broadcast. Several pressures at once are fitted
        together.
    mu : array_like
        Measured, positive [-], in the broadcast shape of velocity and pressure. Repeats are entries
        of their own.
    fixed : dict, optional
        Parameters to hold, up to two of shear_stress [Pa], reference_velocity [m/s], width [-]:
        {"width": 0.1}.
    poisson_ratio, correction, form, rtol, method, strain_factors
        As of `friction`.

    Returns
    -------
    AdhesionFit
        An Adhesion with covariance, standard errors, outliers and notes. The errors take the
        hysteresis and the area as exact.

    Raises
    ------
    InvalidInput
        Fewer different velocities than fitted parameters and one; hysteresis alone above mu; points
        that leave a parameter open: tau_f0 or c uncertain by more than half, v0 by more than a
        decade. The message says which, to be held by `fixed`, rather than to return a number that
        the points do not support.
    OutOfRange, NotConverged
        As of `friction`.

    Examples
    --------
    >>> import asperity, numpy
    >>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6]
    ... )
    >>> scene = {"pressure": 81e3, "velocity": numpy.geomspace(1e-5, 1, 20)}
    >>> truth = asperity.Adhesion(shear_stress=8.3e6)
    >>> mu = asperity.friction(road, rubber, adhesion=truth, **scene).mu
    >>> fit = asperity.fit_adhesion(road, rubber, mu=mu, **scene)
    >>> round(fit.shear_stress / 1e6, 6), round(fit.reference_velocity, 6), round(fit.width, 6)
    (8.3, 0.006, 0.1)
    """
    shape, (p, v) = broadcast(pressure=pressure, velocity=velocity)
    measured = real_array(mu, "mu")
    if measured.shape != shape:
        raise must_be(
            "mu", f"that of pressure and velocity together, {shape}", f" has shape {measured.shape}"
        )
    held = _held(fixed)
    parameters, covariance, residual, outliers, notes = _core.fit_adhesion(
        *surface_and_rubber(spectrum, rubber),
        contact_model(poisson_ratio, correction, form, rtol, method, strain_factors),
        p,
        v,
        measured.ravel(),
        *(held.get(name) for name in PARAMETERS),
    )
    return AdhesionFit(
        **dict(zip(PARAMETERS, parameters, strict=True)),
        covariance=covariance,
        residual=residual,
        outliers=np.array(outliers, dtype=bool).reshape(shape),
        notes=tuple(fatal_first((*rubber_of(rubber).notes, *notes))),
    )


def _held(fixed: Any) -> dict[str, float]:
    if fixed is None:
        return {}
    if not isinstance(fixed, Mapping):
        raise refusal("fixed", fixed, "a dict")
    for name in fixed:
        choice(name, "fixed", PARAMETERS)
    return {name: number(value, f"fixed: {name}") for name, value in fixed.items()}
