"""WLF and Arrhenius fits against tables, and shift factors as a table that can be asked."""

import csv
from pathlib import Path

import numpy as np
import pytest

from asperity import MasterCurveBuild, OutOfRange, PronySeries, ShiftFactors, read_shift_factors
from helpers.refusals import refused
from helpers.rubbers import T_REF, TEMPERATURES, built, sweeps, true_shift, worst

TABLE = Path(__file__).parents[2] / "reference/master_build.csv"
with TABLE.open(encoding="utf-8") as file:
    ROWS = list(csv.DictReader(line for line in file if not line.startswith("#")))


def table(row):
    temperature, shift = (
        [float(x) for x in row[name].split(";")] for name in ("temperature", "log10_a_t")
    )
    reference = float(row["reference_temperature"])
    return ShiftFactors(reference_temperature=reference, temperature=temperature, log10_a_T=shift)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["case"])
def test_wlf_fit_is_the_least_squares_one(row):
    fit, rtol = table(row).fit_wlf(), float(row["rtol"])
    assert fit.c1 == pytest.approx(float(row["c1"]), rel=rtol)
    assert fit.c2 == pytest.approx(float(row["c2"]), rel=rtol)
    assert fit.reference_temperature == float(row["reference_temperature"])
    for name in ("c1", "c2"):
        expected = float(row[f"{name}_error"])
        assert fit.standard_errors[name] == pytest.approx(expected, rel=100 * rtol)
    assert fit.residual == pytest.approx(float(row["wlf_residual"]), rel=100 * rtol)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["case"])
def test_arrhenius_fit_is_the_least_squares_one(row):
    fit, rtol = table(row).fit_arrhenius(), float(row["rtol"])
    assert fit.activation_energy == pytest.approx(float(row["activation_energy"]), rel=rtol)
    result = fit.standard_errors["activation_energy"]
    assert result == pytest.approx(float(row["activation_energy_error"]), rel=100 * rtol)
    assert fit.residual == pytest.approx(float(row["arrhenius_residual"]), rel=100 * rtol)


def test_residuals_tell_the_two_laws_apart():
    named = {row["case"]: table(row) for row in ROWS}
    wlf, thermal = named["WLF rounded to 6 digits"], named["Arrhenius rounded to 6 digits"]
    assert wlf.fit_wlf().residual < 1e-6
    assert wlf.fit_arrhenius().residual > 0.3
    assert thermal.fit_arrhenius().residual < 1e-6


def test_wlf_fit_of_noisy_isotherms_within_its_errors():
    build = built(sweeps(noise=0.01, seed=5))
    fit = build.fit_wlf()
    by_scatter = build.shift_factors.fit_wlf()
    assert (fit.c1, fit.c2, fit.residual) == (by_scatter.c1, by_scatter.c2, by_scatter.residual)
    assert fit.c1 == pytest.approx(8.86, abs=5 * fit.standard_errors["c1"])
    assert fit.c2 == pytest.approx(101.6, abs=5 * fit.standard_errors["c2"])
    assert fit.standard_errors["c1"] < 0.05
    assert fit.residual < 0.02
    assert fit.residual <= worst(build)


def test_a_straight_line_has_a_large_c2_and_says_how_uncertain_it_is():
    t = np.arange(250.0, 350, 10)
    shifts = ShiftFactors(
        reference_temperature=300, temperature=t, log10_a_T=-0.05 * (t - 300) + 1e-3 * np.cos(t)
    )
    fit = shifts.fit_wlf()
    assert fit.residual < 2e-3
    assert fit.c2 > 5e3
    assert fit.c1 / fit.c2 == pytest.approx(0.05, rel=0.01)
    assert fit.standard_errors["c2"] > 0.1 * fit.c2


def test_too_few_temperatures_for_wlf():
    shifts = ShiftFactors(
        reference_temperature=300, temperature=[290, 300, 310], log10_a_T=[1, 0, -1]
    )
    with refused("temperature", "too-few-entries"):
        shifts.fit_wlf()


@pytest.mark.parametrize("outside", [243.1, 348.2, -20.0, 1e3])
def test_a_temperature_outside_of_the_table(outside):
    shifts = built(sweeps()).shift_factors
    with refused("temperature", "unknown-shift", OutOfRange):
        shifts.shift_factor(outside)
    with refused("temperature"):
        shifts.shift_factor(np.nan)


