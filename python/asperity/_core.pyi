from typing import Any, Literal, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Array: TypeAlias = NDArray[np.float64]
_Result: TypeAlias = Any  # float for scalar arguments, else an array of their broadcast shape
_Spectrum: TypeAlias = SelfAffineSpectrum | TabulatedSpectrum
_Rubber: TypeAlias = PronySeries | MasterCurve
_Correction: TypeAlias = (
    SFactor | AffineShift | LocalPeaks | GreenwoodWilliamson | PeaksThenGreenwoodWilliamson | None
)
_Detrend: TypeAlias = Literal["offset", "plane", "quadratic"]
_Window: TypeAlias = Literal["split-cosine-bell", "hann", "none"]
_Form: TypeAlias = Literal["exact", "interpolated"]
_Reading: TypeAlias = Literal["implicit", "added"]

__version__: str

class Error(Exception): ...
class InvalidInput(Error, ValueError): ...
class OutOfRange(Error): ...
class NotConverged(Error): ...

@final
class HeightMap:
    def __init__(self, heights: ArrayLike, *, pixel_size: float | tuple[float, float]) -> None: ...
    @property
    def heights(self) -> NDArray[Any]: ...
    @property
    def pixel_size(self) -> tuple[float, float]: ...
    @property
    def dropout_fraction(self) -> float: ...
    @property
    def rms_height(self) -> float: ...
    @property
    def rms_slope(self) -> float: ...
    @property
    def skewness(self) -> float: ...
    @property
    def kurtosis(self) -> float: ...
    @property
    def z_max(self) -> float: ...
    @property
    def z_min(self) -> float: ...
    def fill_dropouts(self, *, max_fraction: float = 0.10) -> HeightMap: ...
    def detrend(self, order: _Detrend) -> HeightMap: ...
    def affine_shift(self, p: float) -> HeightMap: ...
    def local_peaks(self, *, min_distance: float, periodic: bool = False) -> _Array: ...

@final
class SelfAffineSpectrum:
    def __init__(
        self,
        *,
        rms_height: float,
        hurst: float,
        q0: float,
        q1: float,
        rolloff: float | None = None,
    ) -> None: ...
    @staticmethod
    def from_article(*, h0: float, hurst: float, q0: float, q1: float) -> SelfAffineSpectrum: ...
    @property
    def rms_height(self) -> float: ...
    @property
    def hurst(self) -> float: ...
    @property
    def q0(self) -> float: ...
    @property
    def q1(self) -> float: ...
    @property
    def rolloff(self) -> float | None: ...
    @property
    def rms_slope(self) -> float: ...
    def at(self, wavenumber: ArrayLike) -> _Result: ...
    def truncated(
        self, *, q0: float | None = None, q1: float | None = None
    ) -> SelfAffineSpectrum: ...
    def cutoff_for_slope(self, slope: float = 1.3) -> float: ...
    def cutoff_for_contamination(self, size: float) -> float: ...
    def scaled(self, factor: float) -> SelfAffineSpectrum: ...
    def autocorrelation(self, distance: ArrayLike) -> _Result: ...

@final
class TabulatedSpectrum:
    def __init__(
        self,
        *,
        wavenumber: ArrayLike,
        density: ArrayLike,
        count: ArrayLike | None = None,
    ) -> None: ...
    @property
    def wavenumber(self) -> _Array: ...
    @property
    def density(self) -> _Array: ...
    @property
    def count(self) -> _Array | None: ...
    @property
    def rms_height(self) -> float: ...
    @property
    def rms_slope(self) -> float: ...
    @property
    def q0(self) -> float: ...
    @property
    def q1(self) -> float: ...
    def at(self, wavenumber: ArrayLike) -> _Result: ...
    def truncated(
        self, *, q0: float | None = None, q1: float | None = None
    ) -> TabulatedSpectrum: ...
    def cutoff_for_slope(self, slope: float = 1.3) -> float: ...
    def cutoff_for_contamination(self, size: float) -> float: ...
    def scaled(self, factor: float) -> TabulatedSpectrum: ...
    def autocorrelation(self, distance: ArrayLike) -> _Result: ...

