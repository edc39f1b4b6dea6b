"""Shift factors and Prony series of a synthetic rubber whose truth is a formula, not our code."""

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, OutOfRange, ShiftFactors
from helpers.refusals import refused
from helpers.rubbers import (
    SWEEP,
    T_REF,
    TEMPERATURES,
    built,
    sweeps,
    true_modulus,
    true_shift,
    worst,
)


@pytest.mark.parametrize("count", [21, 22, 23])
def test_shift_factors_without_noise(count):
    temperatures = np.linspace(-30, 75, count) + 273.15
    assert T_REF in temperatures or count != 22
    build = built(sweeps(temperatures), temperatures[count // 2])
    truth = true_shift(temperatures) - true_shift(temperatures[count // 2])
    assert np.abs(build.log10_a_T - truth).max() < 0.001
    assert build.residual < 1e-4


@pytest.mark.parametrize("seed", range(8))
def test_from_noisy_isotherms_to_a_prony_series(seed):
    build = built(sweeps(noise=0.01, seed=seed))
    assert worst(build) < 0.06
    assert build.residual == pytest.approx(0.01, rel=0.15)
    prony = asperity.fit_prony(build)
    assert prony.causal
    ends = build.master_curve.angular_frequency[[0, -1]]
    w = np.geomspace(*ends, 500)
    result, truth = prony.modulus(w), true_modulus(w)
    assert np.abs(result.real / truth.real - 1).max() < 0.02
    assert np.abs(result.imag / truth.imag - 1).max() < 0.07


def test_standard_deviations_are_the_scatter_of_the_shift_factors():
    misses = []
    for seed in range(12):
        build = built(sweeps(noise=0.01, seed=seed))
        moved = build.standard_deviation > 0
        assert np.count_nonzero(~moved) == 1  # the isotherm at the reference
        truth = true_shift(build.temperature)
        misses.append((build.log10_a_T - truth)[moved] / build.standard_deviation[moved])
    assert 0.7 < np.sqrt(np.mean(np.square(misses))) < 1.4
    assert np.abs(misses).max() < 4.5


def test_the_reference_temperature_is_free():
    isotherms = sweeps(noise=0.01)
    here, there = built(isotherms), built(isotherms, 318.15)
    step = here.log10_a_T - there.log10_a_T
    np.testing.assert_allclose(step, step[0], atol=2e-3)
    assert there.log10_a_T[list(TEMPERATURES).index(318.15)] == pytest.approx(0, abs=1e-12)
    between = built(sweeps(), 291.0)  # 0.6 of the way between two isotherms
    assert between.reference_temperature == 291.0
    assert between.shift_factor(291.0) == pytest.approx(1, rel=1e-9)
    truth = true_shift(TEMPERATURES) - true_shift(291.0)
    np.testing.assert_allclose(between.log10_a_T, truth, atol=0.005)


@pytest.mark.parametrize("outside", [243.0, 348.5])
def test_a_reference_temperature_outside_of_the_isotherms(outside):
    with refused("reference_temperature", "unknown-shift", OutOfRange):
        built(sweeps(), outside)


@pytest.mark.parametrize("part", ["storage", "loss"])
def test_both_moduli_count(part):
    """One of them 0.2 decades off: the shift is what neither says alone, the residual shows it."""
    spoilt = TEMPERATURES[10]

    def apart(t, modulus):
        if t != spoilt:
            return modulus
        other = true_modulus(SWEEP * 10 ** (true_shift(t) + 0.2))
        one, two = (other, modulus) if part == "storage" else (modulus, other)
        return one.real + 1j * two.imag

    build = built(sweeps(change=apart, noise=0.03), TEMPERATURES[12])
    moved = build.log10_a_T[10] - (true_shift(spoilt) - true_shift(TEMPERATURES[12]))
    assert 0.03 < moved < 0.17
    assert build.residual > built(sweeps(noise=0.03)).residual


def test_every_point_knows_its_isotherm():
    build = built(sweeps(noise=0.01))
    points = build.points
    assert (np.diff(points.angular_frequency) >= 0).all()
    for i, isotherm in enumerate(sweeps(noise=0.01)):
        mine = points.isotherm == i
        reduced = isotherm.angular_frequency * 10 ** build.log10_a_T[i]
        np.testing.assert_allclose(points.angular_frequency[mine], reduced, rtol=1e-12)
        np.testing.assert_array_equal(points.storage_modulus[mine], isotherm.storage_modulus)
        np.testing.assert_array_equal(points.loss_modulus[mine], isotherm.loss_modulus)


@pytest.mark.parametrize("smooth", [False, True])
def test_merged_and_smoothed_curve(smooth):
    build = built(sweeps(noise=0.01), smooth=smooth, extrapolation="clamp")
    curve = build.master_curve
    w = curve.angular_frequency
    truth = true_modulus(w)
    allowed = 0.015 if smooth else 0.05  # single points have 1 % each, of 3.5 standard deviations
    assert np.abs(curve.storage_modulus / truth.real - 1).max() < allowed
    assert np.abs(curve.loss_modulus / truth.imag - 1).max() < allowed
    assert curve.extrapolation == "clamp"
    assert curve.shift_factors == build.shift_factors
    decades = np.log10(w[-1] / w[0])
    if smooth:
        assert w.size == pytest.approx(10 * decades, abs=2)
    else:
        assert w.size > 200
    ends = build.points.angular_frequency[[0, -1]]
    np.testing.assert_allclose(w[[0, -1]], ends, rtol=0.05)


def test_vertical_shift_is_an_explicit_choice():
    isotherms = sweeps(b_t=lambda t: t / T_REF)
    plain, ratio = built(isotherms), built(isotherms, vertical_shift="T/T_ref")
    table = built(isotherms, vertical_shift=TEMPERATURES / T_REF)
    np.testing.assert_array_equal(plain.b_T, 1)
    np.testing.assert_allclose(ratio.b_T, TEMPERATURES / T_REF, rtol=1e-12)
    assert worst(ratio) < 0.001
    np.testing.assert_allclose(table.log10_a_T, ratio.log10_a_T, atol=1e-9)
    assert worst(plain) > 0.1
    (note,) = [note for note in plain.notes if note.startswith("vertical shift: none")]
    differ = np.abs(plain.log10_a_T - ratio.log10_a_T).max()
    assert f"b_T = T / T_ref the shift factors would differ by up to {differ:.2g} decades" in note
    assert f"instead of {plain.residual:.2g}" in note
    assert not [note for note in ratio.notes if "vertical shift: none" in note]


def test_a_vertical_shift_that_changes_nothing_is_not_talked_about():
    assert not built(sweeps(TEMPERATURES[:6]), TEMPERATURES[3]).notes


@pytest.mark.parametrize("vertical_shift", ["T", [1.0, 1.0], [0.0] + [1.0] * 21])
def test_bad_vertical_shifts(vertical_shift):
    with pytest.raises(InvalidInput) as caught:
        built(sweeps(), vertical_shift=vertical_shift)
    assert caught.value.argument == "vertical_shift"


def test_shift_factors_from_outside_instead_of_a_fit():
    known = ShiftFactors(
        reference_temperature=T_REF,
        temperature=TEMPERATURES,
        log10_a_T=true_shift(TEMPERATURES),
    )
    build = built(sweeps(noise=0.01), shift_factors=known)
    np.testing.assert_allclose(build.log10_a_T, true_shift(TEMPERATURES), atol=1e-12)
    assert build.residual == pytest.approx(0.01, rel=0.15)
    again = built(sweeps(noise=0.01), 303.15, shift_factors=known)
    step = build.log10_a_T - again.log10_a_T
    np.testing.assert_allclose(step, true_shift(303.15), atol=1e-12)
    with refused("temperature", "unknown-shift", OutOfRange):
        built(sweeps([*TEMPERATURES, 353.15]), shift_factors=known)
