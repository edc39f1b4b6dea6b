from collections.abc import Iterable
from os import PathLike
from typing import Any, Literal, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Array: TypeAlias = NDArray[np.float64]
_Result: TypeAlias = Any  # float for scalar arguments, else an array of their broadcast shape
_Spectrum: TypeAlias = SelfAffineSpectrum | TabulatedSpectrum
_Rubber: TypeAlias = PronySeries | MasterCurve
_Correction: TypeAlias = (
    SFactor
    | NayakSFactor
    | AffineShift
    | LocalPeaks
    | GreenwoodWilliamson
    | PeaksThenGreenwoodWilliamson
    | None
)
_Detrend: TypeAlias = Literal["offset", "plane", "quadratic"]
_Window: TypeAlias = Literal["split-cosine-bell", "hann", "none"]
_Form: TypeAlias = Literal["exact", "interpolated"]
_Method: TypeAlias = Literal["gauss", "qag", "qags", "cquad"]
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
    def height_histogram(self, *, bins: int = 100) -> tuple[_Array, _Array]: ...

@final
class LineScan:
    def __init__(self, heights: ArrayLike, *, spacing: float) -> None: ...
    @property
    def heights(self) -> NDArray[Any]: ...
    @property
    def spacing(self) -> float: ...
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
    def fill_dropouts(self, *, max_fraction: float = 0.10) -> LineScan: ...
    def detrend(self, order: _Detrend) -> LineScan: ...
    def affine_shift(self, p: float) -> LineScan: ...
    def local_peaks(self, *, min_distance: float, periodic: bool = False) -> _Array: ...
    def height_histogram(self, *, bins: int = 100) -> tuple[_Array, _Array]: ...

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
    @property
    def nayak_parameter(self) -> float: ...
    def at(self, wavenumber: ArrayLike) -> _Result: ...
    def extended(
        self, *, q0: float | None = None, q1: float | None = None
    ) -> SelfAffineSpectrum: ...
    def truncated(
        self, *, q0: float | None = None, q1: float | None = None
    ) -> SelfAffineSpectrum: ...
    def cutoff_for_slope(self, slope: float = 1.3) -> float: ...
    def cutoff_for_contamination(self, size: float) -> float: ...
    def scaled(self, factor: float) -> SelfAffineSpectrum: ...
    def line_density(self, wavenumber: ArrayLike) -> _Result: ...
    def autocorrelation(self, distance: ArrayLike) -> _Result: ...

@final
class TabulatedSpectrum:
    def __init__(
        self,
        *,
        wavenumber: ArrayLike,
        density: ArrayLike,
        count: ArrayLike | None = None,
        standard_error: ArrayLike | None = None,
        flag: ArrayLike | None = None,
    ) -> None: ...
    @property
    def wavenumber(self) -> _Array: ...
    @property
    def density(self) -> _Array: ...
    @property
    def count(self) -> _Array | None: ...
    @property
    def standard_error(self) -> _Array | None: ...
    @property
    def flag(self) -> NDArray[np.uint8] | None: ...
    @property
    def reliable(self) -> NDArray[np.bool_]: ...
    @property
    def rms_height(self) -> float: ...
    @property
    def rms_slope(self) -> float: ...
    @property
    def nayak_parameter(self) -> float: ...
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
    def log_binned(self, *, per_decade: float = 10.0) -> TabulatedSpectrum: ...
    def line_density(self, wavenumber: ArrayLike) -> _Result: ...
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
    def covariance(self) -> _Array: ...
    @property
    def standard_errors(self) -> dict[str, float]: ...
    @property
    def rolloff(self) -> float | None: ...
    @property
    def residual(self) -> float: ...
    @property
    def rows(self) -> int: ...

def power_spectrum(
    surface: HeightMap,
    *,
    window: _Window = "split-cosine-bell",
    detrend: _Detrend | None = "plane",
    threads: int = 1,
    part: Literal["all", "top", "bottom"] = "all",
) -> TabulatedSpectrum: ...

@final
class SpectralDensity:
    @property
    def wavenumber_y(self) -> _Array: ...
    @property
    def wavenumber_x(self) -> _Array: ...
    @property
    def density(self) -> _Array: ...

