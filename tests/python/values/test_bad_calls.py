"""Foolish combinations of arguments, and arguments of another kind (see test_bad_input)."""

import re
import subprocess
import sys

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, OutOfRange
from helpers.cases import case

SURFACE = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5)
ROLLED = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5, rolloff=1e4)
TABLE = asperity.TabulatedSpectrum(wavenumber=[1e3, 1e4, 1e5], density=[1e-12, 1e-16, 1e-20])
RUBBER = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
MEASURED = asperity.MasterCurve(
    angular_frequency=[1.0, 1e3, 1e6],
    storage_modulus=[1e6, 1e7, 1e8],
    loss_modulus=[1e5, 1e6, 1e7],
)
HEIGHTS = np.random.default_rng(0).normal(size=(8, 9))
MAP = asperity.HeightMap(HEIGHTS, pixel_size=1e-6)
HOLED = np.where(np.arange(72).reshape(8, 9) == 10, np.nan, HEIGHTS)
HOLED_MAP = asperity.HeightMap(HOLED, pixel_size=1e-6)
PEAKS = [1e-4, 2e-4, 3e-4]
ASPERITIES = {"pressure": 1e5, "effective_modulus": 1e7, "rms_height": 1e-4, "q0": 1e3}
SCENE = {"pressure": 1e5, "velocity": 0.01}
WAVES = (asperity.contact_area, asperity.mean_pressure, asperity.correction_factor)


def waves(**changed):
    """One call for each function over wavenumbers."""
    arguments = {**SCENE, "wavenumber": 1e4} | changed
    return [lambda f=f: f(SURFACE, RUBBER, **arguments) for f in WAVES]


def scenes(surface=SURFACE, rubber=RUBBER, **changed):
    """One call for each function of a whole scene."""
    arguments = SCENE | changed
    calls = [lambda f=f: f(surface, rubber, **arguments) for f in (asperity.friction, *WAVES[:2])]
    calls.append(lambda: asperity.correction_factor(surface, rubber, **arguments, wavenumber=1e4))
    calls.append(lambda: asperity.pressure_distribution(1e5, surface, rubber, **arguments))
    return calls


