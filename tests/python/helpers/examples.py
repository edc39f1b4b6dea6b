"""A value or more of every public class, and a call of every function that works."""

import inspect
import warnings

import numpy as np

import asperity
from helpers.rubbers import prony

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5, rolloff=2e3)
RUBBER = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
TABLE = {"wavenumber": [1e3, 1e4, 1e5], "density": [1e-12, 1e-16, 1e-20]}
HEIGHTS = np.arange(12.0).reshape(3, 4)
PEAKS = [1e-4, 2e-4, 3e-4]
TABLES = {
    "surface": {"rms_height_m": 1e-4, "hurst": 0.8, "q0_per_m": 1e3, "q1_per_m": 1e5},
    "rubber": {
        "equilibrium_modulus_pa": 1e6,
        "moduli_pa": [1e8],
        "relaxation_times_s": [1e-4],
    },
    "conditions": {"pressure_pa": 1e5, "velocity_m_s": 0.1},
    "adhesion": {"shear_stress_pa": 1e6},
}
MEASURED = {"mu": [0.4, 0.3, 0.4, 0.5], "velocity": [1e-3, 1e-2, 0.1, 1.0]}
FIT = {
    "spectrum": ROAD,
    "covariance": np.array([[1e-12, 2e-9, 1e-6], [2e-9, 1e-4, 0.02], [1e-6, 0.02, 100.0]]),
    "residual": 0.1,
    "rows": 17,
}
CURVE = {
    "angular_frequency": [1.0, 1e3, 1e6],
    "storage_modulus": [1e6, 1e7, 1e8],
    "loss_modulus": [1e5, 1e6, 1e7],
}
SWEEP = {
    "angular_frequency": [1.0, 10.0, 100.0, 1000.0],
    "storage_modulus": [1e6, 2e6, 3e6, 4e6],
    "loss_modulus": [1e5, 2e5, 3e5, 4e5],
}
SHIFTS = {
    "reference_temperature": 293.0,
    "temperature": [273.0, 293.0, 313.0],
    "log10_a_T": [2.0, 0.0, -1.5],
}
SOFT = {"strain": [0.01, 0.5], "storage": [0.8, 0.4], "loss": [1.1, 0.5]}
STRAIN = {
    "temperature": 293.0,
    "angular_frequency": 6.0,
    "strain": [1e-3, 1e-2],
    "storage_modulus": [2e6, 1e6],
    "loss_modulus": [2e5, 2.5e5],
}
FITTED = {
    "equilibrium_modulus": 1e6,
    "moduli": [1e8],
    "relaxation_times": [1e-4],
    "storage_residual": 0.01,
    "loss_residual": 0.02,
    "causal": True,
    "lowest_frequency": 1.0,
    "highest_frequency": 1e6,
    "notes": ("a note",),
}
STICKING = {
    "shear_stress": 8e6,
    "reference_velocity": 6e-3,
    "width": 0.1,
    "covariance": [[1e10, 10.0, 0.1], [10.0, 1e-6, 1e-6], [0.1, 1e-6, 1e-4]],
    "residual": 0.05,
    "outliers": [[False, True]],
    "notes": ("a note",),
}
SCAN = asperity.synthesize(ROAD, shape=(48, 40), pixel_size=2e-4, seed=1)
LAW = {"c1": 8.86, "c2": 101.6, "reference_temperature": 293.15}
TREAD = {
    "density": 1200.0,
    "heat_capacity": 1650.0,
    "conductivity": 0.23,
    "contact_diameter": 1e-3,
}
FITTED_ROAD = asperity.SelfAffineFit(**FIT)
SLIDING = {"pressure": [1e5, 2e5], "velocity": 0.01}


def isotherm(temperature, log10_a_T):  # noqa: N803
    """Of a broad rubber; a second point within 1 % of the first, which are averaged."""
    w = np.array([1.0, 1.009, 3.0, 10.0, 30.0, 100.0])
    modulus = prony(1e6, np.geomspace(1e8, 1e6, 7), np.geomspace(1e-5, 10, 7)).modulus(
        w * 10**log10_a_T
    )
    return asperity.Isotherm(
        temperature=temperature,
        angular_frequency=w,
        storage_modulus=modulus.real,
        loss_modulus=modulus.imag,
    )


