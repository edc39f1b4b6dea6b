"""What the theory promises of friction and of the corrections for partial contact."""

import math

import numpy as np
import pytest

import asperity
from asperity import (
    Adhesion,
    AffineShift,
    GreenwoodWilliamson,
    LocalPeaks,
    NayakSFactor,
    PartialContact,
    PeaksThenGreenwoodWilliamson,
    PronySeries,
    SelfAffineSpectrum,
    SFactor,
)
from helpers.rubbers import curve_of

ROAD = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)  # rms slope below 1.3
MODES = {
    "equilibrium_modulus": 3e6,
    "moduli": np.array([1e9, 3e8, 1e8, 1e7]),
    "relaxation_times": np.array([1e-8, 1e-6, 1e-4, 1e-2]),
}
RUBBER = PronySeries(**MODES)
SCENE = {"pressure": 2e5, "velocity": 0.005}
ADHESION = Adhesion(shear_stress=8.3e6)
PEAKS = [1.1e-4, 2.9e-4, 4.2e-4, 0.3e-4, 2.2e-4]
PROFILE = {"z_max": 9e-4, "z_min": -8e-4}


def master_curve(rubber=RUBBER, low=1e-3, high=1e8, rows=300, extrapolation=None):
    w = np.geomspace(low, high, rows)
    e = rubber.modulus(w)
    return curve_of(w, e, extrapolation=extrapolation)


ALL = [
    None,
    SFactor(applies_to="both"),
    NayakSFactor(),
    PartialContact(),
    AffineShift(2),
    LocalPeaks(PEAKS),
    GreenwoodWilliamson(**PROFILE),
    PeaksThenGreenwoodWilliamson(PEAKS, **PROFILE),
]


def test_total_is_hysteresis_and_adhesion_of_the_real_area():
    velocity = np.geomspace(1e-5, 10, 7)
    result = asperity.friction(ROAD, RUBBER, pressure=2e6, velocity=velocity, adhesion=ADHESION)
    bell = np.exp(-0.1 * np.log10(velocity / 6e-3) ** 2)
    np.testing.assert_allclose(
        result.adhesion, 8.3e6 / 2e6 * result.contact_area * bell, rtol=1e-13
    )
    np.testing.assert_allclose(result.mu, result.hysteresis + result.adhesion, rtol=1e-15)
    area = asperity.contact_area(ROAD, RUBBER, pressure=2e6, velocity=velocity)
    np.testing.assert_allclose(result.contact_area, area, rtol=1e-8)


def test_pressure_and_velocity_broadcast_like_a_ufunc():
    pressure, velocity = np.array([[1e5], [1e6], [4e6]]), np.array([1e-4, 1e-3, 1e-2, 1e-1])
    q = [5e3, 1e4]
    result = asperity.friction(
        ROAD, RUBBER, pressure=pressure, velocity=velocity, adhesion=ADHESION
    )
    area = asperity.contact_area(ROAD, RUBBER, pressure=pressure, velocity=velocity, wavenumber=q)
    assert result.mu.shape == result.pressure.shape == (3, 4)
    assert area.shape == (3, 4, 2)
    for i, j in np.ndindex(3, 4):
        point = {"pressure": pressure[i, 0], "velocity": velocity[j]}
        one = asperity.friction(ROAD, RUBBER, **point, adhesion=ADHESION)
        assert isinstance(one.mu, float)
        assert (one.mu, one.pressure, one.velocity) == (result.mu[i, j], *point.values())
        alone = asperity.contact_area(ROAD, RUBBER, **point, wavenumber=q)
        np.testing.assert_array_equal(alone, area[i, j])
    assert isinstance(asperity.contact_area(ROAD, RUBBER, **SCENE, wavenumber=1e4), float)


