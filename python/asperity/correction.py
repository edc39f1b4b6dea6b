"""Corrections for partial contact: the S factor and the affine shifts p_T (Eqs 8-11, 13, 21)."""

from dataclasses import field
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import Array, frozen, vector
from asperity.base.diagnostics import Argument, InvalidInput, Must, must_be, valued
from asperity.base.parameters import parameter
from asperity.base.quantities import FIRST_WAVENUMBER, HEIGHT, RMS_HEIGHT, SPACING
from asperity.base.value import CoreValue, Value, value
from asperity.io.fields import rename_in_errors
from asperity.scan_contact import ScanContact
from asperity.surface import HeightMap

__all__ = [
    "AffineShift",
    "GreenwoodWilliamson",
    "ImplicitSFactor",
    "LocalPeaks",
    "NayakSFactor",
    "PartialContact",
    "PeaksThenGreenwoodWilliamson",
    "SFactor",
    "ScanContact",
]

AppliesTo = Literal["friction", "area", "both"]
Reading = Literal["implicit", "added"]


def _distance() -> Any:
    label = "Least distance of peaks"
    return parameter(SPACING, default=None, usual=(1e-7, 0.1), shown_unit="um", label=label)


def _macro_wavenumber() -> Any:
    label = "q0 of macro-asperities"
    return parameter(FIRST_WAVENUMBER, default=None, usual=(10, 1e6), label=label)


@value
class SFactor(CoreValue):
    """Persson's correction for partial contact (Eq. 8).

    S = gamma + (1 - gamma) P^2 with P = A/A0.

    Parameters
    ----------
    gamma : float
        In [0, 1]; 0.4 to 0.5 in the literature.
    applies_to : {"friction", "area", "both"}
        "friction": a factor of the integrand of Eq. 22, with the uncorrected P. "area": inside G,
        self-consistently, for `contact_area` and the adhesion, and Eq. 22 is left alone. "both":
        both.

    Notes
    -----
    Mean errors on the elastic contacts of `asperity validate` (all corrections, and the worst, in
    docs/explanation/corrections.md), without correction: area 17 %, elastic energy, which the
    integrand of Eq. 22 weighs, 69 %. "area": area 3.4 % at gamma = 0.5, 2.4 % at 5/9. "friction":
    energy 4.0 % at 0.4, 14 % at 0.5. They have q1/q0 from 2 to 128 and p / (E* h') from 0.005 to 1;
    beyond this bandwidth and below this load results carry a note.
    """

    _title = "S-factor"
    gamma: float = parameter(default=0.5, usual=(0, 1))
    applies_to: AppliesTo = parameter(default="friction", usual=get_args(AppliesTo))


@value
class NayakSFactor(CoreValue):
    """S inside G that knows how wide the spectrum's band is, fitted to exact contacts.

    For `contact_area` and the adhesion int_0^G dg / S(P(g)) = G_uncorrected with
    S = gamma + 0.29 sqrt(P) + (0.71 - gamma) P^13, gamma = 0.63 (1 - 0.50 alpha^(-1/4)) and alpha
    the spectrum's Nayak parameter up to the wavenumber at which the area is asked for. The
    integrand of Eq. 22 is multiplied by the S of Eq. 8 with `friction_gamma` and the uncorrected P.

    Parameters
    ----------
    friction_gamma : float
        In [0, 1]; 1 leaves Eq. 22 alone. 0.40 gives the elastic energy, which the integrand weighs,
        best.

    Notes
    -----
    On the contacts of SFactor, to which its four numbers were fitted (alpha from 1.75 to 200), the
    area is off by 1.0 % in the mean and 6.1 % at worst, on ten maps unknown to the fit by 1.2 % and
    3.7 %. Beyond their bandwidths and loads results carry a note.
    """

    _title = "S-factor after Nayak"
    friction_gamma: float = parameter(default=0.4, usual=(0, 1))