@final
class SelfAffineFit:
    @property
    def rms_height(self) -> float: ...
    @property
    def hurst(self) -> float: ...
    @property
    def q0(self) -> float: ...
    @property
    def q1(self) -> float: ...
    @property
    def spectrum(self) -> SelfAffineSpectrum: ...
    @property
    def standard_errors(self) -> dict[str, float]: ...
    @property
    def rows(self) -> int: ...

def power_spectrum(
    surface: HeightMap,
    *,
    window: _Window = "split-cosine-bell",
    detrend: _Detrend | None = "plane",
    threads: int = 1,
) -> TabulatedSpectrum: ...
def fit_self_affine(
    spectrum: TabulatedSpectrum,
    *,
    q_min: float | None = None,
    q_max: float | None = None,
) -> SelfAffineFit: ...
def synthesize(
    spectrum: _Spectrum,
    *,
    shape: tuple[int, int],
    pixel_size: float | tuple[float, float],
    seed: int,
) -> HeightMap: ...

@final
class PronySeries:
    def __init__(
        self,
        *,
        equilibrium_modulus: float,
        moduli: ArrayLike,
        relaxation_times: ArrayLike,
    ) -> None: ...
    @property
    def equilibrium_modulus(self) -> float: ...
    @property
    def moduli(self) -> _Array: ...
    @property
    def relaxation_times(self) -> _Array: ...
    def modulus(self, angular_frequency: ArrayLike) -> Any: ...
    def angular_integrals(self, angular_frequency: ArrayLike) -> tuple[Any, Any]: ...
    def shifted(self, a_T: float) -> PronySeries: ...

@final
class MasterCurve:
    def __init__(
        self,
        *,
        angular_frequency: ArrayLike,
        storage_modulus: ArrayLike,
        loss_modulus: ArrayLike,
        extrapolation: Literal["power-law", "clamp"] | None = None,
    ) -> None: ...
    @property
    def angular_frequency(self) -> _Array: ...
    @property
    def storage_modulus(self) -> _Array: ...
    @property
    def loss_modulus(self) -> _Array: ...
    @property
    def extrapolation(self) -> Literal["power-law", "clamp"] | None: ...
    def modulus(self, angular_frequency: ArrayLike) -> Any: ...
    def angular_integrals(self, angular_frequency: ArrayLike) -> tuple[Any, Any]: ...
    def extrapolated_shares(self, angular_frequency: ArrayLike) -> tuple[Any, Any]: ...
    def shifted(self, a_T: float) -> MasterCurve: ...

def effective_modulus(
    *,
    modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    modulus_2: ArrayLike = ...,
    poisson_ratio_2: ArrayLike = 0.0,
) -> _Result: ...
def hertz_penetration(*, force: float, effective_modulus: float, radius: float) -> float: ...

@final
class Separation:
    @property
    def effective(self) -> Any: ...
    @property
    def rigid(self) -> Any: ...
    @property
    def state(self) -> Any: ...

def separation(
    *,
    pressure: ArrayLike,
    effective_modulus: ArrayLike,
    rms_height: float,
    q0: float,
    peaks: ArrayLike | None = None,
    reading: _Reading = "implicit",
    z_max: float | None = None,
    z_min: float | None = None,
) -> Separation: ...

@final
class SFactor:
    def __init__(
        self,
        *,
        gamma: float = 0.5,
        applies_to: Literal["friction", "area", "both"] = "friction",
    ) -> None: ...
    @property
    def gamma(self) -> float: ...
    @property
    def applies_to(self) -> Literal["friction", "area", "both"]: ...

@final
class AffineShift:
    def __init__(self, p: float) -> None: ...
    @property
    def p(self) -> float: ...

