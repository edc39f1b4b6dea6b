"""Foolish inputs to every public function: the message has name, value and what is allowed."""

import re
from itertools import product

import numpy as np
import pytest

import asperity
from asperity import InvalidInput
from helpers.cases import case

NAN, INF = np.nan, np.inf
HEIGHTS = np.random.default_rng(0).normal(size=(8, 9))
HOLED = np.where(np.arange(72).reshape(8, 9) == 10, NAN, HEIGHTS)
MAP = asperity.HeightMap(HEIGHTS, pixel_size=1e-6)
HOLED_MAP = asperity.HeightMap(HOLED, pixel_size=1e-6)
PEAKS = [1e-4, 2e-4, 3e-4]

BAND = {"hurst": 0.8, "q0": 1e3, "q1": 1e5}
ROWS = {"wavenumber": [1e3, 1e4, 1e5], "density": [1e-12, 1e-16, 1e-20]}
CURVE = {
    "angular_frequency": [1.0, 1e3, 1e6],
    "storage_modulus": [1e6, 1e7, 1e8],
    "loss_modulus": [1e5, 1e6, 1e7],
}
MODES = {"equilibrium_modulus": 1e6, "moduli": [1e8], "relaxation_times": [1e-4]}
SURFACE = asperity.SelfAffineSpectrum(rms_height=1e-4, **BAND)
TABLE = asperity.TabulatedSpectrum(**ROWS)
RUBBER = asperity.PronySeries(**MODES)
MEASURED = asperity.MasterCurve(**CURVE)
SCENE = {"spectrum": SURFACE, "rubber": RUBBER, "pressure": 1e5, "velocity": 0.01}
ASPERITIES = {"pressure": 1e5, "effective_modulus": 1e7, "rms_height": 1e-4, "q0": 1e3}
PEAKS_AND_BOTTOM = {"heights_or_map": PEAKS, "z_min": -3e-4}
PROFILE = {"z_max": 3e-4, "z_min": -3e-4}


GROWING = asperity.TabulatedSpectrum(wavenumber=[1, 2, 3], density=[1, 2, 3])
SPECTRAL = {
    "at": {"wavenumber": 1e4},
    "truncated": {},
    "cutoff_for_slope": {},
    "cutoff_for_contamination": {"size": 1e-4},
    "scaled": {"factor": 2},
    "autocorrelation": {"distance": 0},
}
MECHANICAL = {
    "modulus": {"angular_frequency": 1},
    "angular_integrals": {"angular_frequency": 1},
    "shifted": {"a_T": 1},
}
# A call that works, to be spoilt in one argument.
CALLS = {
    "SelfAffineSpectrum": (asperity.SelfAffineSpectrum, {"rms_height": 1e-4, **BAND}),
    "from_article": (asperity.SelfAffineSpectrum.from_article, {"h0": 1e-4, **BAND}),
    "TabulatedSpectrum": (asperity.TabulatedSpectrum, ROWS),
    **{
        f"{kind} {method}": (getattr(spectrum, method), good)
        for kind, spectrum in (("self-affine", SURFACE), ("tabulated", TABLE))
        for method, good in SPECTRAL.items()
    },
    "PronySeries": (asperity.PronySeries, MODES),
    "MasterCurve": (asperity.MasterCurve, CURVE),
    **{
        f"{kind} {method}": (getattr(rubber, method), good)
        for kind, rubber in (("prony", RUBBER), ("master", MEASURED))
        for method, good in MECHANICAL.items()
    },
    "extrapolated_shares": (MEASURED.extrapolated_shares, {"angular_frequency": 1}),
    "effective_modulus": (asperity.effective_modulus, {"modulus": 1e6, "poisson_ratio": 0.5}),
    "hertz_penetration": (
        asperity.hertz_penetration,
        {"force": 1.0, "effective_modulus": 1e6, "radius": 1e-3},
    ),
    "separation": (asperity.separation, ASPERITIES),
    "HeightMap": (asperity.HeightMap, {"heights": HEIGHTS, "pixel_size": 1e-6}),
    "fill_dropouts": (HOLED_MAP.fill_dropouts, {}),
    "detrend": (MAP.detrend, {"order": "plane"}),
    "affine_shift": (MAP.affine_shift, {"p": 2}),
    "local_peaks": (MAP.local_peaks, {"min_distance": 1e-6}),
    "rms_slope": (
        lambda heights: asperity.HeightMap(heights, pixel_size=1).rms_slope,
        {"heights": HEIGHTS},
    ),
    "power_spectrum": (asperity.power_spectrum, {"surface": MAP}),
    "fit_self_affine": (asperity.fit_self_affine, {"spectrum": TABLE}),
    "synthesize": (
        asperity.synthesize,
        {"spectrum": SURFACE, "shape": (32, 32), "pixel_size": 1e-4, "seed": 1},
    ),
    "SFactor": (asperity.SFactor, {}),
    "NayakSFactor": (asperity.NayakSFactor, {}),
    "ImplicitSFactor": (asperity.ImplicitSFactor, {}),
    "PartialContact": (asperity.PartialContact, {}),
    "ScanContact": (asperity.ScanContact, {"height_map": MAP}),
    "AffineShift": (asperity.AffineShift, {"p": 2}),
    "LocalPeaks": (asperity.LocalPeaks, {"heights_or_map": PEAKS}),
    "GreenwoodWilliamson": (asperity.GreenwoodWilliamson, PROFILE),
    "PeaksThenGreenwoodWilliamson": (asperity.PeaksThenGreenwoodWilliamson, PEAKS_AND_BOTTOM),
    "contact_area": (asperity.contact_area, SCENE),
    "mean_pressure": (asperity.mean_pressure, SCENE),
    "correction_factor": (asperity.correction_factor, {**SCENE, "wavenumber": 1e4}),
    "friction": (asperity.friction, SCENE),
    "pressure_distribution": (asperity.pressure_distribution, {**SCENE, "stress": 1e5}),
    "Adhesion": (asperity.Adhesion, {"shear_stress": 8e6}),
}