@value
class ImplicitSFactor(CoreValue):
    """S of the area that results: A = erf(1 / (2 sqrt(G (gamma + (1 - gamma) A)))).

    For `contact_area` and the adhesion, as `SFactor(applies_to="area")`; Eq. 22 is left alone.
    The right side falls as A grows, so that there is one A. gamma = 1 is Persson's theory; at small
    loads A is 1 / sqrt(gamma) times Persson's, and in full contact it is Persson's. The law is that
    of Y. Xu and others, J. Mech. Phys. Solids (2024), there with 0.42 to 0.45.

    Parameters
    ----------
    gamma : float
        In [0, 1]; 0.42 to 0.45 in its source.

    Notes
    -----
    On the contacts of SFactor the area is off by 4.4 % in the mean with gamma = 0.45, by 2.5 % with
    0.50; its source fitted areas whose edges count as whole pixels, which makes them larger
    (docs/notes/outside.md). It does not know the bandwidth: `NayakSFactor` is nearer.
    """

    _title = "implicit S-factor"
    gamma: float = parameter(default=0.45, usual=(0, 1))


@value
class PartialContact(CoreValue):
    """Area and friction from one sum rule over the stress of all waves, made on exact contacts.

    The source is this project's own work, exact steady sliding contact of viscoelastic half-spaces
    (`asperity.validation.slide`). With G, I1, I2 of Persson's theory, A(q) = erf(1 / (2 sqrt(kappa
    G(q)))), A1 = A(q1) and g' = dG / d ln q with the mean of q^4 C over two units of ln q about q:

    - R = A / (1 + Q A^2 g')^2 stands in the integrand of Eq. 22 where A S stands;
    - T = 3.55 A1 (1 - A1^(1/4)) g'_e max(1, 0.1 / rho) (I2(v q) / I2(v q_e))^1.25 (q_e / q)^3
      is what the edges of contacts carry from q_e, the end of the roughness, to 33 q_e;
    - kappa makes the stress as uneven as Persson's pressure is: 2 (int R dG + int T d ln q) is B
      times the variance of the distribution of `pressure_distribution`, over sigma0^2.

    Q = 0.67 (4 w / M)^0.2 kappa^(1/4) (1 - A1)^(1/8) (1 + 6.3 (1 - A1^(1/10))^3) and B = 1 + (0.105
    A1 + 0.45 max(0, 1 - 1 / rho)^4) (1 - A1^8), where M = int q^3 C dq, ln q_e is the mean of ln q
    over the last tenth of M, w the mean of q^4 C over two units of ln q about q_e or M / 20 if that
    is more, g'_e = dG / d ln q at q_e with it and rho = I2(v q_e) M / int q^3 C I2 dq. So rows that
    a spectrum has beyond its roughness do not matter. The area is A1, the hysteresis 4 (1 - nu^2)
    sigma0 (int (I1 / I2) R dG + int (I1 / I2) T d ln q). In complete contact all of it is Persson's
    theory as it stands.

    Notes
    -----
    It needs the rubber up to 33 v q_e. Where a measured modulus ends before, I1 and I2 of the edges
    keep their last values; the share of the hysteresis from there counts as extrapolated. Only with
    the exact form of A/A0.

    Its five numbers were fitted to 300 exact sliding contacts (A/A0 from 0.0014 to 0.96, q1/q0 from
    8 to 128, H from 0.35 to 0.95, six rubbers) and to 173 elastic ones; on them mu is off by 4.2 %
    rms and 14 % at worst where A/A0 is above 0.02, by 8.2 % rms below, the area by 3.0 % rms. On 80
    contacts of maps that another program solved mu is off by 5.2 % rms and 10 % at worst, the area
    by 4.0 and 10 %; `NayakSFactor` is off by 25 and 63 % there in mu, by 18 and 80 % in the area.
    `friction(...).model_error` has the error by speed and load.
    """

    _title = "partial contact (recommended)"