@pytest.mark.parametrize("rubber", [RUBBER, master_curve()], ids=["Prony", "master curve"])
@pytest.mark.parametrize("a_t", [30.0, 0.1])
def test_a_temperature_shift_moves_the_velocity(rubber, a_t):
    shifted = asperity.friction(ROAD, rubber.shifted(a_t), pressure=2e6, velocity=0.005)
    moved = asperity.friction(ROAD, rubber, pressure=2e6, velocity=0.005 * a_t)
    assert shifted.hysteresis == pytest.approx(moved.hysteresis, rel=1e-9)
    assert shifted.contact_area == pytest.approx(moved.contact_area, rel=1e-9)
    colder = abs(rubber.shifted(30).modulus(1e3))
    assert colder > abs(rubber.modulus(1e3))  # a_T > 1 is colder, and stiffer


@pytest.mark.parametrize("gamma", [0.0, 0.4, 1.0])
def test_s_factor_changes_only_what_it_is_applied_to(gamma):
    options = {**SCENE, "adhesion": ADHESION}
    plain = asperity.friction(ROAD, RUBBER, **options)
    on = {
        where: asperity.friction(
            ROAD, RUBBER, **options, correction=SFactor(gamma=gamma, applies_to=where)
        )
        for where in ("friction", "area", "both")
    }
    for where in on:
        area = asperity.contact_area(
            ROAD, RUBBER, **SCENE, correction=SFactor(gamma=gamma, applies_to=where)
        )
        assert on[where].contact_area == pytest.approx(area, rel=1e-8)
        assert on[where].shift_factor == 1
    assert on["friction"].contact_area == pytest.approx(plain.contact_area, rel=1e-9)
    assert on["friction"].adhesion == pytest.approx(plain.adhesion, rel=1e-9)
    assert on["area"].hysteresis == plain.hysteresis
    assert on["both"].hysteresis == on["friction"].hysteresis
    assert on["both"].adhesion == pytest.approx(on["area"].adhesion, rel=1e-9)
    ratio = on["area"].contact_area / plain.contact_area
    assert on["area"].adhesion == pytest.approx(ratio * plain.adhesion, rel=1e-13, abs=0)
    if gamma == 1:
        assert ratio == 1
        assert on["both"].mu == plain.mu
    else:
        assert ratio > 1.01  # the true area is larger than Persson's
        assert on["friction"].hysteresis < 0.99 * plain.hysteresis


@pytest.mark.parametrize("where", ["friction", "both"])
def test_s_in_the_integrand_is_that_of_the_uncorrected_area(where):
    correction = SFactor(gamma=0.4, applies_to=where)
    with_s = asperity.friction(ROAD, RUBBER, **SCENE, correction=correction, contributions=True)
    plain = asperity.friction(ROAD, RUBBER, **SCENE, contributions=True)
    q = plain.wavenumber
    p = asperity.contact_area(ROAD, RUBBER, **SCENE, wavenumber=q)
    np.testing.assert_allclose(with_s.dmu_dlnq / plain.dmu_dlnq, 0.4 + 0.6 * p**2, rtol=1e-7)


def test_correction_factors_are_those_of_section_6_1():
    q = np.geomspace(2.1e3, 2e4, 7)
    options = {**SCENE, "wavenumber": q}

    def factor(correction):
        return asperity.correction_factor(ROAD, RUBBER, **options, correction=correction)

    def area(correction):
        return asperity.contact_area(ROAD, RUBBER, **options, correction=correction)

    p = area(None)
    np.testing.assert_allclose(factor(None), p, rtol=1e-12)
    s = (0.4 + 0.6 * p**2) * p
    for where in ("friction", "both"):
        np.testing.assert_allclose(factor(SFactor(gamma=0.4, applies_to=where)), s, rtol=1e-12)
    inside = SFactor(gamma=0.4, applies_to="area")
    np.testing.assert_allclose(factor(inside), area(inside), rtol=1e-12)
    nayak = NayakSFactor(friction_gamma=0.4)
    np.testing.assert_allclose(factor(nayak), s, rtol=1e-12)
    for correction in ALL[4:]:
        p_t = asperity.friction(ROAD, RUBBER, **SCENE, correction=correction).shift_factor
        assert 1 < p_t < math.inf
        np.testing.assert_allclose(factor(correction), area(correction) / p_t**2, rtol=1e-12)
        by_hand = area(AffineShift(p_t))
        np.testing.assert_allclose(area(correction), by_hand, rtol=1e-9)


