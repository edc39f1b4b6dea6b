"""Where a master curve cannot be had, or not as it seems: what is refused, said or left open."""

import numpy as np
import pytest

from asperity import InvalidInput, Isotherm, fit_prony
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


def notes_with(build, words):
    return [note for note in build.notes if words in note]


def test_a_gap_of_two_decades_is_refused_with_its_two_temperatures():
    below = TEMPERATURES[true_shift(TEMPERATURES) > 2]
    covered = np.log10(SWEEP[-1] / SWEEP[0])
    beyond = TEMPERATURES[true_shift(TEMPERATURES) < true_shift(below[-1]) - covered - 2]
    message = f"isotherms at {below[-1]:g} K and {beyond[0]:g} K: have no storage modulus in common"
    for noise in (0, 0.01):
        with pytest.raises(InvalidInput, match=message):
            built(sweeps([*below, *beyond], noise=noise), below[0])


def test_neighbours_that_overlap_by_less_than_a_third_of_a_decade_are_named():
    """The sweep reaches 0.1 decades beyond the step between two neighbours."""
    cold, hot = TEMPERATURES[[8, 9]]
    reach = true_shift(cold) - true_shift(hot) + 0.1
    short = 2 * np.pi * np.geomspace(1, 10**reach, 12)
    build = built(sweeps(TEMPERATURES[8:12], frequency=short), TEMPERATURES[8])
    (note,) = notes_with(build, f"isotherms at {cold:g} K and {hot:g} K overlap by")
    assert "less than 0.3" in note
    assert "uncertain" in note
    assert not notes_with(built(sweeps(TEMPERATURES[8:12]), TEMPERATURES[8]), "overlap by")


@pytest.mark.parametrize(
    ("per_decade", "noise", "error"),
    [
        (1, 0, 0.001),
        (2, 0, 0.001),
        (3, 0, 0.001),
        (1, 0.01, 0.06),
        (2, 0.01, 0.06),
        (3, 0.01, 0.06),
    ],
)
def test_one_to_three_points_a_decade(per_decade, noise, error):
    few = 2 * np.pi * np.geomspace(0.01, 100, 4 * per_decade + 1)
    build = built(sweeps(frequency=few, noise=noise))
    assert worst(build) < error


@pytest.mark.parametrize(
    ("noise", "shift", "storage", "loss"), [(0.03, 0.1, 0.04, 0.1), (0.1, 0.3, 0.12, 0.25)]
)
def test_three_and_ten_percent_noise(noise, shift, storage, loss):
    for seed in range(3):
        build = built(sweeps(noise=noise, seed=seed))
        assert worst(build) < shift
        moved = build.standard_deviation > 0
        truth = true_shift(build.temperature)
        in_deviations = (build.log10_a_T - truth)[moved] / build.standard_deviation[moved]
        assert np.abs(in_deviations).max() < 4
        assert build.residual == pytest.approx(noise, rel=0.15)
        prony = fit_prony(build)
        assert prony.causal
        w = np.geomspace(*build.master_curve.angular_frequency[[0, -1]], 300)
        result, right = prony.modulus(w), true_modulus(w)
        assert np.abs(result.real / right.real - 1).max() < storage
        assert np.abs(result.imag / right.imag - 1).max() < loss


def acausal(isotherms):
    """The build, its fit and the one warning; shifting itself does not see the fault."""
    build = built(isotherms)
    assert worst(build) < 0.06
    with pytest.warns(UserWarning, match="Kramers-Kronig") as warned:
        prony = fit_prony(build)
    assert len(warned) == 1
    assert prony.notes == build.notes == build.master_curve.notes
    assert prony.notes[-1] == str(warned[0].message)
    assert not prony.causal
    return prony


@pytest.mark.parametrize("noise", [0, 0.01])
def test_swapped_columns(noise):
    prony = acausal(sweeps(change=lambda _, e: e.imag + 1j * e.real, noise=noise))
    assert "columns swapped" in prony.notes[-1]