def test_shift_factors_between_the_isotherms():
    build = built(sweeps())
    between = np.linspace(243.15, 348.15, 60)
    result = np.log10(build.shift_factor(between.reshape(6, 10)))
    np.testing.assert_allclose(result.ravel(), true_shift(between), atol=0.02)
    rubber = PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
    cold = rubber.shifted(build.shift_factor(273.15))
    expected = rubber.modulus(10 ** true_shift(273.15) * 50)
    assert cold.modulus(50.0) == pytest.approx(expected, rel=1e-5)


def test_a_table_from_a_file_is_as_good_as_a_fit(tmp_path):
    file = tmp_path / "shift.csv"
    lines = [f"{t!r},{true_shift(t).item()!r}" for t in TEMPERATURES[::-1].tolist()]
    file.write_text("\n".join(["# WLF", "temperature_k,log10_a_t", *lines]))
    shifts = read_shift_factors(file, reference_temperature=T_REF)
    np.testing.assert_array_equal(shifts.temperature, TEMPERATURES)
    np.testing.assert_array_equal(shifts.log10_a_T, true_shift(TEMPERATURES))
    assert shifts.standard_deviation is None
    assert shifts.fit_wlf().c1 == pytest.approx(8.86, rel=1e-6)
    build = built(sweeps(), shift_factors=shifts)
    assert build.residual < 1e-4
    assert build.master_curve.shift_factors == build.shift_factors


FIVE = np.linspace(273.15, 313.15, 5)


def stated_over_scatter(fits):
    """Of c1 and c2 of WLF and of E_a: stated variance over the variance that they have."""
    wlf, arrhenius = zip(*fits, strict=True)
    result = [
        ([getattr(f, n) for f in wlf], [f.standard_errors[n] for f in wlf]) for n in ("c1", "c2")
    ]
    result.append(
        (
            [f.activation_energy for f in arrhenius],
            [f.standard_errors["activation_energy"] for f in arrhenius],
        )
    )
    return np.array([np.sqrt(np.mean(np.square(error))) / np.std(value) for value, error in result])


def test_stated_errors_of_laws_are_their_scatter():
    """Five temperatures, that of the reference among them: four are data."""
    rng = np.random.default_rng(8)

    def fits():
        result = []
        for law in (true_shift(FIVE), 5e3 * (1 / FIVE - 1 / T_REF)):
            scattered = law + 1e-3 * rng.standard_normal(5)
            scattered[2] = 0
            table = ShiftFactors(reference_temperature=T_REF, temperature=FIVE, log10_a_T=scattered)
            result.append(table)
        return result[0].fit_wlf(), result[1].fit_arrhenius()

    ratio = stated_over_scatter([fits() for _ in range(2000)])
    np.testing.assert_allclose(ratio, 1, atol=0.06)  # before: 0.82, 0.82 and 0.87


def test_stated_errors_of_laws_follow_the_covariance_of_a_build():
    """Errors of shift factors add up from step to step; the law takes them as they are."""
    rng = np.random.default_rng(9)
    build = built(sweeps(FIVE, noise=0.003), T_REF)
    parts = {n: getattr(build, n) for n in ("master_curve", "b_T", "points", "residual")}

    def scattered(law):
        shift = law + rng.multivariate_normal(np.zeros(5), build.covariance)
        shift[2] = 0
        table = ShiftFactors(reference_temperature=T_REF, temperature=FIVE, log10_a_T=shift)
        return MasterCurveBuild(**parts, shift_factors=table, covariance=build.covariance)

    def fits():
        wlf, arrhenius = true_shift(FIVE), 5e3 * (1 / FIVE - 1 / T_REF)
        return scattered(wlf).fit_wlf(), scattered(arrhenius).fit_arrhenius()

    ratio = stated_over_scatter([fits() for _ in range(1000)])
    # more scatter than the covariance explains, by chance too, makes an error larger, never smaller
    assert (ratio > 0.95).all()
    assert (ratio < 1.4).all()


def test_a_law_through_as_many_rows_as_it_has_constants_does_not_know_its_errors():
    table = ShiftFactors(reference_temperature=300, temperature=[300, 310], log10_a_T=[0, -1])
    assert table.fit_arrhenius().standard_errors["activation_energy"] == np.inf