REFUSED = [
    ([lambda: TABLE.truncated(q0=1e4, q1=5e3)], "^q1 = 5000: must be above q0 = 10000$"),
    ([lambda: ROLLED.truncated(q1=5e3)], "^q1 = 5000: must be above the roll-off, 10000"),
    (
        [lambda: asperity.SelfAffineSpectrum(rms_height=1, hurst=1, q0=2, q1=1)],
        "^q1 = 1: must be above q0 = 2$",
    ),
    (
        [lambda: asperity.TabulatedSpectrum(wavenumber=[], density=[])],
        "^wavenumber has 0 entries: must be 2 or more$",
    ),
    (
        [lambda: asperity.PronySeries(equilibrium_modulus=1, moduli=[1, 2], relaxation_times=[1])],
        r"^moduli \(2\) and relaxation_times \(1\) must have equal length$",
    ),
    (
        [lambda: asperity.PronySeries(equilibrium_modulus=0, moduli=[], relaxation_times=[])],
        "^equilibrium_modulus = 0: must be positive where there are no moduli$",
    ),
    (
        [lambda: asperity.LineScan([], spacing=1.0)],
        r"^heights has shape \(0,\): must not be empty$",
    ),
    (
        [lambda: HOLED_MAP.fill_dropouts(max_fraction=0.01)],
        r"1\.389 % .* at most 1 %, max_fraction = 0.01",
    ),
    (
        [lambda: HOLED_MAP.local_peaks(min_distance=1)],
        r"^heights: has drop-outs; call fill_dropouts\(\) first",
    ),
    (
        [lambda: asperity.HeightMap(HEIGHTS[:1], pixel_size=1).rms_slope],
        r"^heights has shape \(1, 9\)",
    ),
    (
        [lambda: asperity.power_spectrum(asperity.HeightMap(HEIGHTS[:1], pixel_size=1))],
        r"^surface has shape \(1, 9\): must be",
    ),
    (
        [lambda: asperity.fit_self_affine(TABLE, q_min=1e4, q_max=1e3)],
        "^q_max = 1000: must be above q_min = 10000$",
    ),
    (
        [lambda: asperity.synthesize(SURFACE, shape=(8, 8), pixel_size=1.0, seed=1)],
        r"^spectrum: its band \[1000, 100000\] 1/m holds no mode of this grid",
    ),
    (
        [lambda: asperity.separation(**ASPERITIES, z_max=1e-4)],
        "^z_min: must be given with the other of z_max, z_min$",
    ),
    (
        [lambda: asperity.separation(**ASPERITIES, z_max=-1e-4, z_min=1e-4)],
        r"^z_max = -0\.0001: must be above z_min = 0\.0001$",
    ),
    (
        [
            lambda: asperity.separation(
                **{**ASPERITIES, "pressure": [1, 2], "q0": 1}, z_max=np.nan, z_min=0
            )
        ],
        "^z_max = nan: must be finite$",
    ),
    (
        [
            lambda: asperity.separation(
                **{**ASPERITIES, "pressure": [1, 2, 3], "effective_modulus": [1, 2]}
            )
        ],
        r"^shapes pressure \(3,\), effective_modulus \(2,\): must broadcast together; ",
    ),
    (
        [lambda: asperity.LocalPeaks([-1, -2, -3])],
        "^heights: their mean = -2: must be above the mean",
    ),
    (
        [lambda: asperity.LocalPeaks([1, 1, 1])],
        "^heights: their mean = 1: must be below z_max = 1$",
    ),
    ([lambda: asperity.LocalPeaks(MAP)], "^min_distance: must be given with a HeightMap"),
    (
        [lambda: asperity.PeaksThenGreenwoodWilliamson(PEAKS)],
        "^z_min: must be given where heights_or_map is no HeightMap$",
    ),
    (
        [lambda: asperity.GreenwoodWilliamson(z_max=3e-4, z_min=-3e-4, peaks=[1, 2, 3])],
        r"^z_max = 0\.0003: must be no lower than the highest peak, 3$",
    ),
    (
        scenes(pressure=[1, 2, 3], velocity=[1, 2]),
        r"pressure \(3,\), velocity \(2,\): must broadcast together; ",
    ),
    (scenes(pressure=[]), r"\bpressure\b.* 0 entries.*must have 1 or more"),
    (scenes(velocity=np.empty((3, 0))), r"\bvelocity\b.* 0 entries.*must have 1 or more"),
    (waves(wavenumber=[]), "^wavenumber has 0 entries: must be 1 or more$"),
    (waves(wavenumber=[[1e4]]), "^wavenumber has 2 dimensions: must have 0 or 1$"),
    (waves(wavenumber=[1e4, np.nan]), "^wavenumber = nan: must be positive and finite$"),
    (waves(wavenumber="x"), "^wavenumber = 'x': must be a number or an array of real numbers$"),
    (
        [lambda: asperity.pressure_distribution(1e5, SURFACE, RUBBER, **SCENE, wavenumber=1e3)],
        "^wavenumber = 1000: must be above q0",
    ),
    # an argument that the user gave must be named, not an inner one
    (
        [lambda: asperity.power_spectrum(asperity.HeightMap(HEIGHTS[:2, :2], pixel_size=1))],
        "^surface has shape",
    ),
    ([lambda: asperity.LocalPeaks(MAP, min_distance=1.0)], "min_distance = 1"),
    ([lambda: asperity.LocalPeaks([1e-4, 2e-4])], "^heights_or_map has 2 "),
    (
        [lambda: asperity.SelfAffineFit(spectrum=SURFACE, covariance=[[1]], residual=0, rows=3)],
        "^covariance",
    ),
    (
        [
            lambda: asperity.synthesize(
                asperity.TabulatedSpectrum(wavenumber=[1e3, 1e6], density=[0, 0]),
                shape=(8, 8),
                pixel_size=1e-4,
                seed=1,
            )
        ],
        "^spectrum: .*(zero|0)",
    ),
]