def spectral_density(
    surface: HeightMap,
    *,
    window: _Window = "split-cosine-bell",
    detrend: _Detrend | None = "plane",
) -> SpectralDensity: ...

@final
class Anisotropy:
    @property
    def across(self) -> float: ...
    @property
    def along(self) -> float: ...
    @property
    def direction(self) -> float: ...
    @property
    def ratio(self) -> float: ...

def anisotropy(
    surface: HeightMap,
    *,
    window: _Window = "split-cosine-bell",
    detrend: _Detrend | None = "plane",
    q_min: float | None = None,
    q_max: float | None = None,
) -> Anisotropy: ...

@final
class LineSpectrum:
    def __init__(
        self,
        *,
        wavenumber: ArrayLike,
        density: ArrayLike,
        count: ArrayLike | None = None,
        standard_error: ArrayLike | None = None,
        flag: ArrayLike | None = None,
    ) -> None: ...
    @property
    def wavenumber(self) -> _Array: ...
    @property
    def density(self) -> _Array: ...
    @property
    def count(self) -> _Array | None: ...
    @property
    def standard_error(self) -> _Array | None: ...
    @property
    def flag(self) -> NDArray[np.uint8] | None: ...
    @property
    def reliable(self) -> NDArray[np.bool_]: ...
    def log_binned(self, *, per_decade: float = 10.0) -> LineSpectrum: ...
    def isotropic(self, *, per_decade: float | None = 10.0) -> TabulatedSpectrum: ...

def line_spectrum(
    surface: LineScan | HeightMap,
    *,
    window: _Window = "split-cosine-bell",
    detrend: _Detrend | None = "plane",
) -> LineSpectrum: ...
def merge_spectra(
    spectra: Iterable[TabulatedSpectrum], *, per_decade: float | None = None
) -> TabulatedSpectrum: ...
def fit_self_affine(
    spectrum: TabulatedSpectrum,
    *,
    q_min: float | None = None,
    q_max: float | None = None,
    method: Literal["least-squares", "slope"] = "least-squares",
    rolloff: Literal["find", "require", "none"] = "find",
) -> SelfAffineFit: ...
def synthesize(
    spectrum: _Spectrum,
    *,
    shape: tuple[int, int],
    pixel_size: float | tuple[float, float],
    seed: int,
    skewness: float = 0.0,
) -> HeightMap: ...

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
        shift_factors: ShiftFactors | MasterCurveBuild | None = None,
    ) -> None: ...
    @property
    def angular_frequency(self) -> _Array: ...
    @property
    def storage_modulus(self) -> _Array: ...
    @property
    def loss_modulus(self) -> _Array: ...
    @property
    def extrapolation(self) -> Literal["power-law", "clamp"] | None: ...
    @property
    def shift_factors(self) -> ShiftFactors | None: ...
    def at_strain(
        self,
        strain: float,
        sweeps: Iterable[StrainSweep],
        *,
        shift_factors: ShiftFactors | MasterCurveBuild | None = None,
    ) -> MasterCurve: ...
    def modulus(self, angular_frequency: ArrayLike) -> Any: ...
    def angular_integrals(self, angular_frequency: ArrayLike) -> tuple[Any, Any]: ...
    def extrapolated_shares(self, angular_frequency: ArrayLike) -> tuple[Any, Any]: ...
    def shifted(self, a_T: float) -> MasterCurve: ...

@final
class Isotherm:
    def __init__(
        self,
        *,
        temperature: float,
        angular_frequency: ArrayLike,
        storage_modulus: ArrayLike,
        loss_modulus: ArrayLike,
        notes: Iterable[str] | None = None,
    ) -> None: ...
    @property
    def temperature(self) -> float: ...
    @property
    def angular_frequency(self) -> _Array: ...
    @property
    def storage_modulus(self) -> _Array: ...
    @property
    def loss_modulus(self) -> _Array: ...
    @property
    def notes(self) -> tuple[str, ...]: ...

@final
class WlfFit:
    @property
    def c1(self) -> float: ...
    @property
    def c2(self) -> float: ...
    @property
    def reference_temperature(self) -> float: ...
    @property
    def standard_errors(self) -> dict[str, float]: ...
    @property
    def residual(self) -> float: ...

