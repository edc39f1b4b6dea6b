"""Parts of `asperity article`: readings of the printed p_T, Eqs 25 to 27, verdicts, files."""

import itertools

import numpy as np
import pytest

import asperity
from asperity_scripts.article import inputs, readings, statement, surfaces
from asperity_scripts.article.statement import Finding

H_RMS = 76.572e-6


@pytest.mark.parametrize("reading", readings.READINGS)
def test_implied_modulus_is_a_range_that_keeps_the_printed_digits(reading: str) -> None:
    result = readings.implied(reading, H_RMS, inputs.Q0)
    assert result.lowest < result.effective_modulus < result.highest
    assert result.shift_factor.round(2).tolist() == list(readings.PRINTED.values())
    # the search ends 1e-4 from the edge in ln E*
    for inside in (result.lowest, result.highest):
        assert keeps_digits(reading, inside)
    for outside in (result.lowest * 0.99, result.highest * 1.01):
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


def test_printed_variance_is_eqs_25_to_27_term_by_term() -> None:
    heights, n = np.random.default_rng(1).normal(size=(12, 12)), np.arange(12)
    scan = asperity.HeightMap(heights, pixel_size=inputs.PIXEL_SIZE)
    first = np.cos(5 * np.pi * n / 12 - np.pi / 2) ** 2
    last = np.cos(5 * np.pi * n / 12 - 9 * np.pi / 2) ** 2
    bell = np.where(n < 1.2, first, np.where(n <= 10.8, 1.0, last))
    z, length = np.outer(bell, bell) * (heights - heights.mean()), 12 * inputs.PIXEL_SIZE
    variance = 0.0
    for my, mx in itertools.product(n, n):
        phase = np.exp(-2j * np.pi / 12 * (my * n[:, None] + mx * n))
        mode = length**2 / ((2 * np.pi) ** 2 * 12**2) * np.sum(z * phase)
        variance += (2 * np.pi) ** 2 / length**2 * abs(mode) ** 2 * (2 * np.pi / length) ** 2
    wanted = variance / np.var(heights)
    assert surfaces.printed_variance(scan) == pytest.approx(wanted, rel=1e-12)


def test_nothing_that_is_untuned_knows_the_printed_p_t() -> None:
    result = inputs.prepare((1, 2))
    heights = [scan.z_max for scan in result.gaussian_scans]
    for model in result.untuned.values():
        assert model.rubber is result.compound_a
        assert model.correction.z_max == pytest.approx(np.mean(heights), rel=1e-15)
    assert list(result.models) == ["implicit", "added", "untuned, implicit", "untuned, added"]
    assert list(result.compounds) == ["implicit", "added", "untuned"]


@pytest.mark.parametrize(
    ("rule", "tuned", "untuned", "verdict"),
    [
        ("by tests", [True], True, "holds"),
        ("by tests", [True], np.array([True, False]), "holds in part"),
        ("by tests", [False, False], False, "does not hold"),
        ("despite tuning", [True, True], True, "holds"),
        ("despite tuning", [False, False], False, "does not hold"),
        ("despite tuning", [True, False], [True, False], "holds in part"),
        ("despite tuning", [True, True], False, "tuned"),
        ("despite tuning", [False, False], True, "tuned"),
        ("despite tuning", [True, True], [True, False], "tuned"),
        ("by tuning", [True, True], False, "tuned"),
        ("by tuning", [True, False], True, "holds in part"),
        ("by tuning", [False, False], True, "does not hold"),
        ("by construction", [], [], "by construction"),
    ],
)
def test_verdicts_follow_from_tests(
    rule: str, tuned: list[bool], untuned: object, verdict: str
) -> None:
    result = {f"reading {k}": Finding(held) for k, held in enumerate(tuned)}
    assert statement.verdict(rule, {**result, "untuned": Finding(untuned)}) == verdict