@value
class AffineShift(CoreValue):
    """C -> C / p^2 with a given shift factor (Eqs 9-11).

    Parameters
    ----------
    p : float
        p_T >= 1 [-]; 1 is full conformity.

    Notes
    -----
    On the contacts of SFactor the exact area asks for a p that falls from 1.4 at p / (E* h') =
    0.005 to 1.05 at 1, the exact energy for one from 2.8 to 1: no single p serves either. Where p
    takes the area further from the truth than no correction would, results carry a note.
    """

    p: float = parameter(kw_only=False, usual=(1, 5), start=1.5)


@value
class LocalPeaks(Value):
    """p_T1 = z_max / (z_max - <h_peaks>) (Eq. 13).

    Parameters
    ----------
    heights_or_map : array_like, shape (n,), or HeightMap
        Heights of the peaks above the mean plane [m], n >= 3; or a map, on which they are found.
    min_distance : float, optional
        Between peaks [m]; needed with a map, and refused without. The article uses
        lambda0 = 2 pi / q0 and lambda0 / 2.
    z_max : float, optional
        Highest point of the profile [m]; by default the map's, or the highest peak.

    Attributes
    ----------
    heights : ndarray, shape (n,)
        Of the peaks [m].

    Raises
    ------
    InvalidInput
        Fewer than 3 peaks, a mean below the mean plane, z_max below the highest peak.

    Notes
    -----
    On the contacts of SFactor area and elastic energy are off by 44 % in the mean with peaks no
    closer than lambda0 / 2. Knowing neither load nor rubber it is right at one load alone.
    """

    _title = "local peaks of the scan"
    heights_or_map: ArrayLike | HeightMap = parameter(HEIGHT, kw_only=False, key_name="heights")
    min_distance: float | None = _distance()
    z_max: float | None = parameter(HEIGHT, default=None)
    heights: Array = field(init=False)

    def __post_init__(self) -> None:
        self._take()
        self._set(_core=_profile(self)[0])

    @property
    def shift_factor(self) -> float:
        """p_T1 [-]."""
        return float(self._core.shift_factor())


@value
class GreenwoodWilliamson(Value):
    """p_T2 = (z_max - z_min) / (z_max - d~) (Eq. 21's text).

    d~ is the effective separation (see `separation`) at E* = |E(q0 v)| / (1 - nu^2), so that p_T
    depends on velocity and pressure.

    Parameters
    ----------
    z_max, z_min : float
        Highest (positive) and lowest (negative) point of the profile about its mean plane [m].
    peaks : array_like, shape (n,), optional
        Measured peak heights instead of Gaussian heights in Eq. 16, the article's Section 3.2 for
        skewed surfaces.
    reading : {"implicit", "added"}
        Of Eqs 19-20, see `separation`.
    rms_height, q0 : float, optional
        Of the macro-asperities [m], [1/m]; by default the spectrum's, q0 its roll-off where it has
        one. They set R = 1 / (q0^2 sqrt 2 h_rms) and n_a = q0^2 / (2 pi^2 sqrt 3), with `peaks`
        too. Of a measured spectrum give q0: its lowest bin is one scan length, and results that had
        to take it carry a note.

    Notes
    -----
    d~ <= z_min is full conformity: p_T = 1. d~ >= z_max is no contact: area and friction are 0 and
    p_T is infinite. Beyond d~ = 3 h_rms the model has left its range: results carry a note.

    On the contacts of SFactor the area is off by 16 % in the mean (implicit) and 14 % (added), the
    elastic energy by 32 and 27 %. Its p_T falls with the load as the exact one does, but too fast:
    the implicit reading is in full conformity, no correction at all, on nearly all contacts from
    p / (E* h') = 0.1 on, the added one turns back above 0.5.
    """

    _title = "Greenwood-Williamson on the scan's peaks"
    z_max: float = parameter(HEIGHT)
    z_min: float = parameter(HEIGHT)
    peaks: ArrayLike | None = parameter(HEIGHT, default=None, key_name="heights")
    reading: Reading = "implicit"
    rms_height: float | None = parameter(RMS_HEIGHT, default=None)
    q0: float | None = _macro_wavenumber()

    def __post_init__(self) -> None:
        reading = self._take()["reading"]
        peaks = np.empty(0) if self.peaks is None else vector(self.peaks, "peaks")
        if self.peaks is not None:
            if not peaks.size:
                raise must_be("peaks", "3 or more", " has 0 entries")
            self._set(peaks=peaks)
        macro = reading, self.rms_height, self.q0
        self._set(_core=_core.GreenwoodWilliamson(self.z_max, self.z_min, peaks, *macro))