@final
class ArrheniusFit:
    @property
    def activation_energy(self) -> float: ...
    @property
    def reference_temperature(self) -> float: ...
    @property
    def standard_errors(self) -> dict[str, float]: ...
    @property
    def residual(self) -> float: ...

@final
class ShiftFactors:
    def __init__(
        self,
        *,
        reference_temperature: float,
        temperature: ArrayLike,
        log10_a_T: ArrayLike,
        standard_deviation: ArrayLike | None = None,
    ) -> None: ...
    @property
    def reference_temperature(self) -> float: ...
    @property
    def temperature(self) -> _Array: ...
    @property
    def log10_a_T(self) -> _Array: ...
    @property
    def standard_deviation(self) -> _Array | None: ...
    def shift_factor(self, temperature: ArrayLike) -> _Result: ...
    def fit_wlf(self) -> WlfFit: ...
    def fit_arrhenius(self) -> ArrheniusFit: ...

@final
class MasterPoints:
    @property
    def angular_frequency(self) -> _Array: ...
    @property
    def storage_modulus(self) -> _Array: ...
    @property
    def loss_modulus(self) -> _Array: ...
    @property
    def isotherm(self) -> NDArray[np.int64]: ...

@final
class MasterCurveBuild:
    def __init__(
        self,
        *,
        master_curve: MasterCurve,
        shift_factors: ShiftFactors,
        b_T: ArrayLike,
        points: MasterPoints,
        residual: float,
        covariance: ArrayLike,
        notes: Iterable[str] = (),
    ) -> None: ...
    @property
    def master_curve(self) -> MasterCurve: ...
    @property
    def shift_factors(self) -> ShiftFactors: ...
    @property
    def reference_temperature(self) -> float: ...
    @property
    def temperature(self) -> _Array: ...
    @property
    def log10_a_T(self) -> _Array: ...
    @property
    def standard_deviation(self) -> _Array: ...
    @property
    def covariance(self) -> _Array: ...
    @property
    def undetermined(self) -> NDArray[np.bool_]: ...
    @property
    def b_T(self) -> _Array: ...
    @property
    def points(self) -> MasterPoints: ...
    @property
    def residual(self) -> float: ...
    @property
    def notes(self) -> tuple[str, ...]: ...
    def shift_factor(self, temperature: ArrayLike) -> _Result: ...
    def fit_wlf(self) -> WlfFit: ...
    def fit_arrhenius(self) -> ArrheniusFit: ...

def draw_master_curve(build: MasterCurveBuild, seed: int) -> MasterCurveBuild: ...
def build_master_curve(
    isotherms: Iterable[Isotherm],
    *,
    reference_temperature: float,
    vertical_shift: Literal["T/T_ref"] | ArrayLike | None = None,
    shift_factors: ShiftFactors | MasterCurveBuild | None = None,
    smooth: bool = False,
    extrapolation: Literal["power-law", "clamp"] | None = None,
) -> MasterCurveBuild: ...

@final
class PronyFit(PronySeries):
    def __init__(
        self,
        *,
        equilibrium_modulus: float,
        moduli: ArrayLike,
        relaxation_times: ArrayLike,
        storage_residual: float,
        loss_residual: float,
        causal: bool,
        notes: Iterable[str] = (),
    ) -> None: ...
    @property
    def storage_residual(self) -> float: ...
    @property
    def loss_residual(self) -> float: ...
    @property
    def causal(self) -> bool: ...
    @property
    def notes(self) -> tuple[str, ...]: ...

def fit_prony(
    master_curve: MasterCurve | MasterCurveBuild,
    *,
    modes_per_decade: float | None = None,
    residual: float | None = None,
) -> PronyFit: ...

@final
class StrainSweep:
    def __init__(
        self,
        *,
        temperature: float,
        angular_frequency: float,
        strain: ArrayLike,
        storage_modulus: ArrayLike,
        loss_modulus: ArrayLike,
    ) -> None: ...
    @property
    def temperature(self) -> float: ...
    @property
    def angular_frequency(self) -> float: ...
    @property
    def strain(self) -> _Array: ...
    @property
    def storage_modulus(self) -> _Array: ...
    @property
    def loss_modulus(self) -> _Array: ...

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
class NayakSFactor:
    def __init__(self, *, friction_gamma: float = 0.4) -> None: ...
    @property
    def friction_gamma(self) -> float: ...

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
    method: _Method = "gauss",
) -> _Result: ...
def contact_notes(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    form: _Form = "exact",
    rtol: float = 1e-6,
    method: _Method = "gauss",
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
    method: _Method = "gauss",
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
    method: _Method = "gauss",
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
    method: _Method = "gauss",
) -> _Result: ...

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
    method: _Method = "gauss",
) -> Friction: ...

