"""Values that an argument may not have, and arguments that do not go together: each is refused
by an error that has the argument's name, the value and what is allowed."""

import subprocess
import sys

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, OutOfRange
from helpers.calls import EVERY_CALL
from helpers.examples import ROAD, RUBBER

NAN, INF = np.nan, np.inf
HEIGHTS = np.random.default_rng(0).normal(size=(8, 9))
MAP = asperity.HeightMap(HEIGHTS, pixel_size=1e-6)
HOLED = asperity.HeightMap(np.where(HEIGHTS > 1, NAN, HEIGHTS), pixel_size=1e-6)
LOW, THIN = (asperity.HeightMap(HEIGHTS[:n, :n], pixel_size=1) for n in (2, 1))
PEAKS = [1e-4, 2e-4, 3e-4]
BAND = {"rms_height": 1e-4, "hurst": 0.8, "q0": 1e3, "q1": 1e5}
SURFACE = asperity.SelfAffineSpectrum(**BAND)
TABLE = asperity.TabulatedSpectrum(wavenumber=[1e3, 1e4, 1e5], density=[1e-12, 1e-16, 1e-20])
GROWING = asperity.TabulatedSpectrum(wavenumber=[1, 2, 3], density=[1, 2, 3])
ZEROS = asperity.TabulatedSpectrum(wavenumber=[1e3, 1e6], density=[0, 0])
CURVE = {"storage_modulus": [1e6, 1e7, 1e8], "loss_modulus": [1e5, 1e6, 1e7]}
MEASURED = asperity.MasterCurve(angular_frequency=[1.0, 1e3, 1e6], **CURVE)
SCENE = {"pressure": 1e5, "velocity": 0.01}
TALL = {"z_max": 3e-4, "z_min": -3e-4}
GAPS = {"pressure": 1e5, "effective_modulus": 1e7, "rms_height": 1e-4, "q0": 1e3}