def test_local_peaks_are_eq_13():
    assert LocalPeaks([1e-4, 2e-4, 3e-4]).shift_factor == pytest.approx(3)
    assert LocalPeaks([1e-4, 2e-4, 3e-4], z_max=4e-4).shift_factor == pytest.approx(2)
    surface = asperity.synthesize(ROAD, shape=(60, 80), pixel_size=2e-4, seed=2)
    heights = surface.local_peaks(min_distance=1e-3)
    result = LocalPeaks(surface, min_distance=1e-3)
    np.testing.assert_array_equal(result.heights, heights)
    expected = surface.z_max / (surface.z_max - heights.mean())
    assert result.shift_factor == pytest.approx(expected, rel=1e-12)
    assert result.z_max == surface.z_max


@pytest.mark.parametrize("reading", ["implicit", "added"])
@pytest.mark.parametrize("peaks", [None, PEAKS])
def test_greenwood_williamson_shift_by_hand(reading, peaks):
    d = asperity.separation(
        pressure=2e5,
        effective_modulus=abs(RUBBER.modulus(1500 * 0.005)) / 0.75,
        rms_height=2e-4,
        q0=1500,
        peaks=peaks,
        reading=reading,
        **PROFILE,
    )
    assert d.state == "partial"
    correction = GreenwoodWilliamson(
        **PROFILE, peaks=peaks, reading=reading, rms_height=2e-4, q0=1500
    )
    result = asperity.friction(ROAD, RUBBER, **SCENE, correction=correction)
    expected = (PROFILE["z_max"] - PROFILE["z_min"]) / (PROFILE["z_max"] - d.effective)
    assert result.shift_factor == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("reading", ["implicit", "added"])
def test_peaks_then_greenwood_williamson_multiplies_the_two_shifts(reading):
    first = LocalPeaks(PEAKS, z_max=PROFILE["z_max"]).shift_factor
    d = asperity.separation(
        pressure=2e5,
        effective_modulus=abs(RUBBER.modulus(2000 * 0.005)) / 0.75,
        rms_height=265.7e-6 / first,
        q0=2000,
        reading=reading,
    ).effective
    top, bottom = PROFILE["z_max"] / first, PROFILE["z_min"] / first
    correction = PeaksThenGreenwoodWilliamson(PEAKS, **PROFILE, reading=reading)
    result = asperity.friction(ROAD, RUBBER, **SCENE, correction=correction)
    assert result.shift_factor == pytest.approx(first * (top - bottom) / (top - d), rel=1e-10)


@pytest.mark.parametrize("correction", [None, SFactor(applies_to="area"), NayakSFactor()])
@pytest.mark.parametrize("q", [2e3, 2.001e3, 3e3, 1.99e4])
def test_roughness_above_the_wavenumber_asked_for_is_not_looked_at(correction, q):
    scene = {**SCENE, "correction": correction, "rtol": 1e-10}
    whole = asperity.contact_area(ROAD, RUBBER, wavenumber=[q, ROAD.q1], **scene)[0]
    alone = asperity.contact_area(ROAD, RUBBER, wavenumber=q, **scene)
    assert alone == pytest.approx(whole, rel=1e-10)
    # rows that no double could hold in q^4 C, above it, do no harm
    rows = np.array([2e3, 2e4, 3e4])
    density = np.array([*ROAD.at(rows[:2]), 1e290])
    scan = asperity.TabulatedSpectrum(wavenumber=rows, density=density)
    result = asperity.contact_area(scan, RUBBER, wavenumber=q, **scene)
    assert result == pytest.approx(alone, rel=1e-9)
    with pytest.raises(asperity.InvalidInput, match="density"):
        asperity.contact_area(scan, RUBBER, **scene)