@final
class LocalPeaks:
    def __init__(
        self,
        heights_or_map: ArrayLike | HeightMap,
        *,
        min_distance: float | None = None,
        z_max: float | None = None,
    ) -> None: ...
    @property
    def heights_or_map(self) -> Any: ...
    @property
    def heights(self) -> _Array: ...
    @property
    def min_distance(self) -> float | None: ...
    @property
    def z_max(self) -> float: ...
    @property
    def shift_factor(self) -> float: ...

@final
class GreenwoodWilliamson:
    def __init__(
        self,
        *,
        z_max: float,
        z_min: float,
        peaks: ArrayLike | None = None,
        reading: _Reading = "implicit",
        rms_height: float | None = None,
        q0: float | None = None,
    ) -> None: ...
    @property
    def z_max(self) -> float: ...
    @property
    def z_min(self) -> float: ...
    @property
    def peaks(self) -> _Array | None: ...
    @property
    def reading(self) -> _Reading: ...
    @property
    def rms_height(self) -> float | None: ...
    @property
    def q0(self) -> float | None: ...

@final
class PeaksThenGreenwoodWilliamson:
    def __init__(
        self,
        heights_or_map: ArrayLike | HeightMap,
        *,
        min_distance: float | None = None,
        z_max: float | None = None,
        z_min: float | None = None,
        reading: _Reading = "implicit",
        rms_height: float | None = None,
        q0: float | None = None,
    ) -> None: ...
    @property
    def heights_or_map(self) -> Any: ...
    @property
    def heights(self) -> _Array: ...
    @property
    def min_distance(self) -> float | None: ...
    @property
    def z_max(self) -> float: ...
    @property
    def z_min(self) -> float: ...
    @property
    def reading(self) -> _Reading: ...
    @property
    def rms_height(self) -> float | None: ...
    @property
    def q0(self) -> float | None: ...

def contact_area(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    form: _Form = "exact",
    wavenumber: ArrayLike | None = None,
    rtol: float = 1e-6,
) -> _Result: ...
def contact_notes(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
) -> tuple[str, ...]: ...
def mean_pressure(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    form: _Form = "exact",
    wavenumber: ArrayLike | None = None,
    rtol: float = 1e-6,
) -> _Result: ...
def correction_factor(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    form: _Form = "exact",
    wavenumber: ArrayLike,
    rtol: float = 1e-6,
) -> _Result: ...
def pressure_distribution(
    stress: ArrayLike,
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    wavenumber: float | None = None,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    rtol: float = 1e-6,
) -> _Result: ...

@final
class Adhesion:
    def __init__(
        self, *, shear_stress: float, reference_velocity: float = 6e-3, width: float = 0.1
    ) -> None: ...
    @property
    def shear_stress(self) -> float: ...
    @property
    def reference_velocity(self) -> float: ...
    @property
    def width(self) -> float: ...

@final
class Friction:
    @property
    def mu(self) -> _Result: ...
    @property
    def hysteresis(self) -> _Result: ...
    @property
    def adhesion(self) -> _Result: ...
    @property
    def contact_area(self) -> _Result: ...
    @property
    def shift_factor(self) -> _Result: ...
    @property
    def pressure(self) -> _Result: ...
    @property
    def velocity(self) -> _Result: ...
    @property
    def error_estimate(self) -> _Result: ...
    @property
    def extrapolated_share(self) -> _Result: ...
    @property
    def notes(self) -> tuple[str, ...]: ...
    @property
    def wavenumber(self) -> _Array | None: ...
    @property
    def dmu_dlnq(self) -> _Array | None: ...
    @property
    def decade_edges(self) -> _Array | None: ...
    @property
    def decade_share(self) -> _Array | None: ...

def friction(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    adhesion: Adhesion | None = None,
    form: _Form = "exact",
    rtol: float = 1e-6,
    contributions: bool = False,
) -> Friction: ...