POSITIVE = [0, -1, NAN, INF]
NOT_NEGATIVE = [-1, NAN, INF]
FINITE = [NAN, INF, -INF]
SHARE = [-0.1, 1.1, NAN]
HURST = [0, -1, 1.1, NAN]
POISSON = [-0.1, 0.51, NAN, INF]
AT_LEAST_ONE = [0.5, 0, -1, NAN, INF]
RTOL = [0, -1, NAN, 1e-13, 1]
NAME = ["x", ""]
VECTOR = [[[1, 2, 3]], np.array(5.0)]
ROWS = [[0, 1, 2], [-1, 1, 2], [NAN, 1, 2], [INF, 1, 2], *VECTOR]
DENSITIES = [[1, -1, 1], [1, NAN, 1], [1, INF, 1], [1, 2], [], [1] * 5, *VECTOR]
FEW_PEAKS = [[], [1, 2], [1e-4, 2e-4, NAN], [1e-4, 2e-4, INF], *VECTOR]
EVERYWHERE = {
    "pressure velocity": [*POSITIVE, [0, 1]],
    "poisson_ratio": POISSON,
    "rtol": RTOL,
    "method": NAME,
}
REFUSED = {  # several arguments that refuse the same stand in one key
    "SelfAffineSpectrum": {
        "rms_height q0": POSITIVE,
        "hurst": HURST,
        "q1": [1e3, 10, -1, NAN, INF],
        "rolloff": [1e3, 1e5, 0, NAN],
    },
    "SelfAffineSpectrum.from_article": {"h0 q0": POSITIVE, "hurst": HURST, "q1": [1e3, NAN, INF]},
    "TabulatedSpectrum": {
        "wavenumber": [*ROWS, [1, 1, 2], [2, 1, 3]],
        "density": DENSITIES,
        "count": DENSITIES,
        "q1": [1e3, 1e9, NAN],
    },
    **{
        f"{kind}Spectrum.{method}": refused
        for kind in ("SelfAffine", "Tabulated")
        for method, refused in {
            "at": {"wavenumber": POSITIVE},
            "truncated": {"q0 q1": [NAN]},
            "cutoff_for_slope": {"slope": POSITIVE},
            "cutoff_for_contamination": {"size": [*POSITIVE, 10.0]},
            "scaled": {"factor": POSITIVE},
            "autocorrelation": {"distance": NOT_NEGATIVE},
        }.items()
    },
    "PronySeries": {
        "equilibrium_modulus": NOT_NEGATIVE,
        "moduli relaxation_times": [[0], [-1], [NAN], [INF], *VECTOR],
    },
    "PronySeries.modulus": {"angular_frequency": NOT_NEGATIVE},
    "PronySeries.angular_integrals": {"angular_frequency": NOT_NEGATIVE},
    "PronySeries.shifted": {"a_T": POSITIVE},
    "MasterCurve": {
        "angular_frequency": [*ROWS, [1, 1, 2], [2, 1, 3], [1e9, np.nextafter(1e9, 2e9), 1e12]],
        "storage_modulus loss_modulus": [*ROWS, [1, 2], [1] * 5],
        "extrapolation": NAME,
    },
    "MasterCurve.modulus": {"angular_frequency": POSITIVE},
    "MasterCurve.angular_integrals": {"angular_frequency": POSITIVE},
    "MasterCurve.extrapolated_shares": {"angular_frequency": POSITIVE},
    "MasterCurve.shifted": {"a_T": POSITIVE},
    "effective_modulus": {
        "modulus": POSITIVE,
        "modulus_2": [0, -1, NAN],
        "poisson_ratio poisson_ratio_2": POISSON,
    },
    "hertz_penetration": {"force": NOT_NEGATIVE, "effective_modulus radius": POSITIVE},
    "separation": {
        "pressure effective_modulus": POSITIVE,
        "rms_height q0": POSITIVE,
        "peaks": FEW_PEAKS,
        "reading": NAME,
    },
    "HeightMap": {
        "heights": [
            *(HEIGHTS[0], HEIGHTS[None], np.array(5.0), np.empty((0, 3)), np.empty((3, 0))),
            *(np.full((3, 3), NAN), [[1, INF]], [[1, -INF]], HEIGHTS * 1j, [["a"]], [[1, 2], [3]]),
        ],
        "pixel_size": [*POSITIVE, (1, 0), (-1, 1), (1, NAN)],
    },
    "LineScan": {
        "heights": [[], np.zeros((3, 4)), [NAN, NAN], [1, INF]],
        "spacing": POSITIVE,
    },
    "HeightMap.fill_dropouts": {"max_fraction": [-0.1, 1, 1.5, NAN]},
    "HeightMap.detrend": {"order": NAME},
    "HeightMap.affine_shift": {"p": AT_LEAST_ONE},
    "HeightMap.local_peaks": {"min_distance": POSITIVE},
    "power_spectrum": {"surface": [HOLED, LOW, THIN], "window detrend": NAME},
    "fit_self_affine": {"q_min": POSITIVE, "q_max": POSITIVE},
    "synthesize": {
        "spectrum": [SURFACE.truncated(q1=2e3), ZEROS],
        "shape": [(1, 8), (8, 1), (0, 0), (-1, 8)],
        "pixel_size": POSITIVE,
        "seed": [-1, 2**64],
        "skewness": [-2.001, 2.001, NAN, INF],
    },
    "SFactor": {"gamma": SHARE, "applies_to": NAME},
    "NayakSFactor": {"friction_gamma": SHARE},
    "ImplicitSFactor": {"gamma": SHARE},
    "ScanContact": {"periodic": ["fade", None], "tolerance": [0, -1, NAN, 0.2]},
    "AffineShift": {"p": AT_LEAST_ONE},
    "LocalPeaks": {
        "heights_or_map": VECTOR,
        "z_max": [*FINITE, 0, 1e-4, -1],
    },
    "GreenwoodWilliamson": {
        "z_max": [*FINITE, 0, -1],
        "z_min": [*FINITE, 0, 1],
        "peaks": FEW_PEAKS,
        "reading": NAME,
        "rms_height q0": POSITIVE,
    },
    "PeaksThenGreenwoodWilliamson": {
        "heights_or_map": VECTOR,
        "z_max": [*FINITE, 0, 1e-6],
        "z_min": [*FINITE, 0, 1],
        "reading": NAME,
        "rms_height q0": POSITIVE,
    },
    "contact_area": {**EVERYWHERE, "wavenumber": [*POSITIVE, [], [[1e4]]], "form": NAME},
    "mean_pressure": {**EVERYWHERE, "wavenumber": [*POSITIVE, [], [[1e4]]], "form": NAME},
    "correction_factor": {**EVERYWHERE, "wavenumber": [*POSITIVE, [], [[1e4]]], "form": NAME},
    "friction": {**EVERYWHERE, "form": NAME, "threads": [0, 1025]},
    "friction_band friction_map": {"threads": [0, 1025]},
    "pressure_distribution": {**EVERYWHERE, "wavenumber": [*POSITIVE, 1e3], "stress": NOT_NEGATIVE},
    "Adhesion": {"shear_stress width": NOT_NEGATIVE, "reference_velocity": POSITIVE},
    "StrainFactors": {
        "strain": [[0.1, 0.1, 0.5], [-0.1, 0.1, 0.5]],
        "storage loss": [[1, 0, 0.5], [1, 1, NAN], [1, 1]],
        "strain_per_slope": POSITIVE,
    },
    "Heating": {
        "density": [1.2, NAN],
        "heat_capacity": [1.65, NAN],
        "conductivity": [230.0, NAN],
        "contact_diameter": [0.0, -INF],
        "macro_area": [1.1, NAN],
        "interface_share": [-0.1, NAN],
        "residence": ["ring"],
    },
    "WLF": {"c1 c2": POSITIVE, "reference_temperature": [0.0, 20.0, NAN]},  # no degrees Celsius
}
SOFTENED = {"strain": [0.01, 0.1, 0.5], "storage": [0.8, 0.5, 0.3], "loss": [1.2, 0.8, 0.4]}
SHORT = {  # three rows, as the bad values
    "TabulatedSpectrum": TABLE,
    "MasterCurve": MEASURED,
    "StrainFactors": asperity.StrainFactors(**SOFTENED),
}
BAD_VALUES = [
    pytest.param(call, argument, value, id=f"{call}-{argument}-{i}")
    for calls, arguments in REFUSED.items()
    for call in calls.split()
    for names, values in arguments.items()
    for argument in names.split()
    for i, value in enumerate(values)
]