@value
class PeaksThenGreenwoodWilliamson(Value):
    """p_T = p_T1 p_T2, for skewed surfaces (the Conclusions).

    The profile is shifted by p_T1 of its peaks (Eq. 9); Greenwood-Williamson then runs on what
    results, whose z_max, z_min and rms height are those of the profile divided by p_T1 (R follows,
    n_a stays).

    Parameters
    ----------
    heights_or_map, min_distance
        As for LocalPeaks.
    z_max, z_min : float, optional
        Of the profile before the shift [m]; by default the map's. Without a map z_min must be
        given, and z_max is the highest peak.
    reading, rms_height, q0
        As for GreenwoodWilliamson, before the shift.

    Attributes
    ----------
    heights : ndarray, shape (n,)
        Of the peaks [m].

    Notes
    -----
    On the contacts of SFactor, maps of little skewness and not those it is meant for, the area is
    off by 67 % in the mean, the elastic energy by 45 % (peaks no closer than lambda0 / 2).
    """

    _title = "local peaks, then Greenwood-Williamson"
    heights_or_map: ArrayLike | HeightMap = parameter(HEIGHT, kw_only=False, key_name="heights")
    min_distance: float | None = _distance()
    z_max: float | None = parameter(HEIGHT, default=None)
    z_min: float | None = parameter(HEIGHT, default=None)
    reading: Reading = "implicit"
    rms_height: float | None = parameter(RMS_HEIGHT, default=None)
    q0: float | None = _macro_wavenumber()
    heights: Array = field(init=False)

    def __post_init__(self) -> None:
        reading = self._take()["reading"]
        peaks, lowest = _profile(self)
        z_min = lowest if self.z_min is None else self.z_min
        if z_min is None:
            raise must_be("z_min", "given where heights_or_map is no HeightMap")
        macro = reading, self.rms_height, self.q0
        core = _core.PeaksThenGreenwoodWilliamson(peaks, self.z_max, z_min, *macro)
        self._set(z_min=z_min, _core=core)


Correction = (
    SFactor
    | NayakSFactor
    | PartialContact
    | AffineShift
    | LocalPeaks
    | GreenwoodWilliamson
    | PeaksThenGreenwoodWilliamson
    | ScanContact
    | ImplicitSFactor
)
CORRECTIONS: tuple[type, ...] = Correction.__args__


def _profile(correction: Any) -> tuple[Any, float | None]:
    """Set heights and z_max of a correction; return the core's peaks and, of a map, z_min."""
    source, distance = correction.heights_or_map, correction.min_distance
    if isinstance(source, HeightMap):
        if distance is None:
            raise must_be("min_distance", "given with a HeightMap, for instance 2 pi / q0 [m]")
        heights = frozen(source.local_peaks(min_distance=distance))
        if len(heights) < 3:
            about = Argument("min_distance"), " = ", valued(distance, f"{distance!r}")
            left = f": leaves {len(heights)} peaks on this map"
            raise InvalidInput(*about, left, Must(", must leave "), "3 or more")
        highest, lowest = source.z_max, source.z_min
    else:
        heights = vector(source, "heights_or_map")
        if distance is not None:
            problem = ": only goes with a HeightMap, these are the peaks' heights"
            raise InvalidInput(Argument("min_distance"), problem)
        correction._set(heights_or_map=heights)
        highest, lowest = float(heights.max(initial=-np.inf)), None  # the core refuses none
    z_max = highest if correction.z_max is None else correction.z_max
    with rename_in_errors(None, {"heights": "heights_or_map"}):
        peaks = _core.LocalPeaks(heights, z_max)
    correction._set(heights=heights, z_max=z_max)
    return peaks, lowest