def test_foolish_combination_is_refused_by_name():
    for calls, message in REFUSED:
        for at, call in enumerate(calls):
            with case(message=message, at=at), pytest.raises(InvalidInput) as caught:
                call()
            assert re.search(message, str(caught.value))


TALL = {"z_max": 3e-4, "z_min": -3e-4}
OUTSIDE = [
    (
        [lambda: TABLE.at(1e9)],
        r"^wavenumber = 1e\+09: the spectrum is known in \[1000, 100000\] 1/m$",
    ),
    (
        [lambda: TABLE.at([1e4, 10])],
        r"^wavenumber = 10: the spectrum is known in \[1000, 100000\] 1/m$",
    ),
    (
        waves(wavenumber=1e9),
        r"^wavenumber = 1e\+09: the spectrum's band is \[1000, 100000\] 1/m$",
    ),
    (
        waves(wavenumber=[1e4, 10]),
        r"^wavenumber = 10: the spectrum's band is \[1000, 100000\] 1/m$",
    ),
    (
        [
            lambda f=f: f(1e-3)
            for f in (MEASURED.modulus, MEASURED.angular_integrals, MEASURED.extrapolated_shares)
        ],
        r"^angular_frequency = 0\.001 rad/s: .* in \[1, 1e\+06\] rad/s; extrapolation=",
    ),
    (
        scenes(rubber=MEASURED, velocity=1e-6),
        r"^velocity = 1e-06: .*velocities from 0\.001 to 10 m/s are allowed$",
    ),
    (scenes(rubber=MEASURED, velocity=[1, 11]), "^velocity = 11: .* to 10 m/s are allowed$"),
    (
        [lambda: TABLE.truncated(q0=1), lambda: TABLE.truncated(q0=1e9)],
        r"^q0 = (1|1e\+09): must be in \[1000, 100000\], the spectrum's band \[1/m\]$",
    ),
    ([lambda: TABLE.truncated(q1=1e9)], r"^q1 = 1e\+09: must be in \[1000, 100000\]"),
    # the user gave q0 and a velocity, no angular frequency
    (
        scenes(
            rubber=MEASURED, correction=asperity.GreenwoodWilliamson(**TALL, rms_height=1e-4, q0=1)
        ),
        r"velocity = 0\.01|q0 = 1\b",
    ),
]


def test_asked_outside_measured_data():
    for calls, message in OUTSIDE:
        for at, call in enumerate(calls):
            with case(message=message, at=at), pytest.raises(OutOfRange) as caught:
                call()
            assert not isinstance(caught.value, ValueError)
            assert re.search(message, str(caught.value))


def test_misspelt_missing_and_positional_arguments_are_named_in_a_line():
    calls = {
        "presure": lambda: asperity.friction(SURFACE, RUBBER, presure=1, velocity=1),
        "velocity": lambda: asperity.friction(SURFACE, RUBBER, pressure=np.ones(10_000)),
        "positional": lambda: asperity.Adhesion(8e6),
        "form": lambda: asperity.pressure_distribution(1, SURFACE, RUBBER, **SCENE, form="exact"),
    }
    for name, call in calls.items():
        with pytest.raises(TypeError, match=name) as caught:
            call()
        assert len(str(caught.value)) < 150
        assert "\n" not in str(caught.value)


def test_pressures_over_velocities_need_an_axis_more_and_the_error_says_which():
    line = np.geomspace(1e-3, 1, 40)
    said = (
        r"^shapes pressure \(2,\), velocity \(40,\): must broadcast together; "
        r"pressure\[:, None\] gives every pressure with every velocity$"
    )
    pressure = np.array([1e5, 4e5])
    for function in (asperity.friction, asperity.contact_area, asperity.mean_pressure):
        with pytest.raises(InvalidInput, match=said):
            function(SURFACE, RUBBER, pressure=[1e5, 4e5], velocity=line)
    found = asperity.friction(SURFACE, RUBBER, pressure=pressure[:, None], velocity=line)
    assert found.mu.shape == (2, 40)


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