@pytest.mark.parametrize(("call", "argument", "value"), BAD_VALUES)
def test_a_bad_value_is_refused_by_its_argument(call, argument, value):
    function, good = EVERY_CALL[call]
    if call in SHORT:
        good = SHORT[call]._arguments()
    with pytest.raises(InvalidInput) as caught:
        function(**{**good, argument: value})
    error = caught.value
    assert error.argument == argument
    if isinstance(value, int | float):
        assert error.allowed
        assert error.value == pytest.approx(value, rel=1e-12, nan_ok=True)


def waves(**changed):
    return asperity.contact_area(SURFACE, RUBBER, **SCENE, **changed)


def friction(pressure, velocity, rubber=RUBBER):
    return asperity.friction(SURFACE, rubber, pressure=pressure, velocity=velocity)


def table(**given):
    return asperity.TabulatedSpectrum(wavenumber=[1e3, 1e4], density=[1e-15, 1e-18], **given)


def prony(modulus, moduli, times):
    return asperity.PronySeries(equilibrium_modulus=modulus, moduli=moduli, relaxation_times=times)


TOGETHER = [
    ("q1", lambda: TABLE.truncated(q0=1e4, q1=5e3)),
    ("q1", lambda: ROAD.truncated(q1=1.5e3)),  # below the roll-off
    ("q0", lambda: SURFACE.truncated(q0=1e9)),
    ("q1", lambda: SURFACE.truncated(q1=1)),
    ("kurtosis", lambda: table(skewness=1.0, kurtosis=1.5)),  # below 1 + skewness^2
    ("kurtosis", lambda: table(skewness=1.0)),
    ("kurtosis", lambda: table(curvature_kurtosis=3.0)),
    ("curvature_kurtosis", lambda: table(skewness=0, kurtosis=3.0, curvature_kurtosis=0.5)),
    ("skewness", lambda: table(skewness=NAN, kurtosis=3.0)),
    ("slope_ratio", lambda: table(skewness=0, kurtosis=3.0, slope_ratio=0.5)),
    ("sine", lambda: table(cosine=[[0.1], [0.1]])),
    ("cosine", lambda: table(cosine=[[1.1], [0.1]], sine=[[0.0], [0.0]])),
    ("axis_ratio", lambda: asperity.SelfAffineSpectrum(**BAND, axis_ratio=0.5)),
    ("moduli", lambda: prony(1, [1, 2], [1])),
    ("equilibrium_modulus", lambda: prony(0, [], [])),
    ("heights", lambda: HOLED.fill_dropouts(max_fraction=0.01)),
    ("heights", lambda: HOLED.local_peaks(min_distance=1)),
    ("heights", lambda: LOW.rms_slope),
    ("q_max", lambda: asperity.fit_self_affine(TABLE, q_min=1e4, q_max=1e3)),
    ("q_min", lambda: asperity.fit_self_affine(TABLE, q_min=5e4)),
    ("spectrum", lambda: asperity.fit_self_affine(GROWING)),
    ("z_min", lambda: asperity.separation(**GAPS, z_max=1e-4)),
    ("z_max", lambda: asperity.separation(**GAPS, z_max=-1e-4, z_min=1e-4)),
    ("z_max", lambda: asperity.separation(**GAPS, z_max=NAN, z_min=0)),
    ("heights_or_map", lambda: asperity.LocalPeaks([-1, -2, -3])),
    ("heights_or_map", lambda: asperity.LocalPeaks([1, 1, 1])),
    ("heights_or_map", lambda: asperity.LocalPeaks([2e-4, 1e-4])),
    ("min_distance", lambda: asperity.LocalPeaks(MAP)),
    ("min_distance", lambda: asperity.LocalPeaks(PEAKS, min_distance=1e-6)),
    ("min_distance", lambda: asperity.LocalPeaks(MAP, min_distance=1.0)),
    ("z_min", lambda: asperity.PeaksThenGreenwoodWilliamson(PEAKS)),
    ("z_max", lambda: asperity.GreenwoodWilliamson(**TALL, peaks=[1, 2, 3])),
    ("pressure", lambda: friction([], 1)),
    ("pressure", lambda: friction(1, np.empty((3, 0)))),
    ("", lambda: friction([1, 2, 3], [1, 2])),  # of two arguments
    ("", lambda: asperity.separation(**GAPS | {"pressure": [1, 2], "effective_modulus": [1] * 3})),
]