# Bad values, and what the message says is allowed, after the argument's name and a number.
POSITIVE = ([0, -1, NAN, INF], " = {}: .*positive")
NOT_NEGATIVE = ([-1, NAN, INF], " = {}: .*not (be )?negative")
FINITE = ([NAN, INF, -INF], " = {}: .*finite")
AT_LEAST_ONE = ([0.5, 0, -1, NAN, INF], " = {}: .*1 or more")
POISSON = ([-0.1, 0.51, NAN, INF], r" = {}: .*\[0, 0\.5\]")
SHARE = ([-0.1, 1.1, NAN], r" = {}: .*\[0, 1\]")
HURST = ([0, -1, 1.1, NAN], r" = {}: .*\(0, 1\]")
RTOL = ([0, -1, NAN, 1e-13, 1], r" = {}: .*\[1e-12, 0\.1\]")
SOME_POSITIVE = ([[0, 1, 2], [-1, 1, 2], [NAN, 1, 2], [INF, 1, 2]], r"(\[0\])? = \S+: .*positive")
SOME_NOT_NEGATIVE = ([[1, -1, 1], [1, NAN, 1], [1, INF, 1]], r"\[1\] = \S+: .*not (be )?negative")
RISING = ([[1, 1, 2], [2, 1, 3]], r"\[1\] = 1: .*above")
VECTOR = ([[[1, 2, 3]], np.array(5.0)], "[02] dimensions")
FEW_ROWS = ([[1, 2], [], [1] * 5], r"\b[025]\b.*\b3\b")
REAL = (["x", None, 1j, [1, 2j], ["a"]], "number")
NAME = (["x", ""], "one of")
ABOVE_Q0 = ([1e3, 10, -1], " = {}: .*above q0 = 1000")
SPECTRUM = ([None, RUBBER, "x", MAP], "SelfAffineSpectrum or a TabulatedSpectrum")
SOLID = ([None, SURFACE, 5.0], "PronySeries or a MasterCurve")
CORRECTION = (
    ["s-factor", 5, SURFACE],
    "None or one of SFactor, NayakSFactor, PartialContact, AffineShift, LocalPeaks",
)
FEW_PEAKS = ([[], [1, 2]], r"\b[02]\b.*3 or more")
NAN_PEAKS = ([[1e-4, 2e-4, NAN], [1e-4, 2e-4, INF]], r"(\[2\])? = (nan|inf): .*finite")
OUTSIDE_BAND = ([1, 1e9], r" = {}: .*\[1000, 100000\]")
LONG = ([1.0], r" = {}: .*below .*0\.00628319 m")
NO_MAP = ([HEIGHTS * 1j, [["a"]], [[1, 2], [3]], None, "x"], "array of real numbers")
NO_PEAKS = (["x", [1, 2, 3j]], "number")
BELOW_A_PEAK = ([0, 1e-4], r" = {}: .*highest peak, 0\.0003")

