"""Parts of `asperity article`: readings of the printed p_T, surrogates, peaks, windows, rows."""

import itertools

import numpy as np
import pytest

import asperity
from asperity.article import compounds, inputs, page, peaks, readings, statement, surfaces

H_RMS = 76.572e-6


@pytest.mark.parametrize("reading", readings.READINGS)
def test_implied_modulus_is_a_range_that_keeps_the_printed_digits(reading: str) -> None:
    found = readings.implied(reading, H_RMS, inputs.Q0)
    assert found.lowest < found.effective_modulus < found.highest
    assert found.shift_factor.round(2).tolist() == list(readings.PRINTED.values())
    # the search ends 1e-4 from the edge in ln E*
    for inside in (found.lowest, found.highest):
        assert keeps_digits(reading, inside)
    for outside in (found.lowest * 0.99, found.highest * 1.01):
        assert not keeps_digits(reading, outside)


def keeps_digits(reading: str, modulus: float) -> bool:
    """Whether any z_max, z_min give the printed p_T within 0.005: every line through the ends."""
    d = asperity.separation(
        pressure=list(readings.PRINTED),
        effective_modulus=modulus,
        rms_height=H_RMS,
        q0=inputs.Q0,
        reading=reading,
    ).effective
    low, middle, high = list(readings.PRINTED.values())
    slack = np.linspace(-0.005, 0.005, 201)
    for first, last in itertools.product(low + slack, high + slack):
        slope = (1 / last - 1 / first) / (d[2] - d[0])
        if abs(1 / (1 / first + slope * (d[1] - d[0])) - middle) <= 0.005 and slope < 0:
            return True
    return False


def test_the_known_solutions_are_among_those_implied() -> None:
    """E* 115.95 and 16.7 MPa, once found by hand."""
    implicit, added = (readings.implied(r, H_RMS, inputs.Q0) for r in readings.READINGS)
    assert implicit.lowest < 115.95e6 < implicit.highest
    assert added.effective_modulus == pytest.approx(16.7e6, rel=2e-3)
    assert added.z_max == pytest.approx(0.266e-3, rel=1e-2)
    assert added.z_min == pytest.approx(-0.499e-3, rel=1e-2)


@pytest.mark.parametrize("t_g", compounds.T_G.values())
def test_compounds_follow_wlf(t_g: float) -> None:
    assert compounds.log10_a_t(t_g, t_g) == 0
    assert compounds.log10_a_t(t_g + 51.6, t_g) == pytest.approx(-17.44 / 2)
    decades = compounds.log10_a_t(0.0, t_g) - compounds.log10_a_t(compounds.ROOM, t_g)
    assert compounds.temperature_of(decades, t_g) == pytest.approx(0, abs=1e-9)
    frequency = np.geomspace(1e-3, 1e9, 25)
    cold = compounds.compound(t_g, 0.0).modulus(frequency)
    moved = compounds.compound(t_g).shifted(10**decades).modulus(frequency)
    np.testing.assert_allclose(cold, moved, rtol=1e-12)


def test_compounds_are_filled_rubber() -> None:
    a, b = (compounds.compound(t_g) for t_g in compounds.T_G.values())
    frequency = np.geomspace(1e-3, 1e12, 400)
    for rubber in (a, b):
        modulus = rubber.modulus(frequency)
        slope = np.diff(np.log(modulus.real)) / np.diff(np.log(frequency))
        assert 5e6 < modulus.real[0] < 10e6
        assert 2e9 < modulus.real[-1] < 3e9
        # Rouse's 1/2 at most: the terms, two a decade, are not seen one by one
        assert slope.min() >= 0
        assert slope.max() < 0.55
    assert np.all(np.abs(b.modulus(frequency)) >= np.abs(a.modulus(frequency)))  # the higher T_g


def test_tuning_gives_the_modulus_that_is_asked_for() -> None:
    wanted = readings.implied("implicit", H_RMS, inputs.Q0)
    tuned = inputs.tune(compounds.compound(-32.0), wanted)
    modulus = inputs.effective_modulus(tuned.rubber)
    assert modulus == pytest.approx(wanted.effective_modulus, rel=1e-9)
    colder = compounds.compound(-32.0, tuned.temperature)
    assert inputs.effective_modulus(colder) == pytest.approx(modulus, rel=1e-9)


