"""The master curve at a large strain, against ratios that are formulas."""

import numpy as np
import pytest

from asperity import InvalidInput, OutOfRange, ShiftFactors, StrainSweep
from helpers.refusals import refused
from helpers.rubbers import T_REF, TEMPERATURES, built, curve_of, sweeps, true_modulus, true_shift

SHIFTS = ShiftFactors(
    reference_temperature=T_REF, temperature=TEMPERATURES, log10_a_T=true_shift(TEMPERATURES)
)
OMEGA = 20 * np.pi  # of all strain sweeps
STRAINS = np.geomspace(1e-4, 1.1, 41)  # neither 0.5 % nor 50 % is among them
GRID = np.geomspace(1e-2, 1e8, 101)
REACH = OMEGA * 10 ** true_shift(TEMPERATURES[[-1, 0]])


def linear(w, strain):
    """ln of the ratios of E' and E'': straight in ln w and in ln strain, as Steffen has it."""
    slope = np.log(strain / 0.005)
    return -(0.20 - 0.004 * np.log(w)) * slope, -(0.10 + 0.002 * np.log(w)) * slope


def payne(w, strain):
    """ln of the ratios of E' and E'': networks of filler, less of them at high frequency."""
    share = 0.6 / (1 + (w / 1e4) ** 0.2)
    x = strain / 0.02
    storage = np.log(1 - share * x / (1 + x)) - np.log(1 - share * 0.25 / 1.25)
    return storage, np.log(1 + 0.8 * share * (x / (1 + x**2) - 0.25 / 1.0625))


def strain_sweeps(law, temperatures=TEMPERATURES, strains=STRAINS):
    result = []
    for t in temperatures:
        w = OMEGA * 10 ** true_shift(t)
        modulus, (storage, loss) = true_modulus(w), law(w, strains)
        sweep = StrainSweep(
            temperature=t,
            angular_frequency=OMEGA,
            strain=strains,
            storage_modulus=modulus.real * np.exp(storage),
            loss_modulus=modulus.imag * np.exp(loss),
        )
        result.append(sweep)
    return result


def small_strain(grid=GRID, shifts=SHIFTS):
    modulus = true_modulus(grid)
    return curve_of(grid, modulus, shift_factors=shifts)


@pytest.mark.parametrize("strain", [1e-3, 0.005, 0.02, 0.5, 1.0])
def test_moduli_take_their_own_ratios_at_the_reduced_frequencies(strain):
    with pytest.warns(UserWarning, match="beyond them the ratios of the last ones are held"):
        curve = small_strain().at_strain(strain, strain_sweeps(linear)[::-1])
    w = curve.angular_frequency
    assert set(GRID) <= set(w)
    held = np.clip(w, *REACH)
    storage, loss = linear(held, strain)
    small = small_strain().modulus(w)
    np.testing.assert_allclose(curve.storage_modulus, small.real * np.exp(storage), rtol=1e-9)
    np.testing.assert_allclose(curve.loss_modulus, small.imag * np.exp(loss), rtol=1e-9)


@pytest.mark.filterwarnings("error")
def test_between_sweeps_and_without_a_warning_where_they_reach():
    grid = np.geomspace(*REACH, 120)[1:-1]
    curve = small_strain(grid).at_strain(0.5, strain_sweeps(payne))
    found = curve.modulus(grid)
    truth, (storage, loss) = true_modulus(grid), payne(grid, 0.5)
    np.testing.assert_allclose(found.real, truth.real * np.exp(storage), rtol=2e-3)
    np.testing.assert_allclose(found.imag, truth.imag * np.exp(loss), rtol=2e-3)
    assert np.exp(storage).min() < 0.6  # there was something to see


@pytest.mark.filterwarnings("ignore:strain sweeps reach")
def test_all_the_way_from_noisy_isotherms():
    build = built(sweeps(noise=0.01, seed=4), smooth=True)
    curve = build.master_curve.at_strain(0.5, strain_sweeps(payne))
    w = np.geomspace(*REACH, 200)
    found, truth, (storage, loss) = curve.modulus(w), true_modulus(w), payne(w, 0.5)
    assert np.abs(found.real / truth.real / np.exp(storage) - 1).max() < 0.02
    assert np.abs(found.imag / truth.imag / np.exp(loss) - 1).max() < 0.03
    same = build.master_curve.at_strain(0.5, strain_sweeps(payne), shift_factors=build)
    assert same == curve


def test_the_warning_tells_how_far_the_sweeps_reach():
    with pytest.warns(UserWarning, match="strain sweeps reach") as warned:
        curve = small_strain().at_strain(0.5, strain_sweeps(linear, TEMPERATURES[8:12]))
    reach = OMEGA * 10 ** true_shift(TEMPERATURES[[11, 8]])
    assert f"from {reach[0]:.3g} to {reach[1]:.3g} rad/s" in str(warned[0].message)
    small = small_strain()
    for end, at in ((0, 0), (-1, 1)):  # held: the ratio of the last sweep
        ratio = curve.storage_modulus[end] / small.storage_modulus[end]
        assert ratio == pytest.approx(np.exp(linear(reach[at], 0.5)[0]), rel=1e-9)


@pytest.mark.filterwarnings("ignore:strain sweeps reach")
def test_a_single_sweep_gives_one_ratio_for_all():
    curve = small_strain().at_strain(0.5, strain_sweeps(linear, TEMPERATURES[10:11]))
    ratio = curve.loss_modulus / small_strain().modulus(curve.angular_frequency).imag
    np.testing.assert_allclose(ratio, np.exp(linear(OMEGA, 0.5)[1]), rtol=1e-9)


@pytest.mark.parametrize(
    ("argument", "strain", "given", "error"),
    [
        ("strain", 0.0, {}, InvalidInput),
        ("strain", np.nan, {}, InvalidInput),
        ("strain", 1.2, {}, OutOfRange),  # beyond the sweeps
        ("sweeps", 0.5, {"temperatures": []}, InvalidInput),
        ("temperature", 0.5, {"temperatures": [353.15]}, OutOfRange),
        ("sweeps", 0.5, {"strains": np.array([0.01, 0.1, 1.0])}, OutOfRange),  # without 0.5 %
        ("sweeps", 0.5, {"temperatures": TEMPERATURES[[3, 3]]}, InvalidInput),
    ],
)
def test_strains_that_sweeps_do_not_tell_are_refused(argument, strain, given, error):
    with pytest.raises(error) as caught:
        small_strain().at_strain(strain, strain_sweeps(linear, **given))
    assert caught.value.argument == argument


def test_a_curve_without_shift_factors_has_no_place_for_sweeps():
    with refused("shift_factors", "invalid-input"):
        small_strain(shifts=None).at_strain(0.5, strain_sweeps(linear))