@final
class AdhesionFit(Adhesion):
    def __init__(
        self,
        *,
        shear_stress: float,
        reference_velocity: float,
        width: float,
        covariance: ArrayLike,
        residual: float,
        outliers: ArrayLike,
        notes: Iterable[str] = (),
    ) -> None: ...
    @property
    def covariance(self) -> _Array: ...
    @property
    def residual(self) -> float: ...
    @property
    def outliers(self) -> NDArray[np.bool_]: ...
    @property
    def notes(self) -> tuple[str, ...]: ...
    @property
    def adhesion(self) -> Adhesion: ...
    @property
    def standard_errors(self) -> dict[str, float]: ...
    @property
    def log10_reference_velocity_error(self) -> float: ...

def fit_adhesion(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    velocity: ArrayLike,
    mu: ArrayLike,
    pressure: ArrayLike,
    fixed: dict[str, float] = ...,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    form: _Form = "exact",
    rtol: float = 1e-6,
    method: _Method = "gauss",
) -> AdhesionFit: ...

@final
class FrictionSlopes:
    def __init__(self, **kwargs: Any) -> None: ...
    @property
    def dmu_dlnp(self) -> Any: ...
    @property
    def dmu_dlnv(self) -> Any: ...

@final
class FrictionMap:
    def mu(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        shift_factor: ArrayLike = 1.0,
        shift_adhesion: bool = False,
        outside: Literal["error", "nan", "clamp"] = "error",
    ) -> Any: ...
    def hysteresis(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        shift_factor: ArrayLike = 1.0,
        shift_adhesion: bool = False,
        outside: Literal["error", "nan", "clamp"] = "error",
    ) -> Any: ...
    def adhesion(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        shift_factor: ArrayLike = 1.0,
        shift_adhesion: bool = False,
        outside: Literal["error", "nan", "clamp"] = "error",
    ) -> Any: ...
    def contact_area(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        shift_factor: ArrayLike = 1.0,
        shift_adhesion: bool = False,
        outside: Literal["error", "nan", "clamp"] = "error",
    ) -> Any: ...
    def traction(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        shift_factor: ArrayLike = 1.0,
        shift_adhesion: bool = False,
        outside: Literal["error", "nan", "clamp"] = "error",
    ) -> Any: ...
    def derivatives(
        self,
        pressure: ArrayLike,
        velocity: ArrayLike,
        *,
        shift_factor: ArrayLike = 1.0,
        shift_adhesion: bool = False,
        outside: Literal["error", "nan", "clamp"] = "error",
    ) -> FrictionSlopes: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> FrictionMap: ...
    @staticmethod
    def from_bytes(content: bytes) -> FrictionMap: ...
    def to_bytes(self) -> bytes: ...
    @property
    def pressure(self) -> tuple[float, float]: ...
    @property
    def velocity(self) -> tuple[float, float]: ...
    @property
    def rtol(self) -> float: ...
    @property
    def max_error(self) -> float: ...
    @property
    def checked(self) -> int: ...
    @property
    def exceeded(self) -> int: ...
    @property
    def largest_checked_error(self) -> float: ...
    @property
    def cells(self) -> int: ...
    @property
    def notes(self) -> tuple[str, ...]: ...
    @property
    def text(self) -> str: ...
    @property
    def adhesion_law(self) -> Adhesion | None: ...

def friction_map(
    spectrum: _Spectrum,
    rubber: _Rubber,
    *,
    pressure: tuple[float, float],
    velocity: tuple[float, float],
    rtol: float = 1e-4,
    poisson_ratio: float = 0.5,
    correction: _Correction = None,
    adhesion: Adhesion | None = None,
    form: _Form = "exact",
    method: _Method = "gauss",
    checked: int = 1_000_000,
    text: str = "",
) -> FrictionMap: ...
