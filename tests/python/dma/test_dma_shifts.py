"""Shifts that do not run away, how far they are known, and draws of a build from that."""

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from asperity import InvalidInput, MasterCurveBuild, ShiftFactors, fit_prony
from asperity.dma import draw_master_curve
from helpers.rubbers import T_REF, TEMPERATURES, built, sweeps, true_modulus, true_shift

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
from random_isotherms import (
    FAMILIES,
    build_of,
    draw,
    gapped,
    judge,
    rippled,
    summary,
    two_processes,
)


@pytest.mark.parametrize("lift", [0.5, 0.75])
def test_clean_rippled_moduli_with_little_overlap(lift):
    verdict = judge(rippled(0, lift=lift))
    assert np.abs(verdict.error).max() < 1e-3
    assert (np.abs(verdict.error) < 4 * verdict.deviation).all()


@pytest.mark.parametrize("noise", [0.005, 0.01, 0.02])
def test_noisy_rippled_moduli_with_little_overlap(noise):
    for seed in range(6):
        verdict = judge(rippled(noise, seed))
        assert np.abs(verdict.error).max() < 3 * noise
        assert (np.abs(verdict.error) < 4 * verdict.deviation).all()
        assert not verdict.flagged.any()


@cache
def random_build(family, number):
    """The isotherms of a seed of its own, and their build."""
    made = draw(family, 77, number)
    return made, build_of(made)


@pytest.mark.parametrize("family", FAMILIES)
def test_random_isotherms(family):
    """tests/stability/random_isotherms.py runs 200 sets of each family."""
    verdicts = [judge(*random_build(family, number)) for number in range(24)]
    order, held, words = summary(verdicts)
    assert order >= 23 / 24, words
    assert 0.9 < held < 0.98, words


def test_a_step_across_a_gap_has_an_error_that_holds():
    """Isotherms that do not overlap and meet by noise alone: most are refused."""
    built = 0
    for number in range(120):
        sweeps, k = gapped(1, number)
        try:
            build = build_of(sweeps)
        except InvalidInput:
            continue
        built += 1
        way = np.zeros(sweeps.temperature.size)
        way[[k, k - 1]] = 1, -1
        error = way @ (build.log10_a_T - sweeps.shift)
        assert abs(error) < 3 * np.sqrt(way @ build.covariance @ way), number
        assert build.undetermined.any()
    assert 3 < built < 12


@pytest.mark.parametrize("number", [88, 100])
def test_clean_plateaus_that_the_fit_leaves_apart(number):
    """Steps in a plateau are off by 2 to 5 decades, which their errors hold."""
    verdict = judge(draw("plateaus", 41, number, clean=True))
    assert np.abs(verdict.error).max() > 2
    assert verdict.in_order
    assert (np.abs(verdict.error) < 4 * verdict.deviation).all()


def test_two_processes_that_do_not_superpose_are_noted():
    def noted(build):
        return any(note.code == "isotherms-off-curve" for note in build.notes)

    assert sum(noted(build_of(two_processes(3, number))) for number in range(20)) >= 9
    assert sum(noted(random_build("spectra", number)[1]) for number in range(24)) <= 1


@pytest.mark.parametrize("reference_temperature", [T_REF, 291.0])
def test_the_covariance_is_that_of_the_standard_deviations(reference_temperature):
    build = built(sweeps(noise=0.01), reference_temperature)
    fixed = list(TEMPERATURES).index(T_REF)
    assert build.covariance.shape == (22, 22)
    np.testing.assert_array_equal(build.covariance[fixed], 0)
    np.testing.assert_array_equal(build.covariance[:, fixed], 0)
    np.testing.assert_allclose(build.covariance, build.covariance.T, rtol=1e-9, atol=1e-18)
    np.testing.assert_allclose(np.sqrt(np.diag(build.covariance)), build.standard_deviation)
    assert np.linalg.eigvalsh(build.covariance).min() > -1e-15
    assert not build.undetermined.any()


def test_errors_of_neighbours_are_correlated_as_the_covariance_says():
    """Errors of the steps at either end, over the deviations that the covariance gives them."""
    ratios = []
    for seed in range(40):
        build = built(sweeps(noise=0.01, seed=seed))
        error = build.log10_a_T - true_shift(TEMPERATURES)
        for way in np.diff(np.eye(22), axis=0):
            ratios.append(way @ error / np.sqrt(way @ build.covariance @ way))
    assert np.sqrt(np.mean(np.square(ratios))) == pytest.approx(1, abs=0.15)


def test_given_shift_factors_have_no_covariance():
    known = ShiftFactors(
        reference_temperature=T_REF, temperature=TEMPERATURES, log10_a_T=true_shift(TEMPERATURES)
    )
    build = built(sweeps(noise=0.01), shift_factors=known)
    np.testing.assert_array_equal(build.covariance, 0)
    assert not build.undetermined.any()


def test_a_build_takes_a_covariance_of_its_own_size():
    build = built(sweeps(noise=0.01))
    parts = {
        name: getattr(build, name)
        for name in ("master_curve", "shift_factors", "b_T", "points", "residual")
    }
    again = MasterCurveBuild(**parts, covariance=build.covariance, notes=build.notes)
    assert again == build
    with pytest.raises(InvalidInput, match=r"^covariance = .*: must be finite, of shape"):
        MasterCurveBuild(**parts, covariance=np.eye(2))


def test_draws_have_the_covariance_of_the_build():
    build = built(sweeps(noise=0.03), smooth=True)
    drawn = np.array([draw_master_curve(build, seed).log10_a_T for seed in range(400)])
    moved = build.standard_deviation > 0
    scale = np.outer(build.standard_deviation[moved], build.standard_deviation[moved])
    result = np.cov((drawn - build.log10_a_T)[:, moved].T) / scale
    truth = build.covariance[np.ix_(moved, moved)] / scale
    np.testing.assert_allclose(result, truth, atol=0.3)  # four times 1.4 / sqrt(400)
    np.testing.assert_allclose(drawn[:, ~moved], 0, atol=1e-15)


def test_draws_of_the_modulus_scatter_as_the_spline_does():
    """About the truth, builds of other noise; about a build, its draws."""
    w = np.geomspace(1e-3, 1e8, 12)
    builds = [built(sweeps(noise=0.02, seed=seed), smooth=True) for seed in range(40)]
    result = np.array([np.log(b.master_curve.modulus(w) / true_modulus(w).real) for b in builds])
    truth = np.log(true_modulus(w) / true_modulus(w).real)
    curves = [draw_master_curve(builds[0], seed).master_curve for seed in range(200)]
    drawn = np.array(
        [np.log(c.modulus(w) / builds[0].master_curve.modulus(w).real) for c in curves]
    )
    for part in (np.real, np.imag):
        scatter = np.sqrt(np.mean(part(result - truth) ** 2))
        assert np.sqrt(np.mean(part(drawn - drawn.mean(axis=0)).var(axis=0))) == pytest.approx(
            scatter, rel=0.35
        )


def test_a_draw_is_the_same_for_the_same_seed():
    build = built(sweeps(noise=0.01), smooth=True)
    assert draw_master_curve(build, 3) == draw_master_curve(build, 3)
    assert draw_master_curve(build, 3) != draw_master_curve(build, 4)
    assert fit_prony(draw_master_curve(build, 3)).causal