@pytest.mark.parametrize("factor", [2 * np.pi, 1 / (2 * np.pi), 10, 0.1])
def test_moduli_on_different_frequency_axes(factor):
    """Hz for one of them and rad/s for the other, and a decade."""

    def apart(t, modulus):
        return modulus.real + 1j * true_modulus(factor * SWEEP * 10 ** true_shift(t)).imag

    for noise in (0, 0.01):
        prony = acausal(sweeps(change=apart, noise=noise))
        assert "different frequency axes" in prony.notes[-1]
        assert max(prony.storage_residual, prony.loss_residual) > 0.1


def plateau(seed, noise=0.01):
    """Five isotherms between which there is nothing to see but noise."""
    rng = np.random.default_rng(seed)
    return [
        Isotherm(
            temperature=t,
            angular_frequency=SWEEP,
            storage_modulus=1e6 * np.exp(noise * rng.standard_normal(16)),
            loss_modulus=1e5 * np.exp(noise * rng.standard_normal(16)),
        )
        for t in TEMPERATURES[10:15]
    ]


@pytest.mark.parametrize("seed", range(10))
def test_a_plateau_without_slope_leaves_the_shift_undetermined(seed):
    build = built(plateau(seed), TEMPERATURES[12])
    moved = np.arange(5) != 2
    assert build.standard_deviation[moved].min() > 0.3
    for t in TEMPERATURES[10:15][moved]:
        (note,) = notes_with(build, f"fatal: the shift at {t:g} K is undetermined")
        assert "too flat" in note
        assert "standard deviation" in note


def test_isotherms_out_of_order_are_put_in_order():
    isotherms = sweeps(noise=0.01)
    shuffled = [isotherms[i] for i in np.random.default_rng(3).permutation(len(isotherms))]
    ordered, other = built(isotherms), built(shuffled)
    np.testing.assert_array_equal(other.temperature, TEMPERATURES)
    np.testing.assert_array_equal(other.log10_a_T, ordered.log10_a_T)
    assert other.master_curve == ordered.master_curve


@pytest.mark.parametrize("temperatures", [[], [T_REF], [T_REF, T_REF + 0.1]])
def test_one_isotherm_cannot_be_shifted(temperatures):
    with refused("isotherms", "invalid-input"):
        built(sweeps(temperatures))


@pytest.mark.parametrize("part", ["storage", "loss"])
def test_outliers_are_named(part):
    spoilt, row = TEMPERATURES[10], 5

    def spoil(t, modulus):
        modulus = modulus.copy()
        if t == spoilt:
            modulus[row] += (0.3 if part == "storage" else 0.3j) * getattr(
                modulus[row], "real" if part == "storage" else "imag"
            )
        return modulus

    build = built(sweeps(change=spoil, noise=0.01))
    (note,) = notes_with(build, "off the master curve")
    assert note.startswith(f"isotherm at {spoilt:g} K: row {row} at {SWEEP[row]:.4g} rad/s lies")
    assert worst(build) < 0.06
    assert not notes_with(built(sweeps(noise=0.01)), "off the master curve")


def test_isotherms_that_do_not_superpose_say_so():
    """E' and E'' of every isotherm off by up to 15 %, in opposite directions."""
    factors = dict(zip(TEMPERATURES, np.random.default_rng(1).uniform(0.87, 1.15, 22), strict=True))
    build = built(sweeps(change=lambda t, e: e.real * factors[t] + 1j * e.imag / factors[t]))
    assert build.residual > 0.03
    assert notes_with(build, "these isotherms do not superpose")


@pytest.mark.parametrize("slope", [0.002, 0.0])
def test_a_flat_storage_modulus_leaves_the_loss_modulus_to_shift_by(slope):
    """A rubbery plateau: E' rises by 0.2 % a decade, E'' by half a decade."""

    def rubbery(t, _):
        reduced = SWEEP * 10 ** true_shift(t)
        return 1e6 * reduced**slope + 5e4j * reduced**0.3

    build = built(sweeps(TEMPERATURES[10:15], change=rubbery), TEMPERATURES[10])
    assert worst(build) < 0.001