REFUSED = {  # several arguments of which the same is said stand in one key
    "SelfAffineSpectrum": {
        "rms_height q0": [POSITIVE],
        "hurst": [HURST],
        "q1": [ABOVE_Q0, FINITE],
        "rolloff": [([1e3, 1e5, 0, NAN], " = {}: .*q0 = 1000 and q1 = 100000")],
    },
    "from_article": {"h0 q0": [POSITIVE], "hurst": [HURST], "q1": [ABOVE_Q0, FINITE]},
    "TabulatedSpectrum": {
        "wavenumber": [SOME_POSITIVE, RISING, VECTOR, REAL],
        "density": [SOME_NOT_NEGATIVE, VECTOR, FEW_ROWS, REAL],
        "count": [SOME_NOT_NEGATIVE, VECTOR, ([[1, 2], [1] * 5], FEW_ROWS[1])],
    },
    **{
        f"{kind} {method}": groups
        for kind in ("self-affine", "tabulated")
        for method, groups in {
            "at": {"wavenumber": [POSITIVE, REAL]},
            "truncated": {"q0 q1": [([NAN], FINITE[1])]},
            "cutoff_for_slope": {"slope": [POSITIVE]},
            "cutoff_for_contamination": {"size": [POSITIVE, LONG]},
            "scaled": {"factor": [POSITIVE]},
            "autocorrelation": {"distance": [NOT_NEGATIVE, REAL]},
        }.items()
    },
    "PronySeries": {
        "equilibrium_modulus": [NOT_NEGATIVE],
        "moduli relaxation_times": [([[0], [-1], [NAN], [INF]], SOME_POSITIVE[1]), VECTOR, REAL],
    },
    "MasterCurve": {
        "angular_frequency": [SOME_POSITIVE, RISING, VECTOR, REAL],
        "storage_modulus loss_modulus": [SOME_POSITIVE, VECTOR, FEW_ROWS, REAL],
        "extrapolation": [NAME],
    },
    **{
        f"{kind} {method}": {"angular_frequency": [sign, REAL]}
        for kind, sign in (("prony", NOT_NEGATIVE), ("master", POSITIVE))
        for method in ("modulus", "angular_integrals")
    },
    "extrapolated_shares": {"angular_frequency": [POSITIVE, REAL]},
    **{f"{kind} shifted": {"a_T": [POSITIVE]} for kind in ("prony", "master")},
    "effective_modulus": {
        "modulus": [POSITIVE],
        "modulus_2": [([0, -1, NAN], POSITIVE[1])],
        "poisson_ratio poisson_ratio_2": [POISSON],
    },
    "hertz_penetration": {"force": [NOT_NEGATIVE], "effective_modulus radius": [POSITIVE]},
    "separation": {
        "pressure effective_modulus": [POSITIVE, REAL, SOME_POSITIVE],
        "rms_height q0": [POSITIVE],
        "peaks": [FEW_PEAKS, NAN_PEAKS, VECTOR, NO_PEAKS],
        "reading": [NAME],
    },
    "HeightMap": {
        "heights": [
            ([HEIGHTS[0], HEIGHTS[None], np.array(5.0)], r"shape \(.*of shape \(ny, nx\)"),
            ([np.empty((0, 3)), np.empty((3, 0))], r"\([03], [03]\).*empty"),
            ([np.full((3, 3), NAN)], "every point is a drop-out"),
            ([[[1, INF]], [[1, -INF]]], r"\[0, 1\] = -?inf: .*finite"),
            NO_MAP,
        ],
        "pixel_size": [POSITIVE, ([(1, 0), (-1, 1), (1, NAN)], "positive")],
    },
    "fill_dropouts": {"max_fraction": [([-0.1, 1, 1.5, NAN], r" = {}: .*\[0, 1\)")]},
    "detrend": {"order": [NAME]},
    "affine_shift": {"p": [AT_LEAST_ONE]},
    "local_peaks": {"min_distance": [POSITIVE]},
    "rms_slope": {"heights": [([HEIGHTS[:2], HEIGHTS[:, :2]], "3 x 3")]},
    "power_spectrum": {
        "surface": [([HOLED_MAP], r"drop-outs .*1\.389 %.*fill_dropouts")],
        "window": [NAME],
        "detrend": [NAME],
    },
    "fit_self_affine": {
        "q_min": [POSITIVE, ([5e4, 1e9], "[01] rows .*3 or more")],
        "q_max": [POSITIVE],
        "spectrum": [([GROWING], r".*hurst = -1\.5: .*\(0, 1\]")],
    },
    "synthesize": {
        "spectrum": [SPECTRUM],
        "shape": [([(1, 8), (8, 1), (0, 0)], "2 x 2"), ([(-1, 8)], "0 or more")],
        "pixel_size": [POSITIVE],
        "seed": [([-1, 2**64], "from 0 to 18446744073709551615")],
    },
    "SFactor": {"gamma": [SHARE], "applies_to": [NAME]},
    "NayakSFactor": {"friction_gamma": [SHARE]},
    "ImplicitSFactor": {"gamma": [SHARE]},
    "PartialContact": {},
    "ScanContact": {
        "height_map": [([None, SURFACE, 5.0], "must be a HeightMap")],
        "periodic": [(["fade", False, None, 1], 'must be "blend", "mirror" or True')],
        "tolerance": [([0, -1, NAN, 0.2], r" = {}: .*\[0\.001, 0\.1\]")],
    },
    "AffineShift": {"p": [AT_LEAST_ONE]},
    "LocalPeaks": {
        "heights_or_map": [VECTOR, REAL],
        "min_distance": [([1e-6], "HeightMap")],
        "z_max": [FINITE, BELOW_A_PEAK, ([-1], BELOW_A_PEAK[1])],
    },
    "GreenwoodWilliamson": {
        "z_max": [FINITE, ([0, -1], " = {}: .*above the mean plane")],
        "z_min": [FINITE, ([0, 1], " = {}: .*below the mean plane")],
        "peaks": [FEW_PEAKS, NAN_PEAKS, VECTOR, NO_PEAKS],
        "reading": [NAME],
        "rms_height q0": [POSITIVE],
    },
    "PeaksThenGreenwoodWilliamson": {
        "heights_or_map": [VECTOR, REAL],
        "z_max": [FINITE, BELOW_A_PEAK],
        "z_min": [FINITE, ([0, 1], " = {}: .*below"), ([None], "given")],
        "reading": [NAME],
        "rms_height q0": [POSITIVE],
    },
    **{
        name: {
            "spectrum": [SPECTRUM],
            "rubber": [SOLID],
            "pressure velocity": [POSITIVE, REAL, SOME_POSITIVE],
            "poisson_ratio": [POISSON],
            "correction": [CORRECTION],
            "rtol": [RTOL],
            "method": [NAME],
        }
        | ({} if name == "friction" else {"wavenumber": [POSITIVE]})
        | (
            {"stress": [NOT_NEGATIVE, REAL]}
            if name == "pressure_distribution"
            else {"form": [NAME]}
        )
        for name in list(CALLS)[-6:-1]
    },
    "self-affine truncated": {"q0 q1": [([NAN], FINITE[1]), OUTSIDE_BAND]},
    "Adhesion": {"shear_stress width": [NOT_NEGATIVE], "reference_velocity": [POSITIVE]},
}


@pytest.mark.parametrize("call", CALLS)
def test_bad_values_are_refused_by_argument_value_and_what_is_allowed(call):
    function, good = CALLS[call]
    function(**good)
    for names, groups in REFUSED.get(call, {}).items():
        for argument, (values, allowed) in product(names.split(), groups):
            for value in values:
                with case(argument=argument, value=value):
                    number = isinstance(value, int | float)
                    shown = rf"(?:{value:.12g}|{value:.6g})".replace("+", r"\+") if number else ".*"
                    with pytest.raises(InvalidInput) as caught:
                        function(**{**good, argument: value})
                    said = rf"{argument}(?!\w).*" + allowed.replace("{}", shown)
                    assert re.match(said, str(caught.value)), str(caught.value)
                    assert caught.value.argument == argument, caught.value.sentence


def test_bad_input_is_a_value_error_and_an_error_of_the_package():
    assert issubclass(InvalidInput, ValueError)
    assert issubclass(InvalidInput, asperity.Error)