SWEPT = [isotherm(283.0, 1.0), isotherm(293.0, 0.0), isotherm(303.0, -0.8)]
BUILD = asperity.build_master_curve(SWEPT, reference_temperature=293.0)
FMAP = asperity.friction_map(
    ROAD,
    RUBBER,
    pressure=(1e5, 2e5),
    velocity=(1e-2, 1.0),
    rtol=1e-3,
    checked=100,
    text="of this",
)
SEPARATION = {"pressure": [1e5, 1e6], "effective_modulus": 1e7, "rms_height": 1e-4, "q0": 1e3}
# class, the arguments it is made from, one argument changed
MADE = [
    ("SelfAffineSpectrum", {"rms_height": 1e-4, "hurst": 0.8, "q0": 1e3, "q1": 1e5}, {"q1": 2e5}),
    ("TabulatedSpectrum", {**TABLE, "count": [4, 8, 12]}, {"count": [4, 8, 13]}),
    ("TabulatedSpectrum", TABLE, {"count": [4, 8, 13]}),
    ("HeightMap", {"heights": HEIGHTS, "pixel_size": (1e-6, 2e-6)}, {"pixel_size": 1e-6}),
    ("HeightMap", {"heights": np.where(HEIGHTS == 5, np.nan, HEIGHTS), "pixel_size": 1.0}, None),
    ("SelfAffineFit", FIT, {"rows": 18}),
    ("PronySeries", {"equilibrium_modulus": 1e6, "moduli": [], "relaxation_times": []}, None),
    (
        "PronySeries",
        {"equilibrium_modulus": 1e6, "moduli": [1e8], "relaxation_times": [1e-4]},
        {"moduli": [2e8]},
    ),
    ("MasterCurve", CURVE, {"extrapolation": "clamp"}),
    (
        "MasterCurve",
        {**CURVE, "shift_factors": asperity.ShiftFactors(**SHIFTS)},
        {"shift_factors": None},
    ),
    ("LineScan", {"heights": HEIGHTS[0], "spacing": 1e-6}, {"spacing": 2e-6}),
    ("LineSpectrum", {**TABLE, "count": [2, 2, 2], "flag": [1, 0, 2]}, {"flag": [0, 0, 2]}),
    ("TabulatedSpectrum", {**TABLE, "standard_error": [1e-13, 1e-17, 1e-21]}, {"flag": [0, 0, 4]}),
    ("Isotherm", {"temperature": 293.0, **SWEEP}, {"temperature": 294.0}),
    ("ShiftFactors", SHIFTS, {"standard_deviation": [0.1, 0, 0.1]}),
    ("StrainSweep", STRAIN, {"angular_frequency": 7.0}),
    ("PronyFit", FITTED, {"causal": False}),
    ("SFactor", {"gamma": 0.4, "applies_to": "both"}, {"applies_to": "area"}),
    ("NayakSFactor", {"friction_gamma": 0.4}, {"friction_gamma": 1.0}),
    ("AffineShift", {"p": 2.0}, {"p": 2.1}),
    ("LocalPeaks", {"heights_or_map": PEAKS}, {"z_max": 4e-4}),
    ("GreenwoodWilliamson", {"z_max": 1e-3, "z_min": -1e-3}, {"peaks": PEAKS}),
    (
        "PeaksThenGreenwoodWilliamson",
        {"heights_or_map": PEAKS, "z_min": -1e-3},
        {"reading": "added"},
    ),
    ("Adhesion", {"shear_stress": 8e6}, {"width": 0.2}),
    ("AdhesionFit", STICKING, {"residual": 0.06}),
    ("AdhesionFit", STICKING, {"outliers": [[True, False]]}),
    ("PartialContact", {}, None),
    ("ScanContact", {"height_map": SCAN}, {"tolerance": 0.01}),
    ("WLF", LAW, {"c2": 50.0}),
    ("Heating", TREAD, {"interface_share": 0.5}),
    ("Heating", TREAD | {"macro_area": 0.2}, {"residence": "box"}),
    ("ImplicitSFactor", {"gamma": 0.45}, {"gamma": 0.4}),
    ("StrainFactors", SOFT, {"strain_per_slope": 0.4}),
]
IDS = [f"{name}{i}" for i, (name, _, _) in enumerate(MADE)]
RESULTS = {
    "Friction": asperity.friction(ROAD, RUBBER, pressure=[1e5, 2e5], velocity=0.01),
    "Friction with contributions": asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=0.01, contributions=True
    ),
    "Gradients": asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=0.01, gradients=True
    ).gradients,
    "Separation": asperity.separation(**SEPARATION),
    "Separation with states": asperity.separation(**SEPARATION, z_max=1e-3, z_min=-1e-3),
    "WlfFit": asperity.ShiftFactors(
        **{**SHIFTS, "temperature": [263, 283, 293, 303], "log10_a_T": [3.2, 0.9, 0, -0.8]}
    ).fit_wlf(),
    "ArrheniusFit": asperity.ShiftFactors(**SHIFTS).fit_arrhenius(),
    "Anisotropy": asperity.anisotropy(
        asperity.HeightMap(np.random.default_rng(1).normal(size=(80, 80)), pixel_size=1.0)
    ),
    "HeightStatistics": asperity.height_statistics(
        np.random.default_rng(1).normal(size=(9, 8)), pixel_size=1.0
    ),
    "SpectralDensity": asperity.spectral_density(asperity.HeightMap(HEIGHTS, pixel_size=1.0)),
    "MasterCurveBuild": BUILD,
    "MasterPoints": BUILD.points,
    "PronyFit of a build": asperity.fit_prony(BUILD, extrapolation="prony"),
    "FrictionSlopes": FMAP.derivatives([1.5e5, 1.8e5], 0.1),
    "SceneFit": asperity.fit_scene(TABLES, MEASURED, free=["adhesion.shear_stress_pa"]),
    "FrictionBand": asperity.friction_band(FITTED_ROAD, RUBBER, **SLIDING, samples=20),
    "LocalPeaks of a map": asperity.LocalPeaks(
        asperity.synthesize(ROAD, shape=(40, 40), pixel_size=3e-4, seed=1), min_distance=1e-3
    ),
}
VALUES = [getattr(asperity, name)(**arguments) for name, arguments, _ in MADE]
EVERY = dict(zip(IDS, VALUES, strict=True)) | RESULTS