def test_peaks_are_where_they_are_drawn() -> None:
    scan = inputs.prepare((1,)).scans[0]
    x, y, found = peaks.located(scan, 1.0)
    above = scan.heights - scan.heights.mean()
    row, column = (np.rint(z / inputs.PIXEL_SIZE).astype(int) for z in (y, x))
    np.testing.assert_allclose(above[row, column], found.heights, rtol=0, atol=1e-12)
    apart = np.hypot(x[:, None] - x, y[:, None] - y)[np.triu_indices(x.size, 1)]
    assert apart.min() >= inputs.LAMBDA0 * (1 - 1e-9)


def test_window_is_eq_25() -> None:
    n, points = np.arange(40), 40
    first = np.cos(5 * np.pi * n / points - np.pi / 2) ** 2
    last = np.cos(5 * np.pi * n / points - 9 * np.pi / 2) ** 2
    wanted = np.where(n < 4, first, np.where(n <= 36, 1.0, last))
    np.testing.assert_allclose(surfaces.split_cosine_bell(points), wanted, atol=1e-15)


def test_window_of_the_package_is_taken_from_spectra() -> None:
    bell = surfaces.packaged_bell(40)
    np.testing.assert_allclose(bell, surfaces.split_cosine_bell(40), rtol=0, atol=1e-12)


def test_printed_variance_is_eqs_25_to_27_term_by_term() -> None:
    heights = np.random.default_rng(1).normal(size=(12, 12))
    scan = asperity.HeightMap(heights, pixel_size=inputs.PIXEL_SIZE)
    z, n = heights - heights.mean(), np.arange(12)
    bell, length = surfaces.split_cosine_bell(12), 12 * inputs.PIXEL_SIZE
    variance = 0.0
    for my, mx in itertools.product(n, n):
        phase = np.exp(-2j * np.pi / 12 * (my * n[:, None] + mx * n))
        mode = length**2 / ((2 * np.pi) ** 2 * 12**2) * np.sum(np.outer(bell, bell) * z * phase)
        variance += (2 * np.pi) ** 2 / length**2 * abs(mode) ** 2 * (2 * np.pi / length) ** 2
    assert surfaces.printed_variance(scan) == pytest.approx(variance / np.mean(z**2), rel=1e-12)


def test_curves_share_a_table() -> None:
    curves = [
        {"curve": "a", "x_m": np.array([1.0, 2.0])},
        {"curve": "b", "height_m": [3.0], "reading": "added"},
    ]
    assert page.stacked(curves) == {
        "curve": ["a", "a", "b"],
        "x_m": [1.0, 2.0, ""],
        "height_m": ["", "", 3.0],
        "reading": ["", "", "added"],
    }


@pytest.mark.parametrize(
    ("held", "verdict"),
    [
        (True, "holds"),
        (False, "does not hold"),
        ([True, True], "holds"),
        ([True, False], "holds in part"),
        (np.array([False, False]), "does not hold"),
        ((x > 1 for x in (1, 2)), "holds in part"),
    ],
)
def test_verdicts_follow_from_tests(held: object, verdict: str) -> None:
    assert statement.judged(held) == verdict


@pytest.mark.parametrize(
    ("tuned", "untuned", "verdict"),
    [
        ([True, True], True, "holds"),
        ([False, False], False, "does not hold"),
        ([True, False], [True, False], "holds in part"),
        ([True, True], False, "tuned"),
        ([False, False], True, "tuned"),
        ([True, False], False, "tuned"),
        ([True, True], [True, False], "tuned"),
    ],
)
def test_where_tuned_and_untuned_differ_it_is_tuned(
    tuned: list[bool], untuned: object, verdict: str
) -> None:
    held = dict(zip(("implicit", "added"), tuned, strict=True)) | {"untuned": untuned}
    assert statement.despite_tuning(held) == verdict


def test_what_is_met_by_tuning_or_by_construction_never_holds() -> None:
    for rule, met in (
        (statement.rests_on_tuning, "tuned"),
        (statement.by_construction, "by construction"),
    ):
        assert rule(True) == met
        assert rule([True, False]) == "holds in part"
        assert rule(False) == "does not hold"


def test_nothing_that_is_untuned_knows_the_printed_p_t() -> None:
    found = inputs.prepare((1, 2))
    heights = [scan.z_max for scan in found.gaussian_scans]
    for model in found.untuned.values():
        assert model.rubber is found.compound_a
        assert model.correction.z_max == pytest.approx(np.mean(heights), rel=1e-15)
    assert list(found.models) == ["implicit", "added", "untuned, implicit", "untuned, added"]
    assert list(found.compounds) == ["implicit", "added", "untuned"]


def test_percentages_keep_their_sign_and_drop_noise() -> None:
    found = [statement.percent(x) for x in (0.123, -0.2, 4e-4, -3e-8)]
    assert found == ["+12 %", "-20 %", "0.0 %", "0.0 %"]