@pytest.mark.parametrize(("argument", "call"), TOGETHER)
def test_what_does_not_go_together_is_refused_by_one_argument(argument, call):
    with pytest.raises(InvalidInput) as caught:
        call()
    assert caught.value.argument == argument


@pytest.mark.parametrize(("name", "other"), [("cosine", "harmonics"), ("correlation", "lags")])
def test_one_row_for_all_wavenumbers_lacks_an_axis(name, other):
    with pytest.raises(InvalidInput) as caught:
        table(**{name: [0.1, 0.2]})
    assert (caught.value.argument, caught.value.allowed) == (name, f"two axes, rows and {other}")
    assert caught.value.value == repr(np.array([0.1, 0.2]))


def test_too_few_peaks_are_said_so_by_their_code():
    with pytest.raises(InvalidInput) as caught:
        asperity.LocalPeaks([1e-4])
    assert (caught.value.code, caught.value.argument) == ("too-few-entries", "heights_or_map")


OUTSIDE = [
    ("wavenumber", 1e9, lambda: TABLE.at(1e9)),
    ("wavenumber", 10, lambda: TABLE.at([1e4, 10])),
    ("wavenumber", 1e9, lambda: waves(wavenumber=1e9)),
    ("wavenumber", 10, lambda: waves(wavenumber=[1e4, 10])),
    ("angular_frequency", 1e-3, lambda: MEASURED.modulus(1e-3)),
    ("angular_frequency", 1e-3, lambda: MEASURED.angular_integrals(1e-3)),
    ("angular_frequency", 1e-3, lambda: MEASURED.extrapolated_shares(1e-3)),
    ("velocity", 1e-6, lambda: friction(1e5, 1e-6, MEASURED)),
    ("velocity", 11, lambda: friction(1e5, [1, 11], MEASURED)),
    ("q0", 1, lambda: TABLE.truncated(q0=1)),
    ("q0", 1e9, lambda: TABLE.truncated(q0=1e9)),
    ("q1", 1e9, lambda: TABLE.truncated(q1=1e9)),
]


@pytest.mark.parametrize(("argument", "value", "call"), OUTSIDE)
def test_what_was_not_measured_is_out_of_range(argument, value, call):
    with pytest.raises(OutOfRange) as caught:
        call()
    assert not isinstance(caught.value, ValueError)
    assert (caught.value.argument, caught.value.value) == (argument, value)


def test_velocities_that_are_said_to_be_allowed_are():
    """However the last of their digits is rounded."""
    curve = asperity.MasterCurve(angular_frequency=[1.23456789, 1e3, 3.3333333e7], **CURVE)
    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1900, q1=28571.4286)
    with pytest.raises(OutOfRange) as error:
        asperity.friction(road, curve, pressure=1e5, velocity=1e5)
    (offered,) = [one for one in error.value.sentence if len(getattr(one, "numbers", ())) == 2]
    shown = [float(word) for word in offered.split() if word[0].isdigit()]
    for velocity in (*offered.numbers, *shown):
        assert asperity.friction(road, curve, pressure=1e5, velocity=velocity).mu > 0


def test_absurd_but_finite_numbers_end_in_a_number_or_an_error():
    code = """
import math, asperity
r = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
for rms_height, pressure in (1e-4, 1e-160), (1e200, 1e5), (1e-4, 1e300), (1e-160, 1e5):
    try:
        s = asperity.SelfAffineSpectrum(rms_height=rms_height, hurst=0.8, q0=1e3, q1=1e5)
        f = asperity.friction(s, r, pressure=pressure, velocity=0.01)
        assert math.isfinite(f.mu) and 0 <= f.contact_area <= 1
    except asperity.Error:
        pass
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=20)


def test_bad_input_is_a_value_error_and_an_error_of_the_package():
    assert issubclass(InvalidInput, ValueError)
    assert issubclass(InvalidInput, asperity.Error)
