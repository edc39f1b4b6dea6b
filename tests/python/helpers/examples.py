"""A value or more of every public class, for the tests of what all values can do."""

import numpy as np

import asperity

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5, rolloff=2e3)
RUBBER = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
TABLE = {"wavenumber": [1e3, 1e4, 1e5], "density": [1e-12, 1e-16, 1e-20]}
HEIGHTS = np.arange(12.0).reshape(3, 4)
PEAKS = [1e-4, 2e-4, 3e-4]
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
FITTED_ROAD = asperity.SelfAffineFit(**FIT)
SLIDING = {"pressure": [1e5, 2e5], "velocity": 0.01}


def isotherm(temperature, log10_a_T):  # noqa: N803
    """Of a broad rubber; a second point within 1 % of the first, which are averaged."""
    w = np.array([1.0, 1.009, 3.0, 10.0, 30.0, 100.0])
    modulus = asperity.PronySeries(
        equilibrium_modulus=1e6,
        moduli=np.geomspace(1e8, 1e6, 7),
        relaxation_times=np.geomspace(1e-5, 10, 7),
    ).modulus(w * 10**log10_a_T)
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
]
IDS = [f"{name}{i}" for i, (name, _, _) in enumerate(MADE)]
RESULTS = {
    "Friction": asperity.friction(ROAD, RUBBER, pressure=[1e5, 2e5], velocity=0.01),
    "Friction with contributions": asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=0.01, contributions=True
    ),
    "Separation": asperity.separation(**SEPARATION),
    "Separation with states": asperity.separation(**SEPARATION, z_max=1e-3, z_min=-1e-3),
    "WlfFit": asperity.ShiftFactors(
        **{**SHIFTS, "temperature": [263, 283, 293, 303], "log10_a_T": [3.2, 0.9, 0, -0.8]}
    ).fit_wlf(),
    "ArrheniusFit": asperity.ShiftFactors(**SHIFTS).fit_arrhenius(),
    "Anisotropy": asperity.anisotropy(
        asperity.HeightMap(np.random.default_rng(1).normal(size=(80, 80)), pixel_size=1.0)
    ),
    "SpectralDensity": asperity.spectral_density(asperity.HeightMap(HEIGHTS, pixel_size=1.0)),
    "MasterCurveBuild": BUILD,
    "MasterPoints": BUILD.points,
    "PronyFit of a build": asperity.fit_prony(BUILD),
    "FrictionSlopes": FMAP.derivatives([1.5e5, 1.8e5], 0.1),
    "FrictionBand": asperity.friction_band(FITTED_ROAD, RUBBER, **SLIDING, samples=20),
    "LocalPeaks of a map": asperity.LocalPeaks(
        asperity.synthesize(ROAD, shape=(40, 40), pixel_size=3e-4, seed=1), min_distance=1e-3
    ),
}
VALUES = [getattr(asperity, name)(**arguments) for name, arguments, _ in MADE]
EVERY = dict(zip(IDS, VALUES, strict=True)) | RESULTS