ROUGH = asperity.synthesize(ROAD, shape=(48, 40), pixel_size=1e-4, seed=2)
STRIDED = asperity.HeightMap(ROUGH.heights.astype("f4")[::-1, ::2], pixel_size=(1e-4, 2e-4))
HOLED = asperity.HeightMap(
    np.where(np.abs(ROUGH.heights) > 2e-4, np.nan, ROUGH.heights), pixel_size=1e-4
)
SCANNED = asperity.power_spectrum(ROUGH)
SLOW = asperity.MasterCurve(
    **CURVE, shift_factors=asperity.ShiftFactors(**SHIFTS, standard_deviation=[0.1, 0, 0.2])
)
SWEEPS = [
    asperity.StrainSweep(
        temperature=t,
        angular_frequency=6.0,
        strain=[1e-3, 5e-3, 0.3],
        storage_modulus=[2e6, 1.9e6, 1e6],
        loss_modulus=[2e5, 2.5e5, 2e5],
    )
    for t in (273.0, 293.0, 313.0)
]
STICKY = asperity.Adhesion(shear_stress=8e6)


def large_strain(strain, sweeps):
    """The slow rubber at a strain, without the warning that the sweeps do not span the curve."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return SLOW.at_strain(strain, sweeps)


def crowded():
    """Points whose means lie within 1 % of the next point: averaged twice they would be others."""
    w = [1.0, 1.009, 1.0111, 2.0, 3.0, 4.0]
    return asperity.Isotherm(
        temperature=293.0,
        angular_frequency=w,
        storage_modulus=np.multiply(w, 1e6),
        loss_modulus=np.multiply(w, 1e5),
    )


# States that no constructor's argument gives: what methods and fits made of them.
DERIVED = {
    "an isotherm with averaged rows": crowded(),
    "a strided float32 map": STRIDED,
    "a map with drop-outs": HOLED,
    "a map that was filled": HOLED.fill_dropouts(),
    "a detrended map": STRIDED.detrend("quadratic"),
    "a shifted map": ROUGH.affine_shift(2.0),
    "a strided line scan": asperity.LineScan(ROUGH.heights[3, ::-2], spacing=2e-4),
    "a measured spectrum": SCANNED,
    "a spectrum cut between its rows": SCANNED.truncated(q0=2000.0, q1=1e4),
    "a spectrum in bins": SCANNED.log_binned(per_decade=5),
    "a merged spectrum": asperity.merge_spectra([SCANNED, SCANNED.scaled(1.1)]),
    "a line spectrum": asperity.line_spectrum(STRIDED),
    "a line spectrum in bins": asperity.line_spectrum(ROUGH).log_binned(per_decade=6),
    "a cut self-affine spectrum": ROAD.truncated(q0=1234.5, q1=5e4),
    "the article's spectrum": asperity.SelfAffineSpectrum.from_article(
        h0=1e-4, hurst=0.8, q0=1e3, q1=1e5
    ),
    "a fit of the slope": asperity.fit_self_affine(SCANNED, q_min=2e3, q_max=2e4, method="slope"),
    "a warm series": RUBBER.shifted(0.3),
    "a warm master curve": SLOW.shifted(0.3),
    "a curve at large strain": large_strain(0.2, SWEEPS),
    "a smooth build": asperity.build_master_curve(
        SWEPT, reference_temperature=290.0, smooth=True, extrapolation="clamp"
    ),
    "its rubber": asperity.fit_prony(BUILD, extrapolation="prony"),
    "peaks of a strided map": asperity.LocalPeaks(STRIDED, min_distance=5e-4),
    "peaks and more of a map": asperity.PeaksThenGreenwoodWilliamson(ROUGH, min_distance=5e-4),
    "friction at a point": asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=0.01),
    "friction of many points": asperity.friction(
        ROAD, RUBBER, pressure=np.array([[1e5], [2e5]]), velocity=np.geomspace(1e-3, 1, 40)
    ),
    "contributions at many points": asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=[0.01, 0.1], contributions=True
    ),
    "friction at temperatures": asperity.friction(
        ROAD,
        RUBBER,
        pressure=1e5,
        velocity=[0.01, 0.1],
        temperature=[[263.0], [293.0], [313.0]],
        shift=asperity.WLF(**LAW),
    ),
    "friction with its heat": asperity.friction(
        ROAD,
        RUBBER,
        pressure=1e5,
        velocity=[0.01, 0.1],
        temperature=293.0,
        shift=asperity.WLF(**LAW),
        heating=asperity.Heating(**TREAD),
        contributions=True,
    ),
    "no friction": asperity.friction(
        ROAD,
        RUBBER,
        pressure=1.0,
        velocity=0.01,
        correction=asperity.GreenwoodWilliamson(z_max=1e-5, z_min=-1e-3),
    ),
    "no slopes": FMAP.derivatives([1.0, 2.0], 0.1, outside="nan"),
    "a band at a point": asperity.friction_band(
        FITTED_ROAD, RUBBER, pressure=1e5, velocity=0.01, samples=20
    ),
}
ALL = EVERY | DERIVED | {"FrictionMap": FMAP}
PUBLIC = {name: getattr(asperity, name) for name in asperity.__all__}
CLASSES = {
    name: made
    for name, made in PUBLIC.items()
    if inspect.isclass(made) and not issubclass(made, Exception)
}
FUNCTIONS = {name: made for name, made in PUBLIC.items() if inspect.isfunction(made)}
AT = {"pressure": 1e5, "velocity": 0.01}
SLIDES = {"spectrum": ROAD, "rubber": RUBBER, **AT}
# A call of every function but those that read files.
CALLS = {
    "anisotropy": {"surface": ROUGH, "q_min": 3e3, "q_max": 1.5e4},
    "build_master_curve": {"isotherms": SWEPT, "reference_temperature": 293.0},
    "contact_area": SLIDES,
    "contact_notes": SLIDES,
    "correction_factor": {**SLIDES, "wavenumber": 1e4},
    "effective_modulus": {"modulus": 1e6, "poisson_ratio": 0.5},
    "fit_adhesion": {
        "spectrum": ROAD,
        "rubber": RUBBER,
        "pressure": 1e5,
        "velocity": np.geomspace(1e-4, 0.5, 12),
        "mu": asperity.friction(
            ROAD, RUBBER, pressure=1e5, velocity=np.geomspace(1e-4, 0.5, 12), adhesion=STICKY
        ).mu,
    },
    "fit_prony": {"master_curve": BUILD},
    "fit_self_affine": {"spectrum": SCANNED, "q_min": 2e3, "q_max": 2e4},
    "friction": SLIDES,
    "friction_band": {**SLIDES, "spectrum": FITTED_ROAD, "samples": 20},
    "friction_map": {**SLIDES, "pressure": (1e5, 2e5), "velocity": (0.01, 1.0), "checked": 1},
    "strain_factors": {"sweeps": SWEEPS},
    "heat_kernel": {
        "q": 2e3,
        "q_prime": [2e3, 1e4],
        "velocity": 1.0,
        "heating": asperity.Heating(**TREAD),
    },
    "hertz_penetration": {"force": 1.0, "effective_modulus": 1e6, "radius": 1e-3},
    "line_spectrum": {"surface": ROUGH},
    "mean_pressure": SLIDES,
    "merge_spectra": {"spectra": [SCANNED, SCANNED]},
    "height_statistics": {"surface": ROUGH},
    "power_spectrum": {"surface": ROUGH},
    "prony_input": {"series": RUBBER, "program": "abaqus"},
    "pressure_distribution": {**SLIDES, "stress": 1e5},
    "separation": {**SEPARATION, "z_max": 1e-3, "z_min": -1e-3},
    "spectral_density": {"surface": ROUGH},
    "synthesize": {"spectrum": ROAD, "shape": (16, 16), "pixel_size": 1e-4, "seed": 1},
}
