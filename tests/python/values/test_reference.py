"""The package against tables computed from the definitions, each row to its own tolerance."""

import numpy as np
import pytest

import asperity
from asperity import AffineShift, PronySeries, SelfAffineSpectrum
from helpers.table_rows import close, master_curve, prony, rubber, self_affine, tabulated


@pytest.mark.reference("prony")
def test_prony_series_has_the_modulus_of_its_definition(row):
    modulus = prony(row).modulus(row["angular_frequency"])
    close(row, ["storage_modulus", "loss_modulus"], [modulus.real, modulus.imag])


@pytest.mark.reference("prony")
def test_prony_series_has_the_angular_integrals_of_their_definition(row):
    close(row, ["i1", "i2"], prony(row).angular_integrals(row["angular_frequency"]))


@pytest.mark.reference("master_curve")
def test_master_curve_is_steffens_interpolant(row):
    modulus = master_curve(row).modulus(row["angular_frequency"])
    close(row, ["storage_modulus", "loss_modulus"], [modulus.real, modulus.imag])


@pytest.mark.reference("master_curve")
def test_master_curve_has_the_angular_integrals_of_their_definition(row):
    close(row, ["i1", "i2"], master_curve(row).angular_integrals(row["angular_frequency"]))


@pytest.mark.reference("master_curve")
def test_master_curve_reports_the_share_that_comes_from_below_the_table(row):
    shares = master_curve(row).extrapolated_shares(row["angular_frequency"])
    close(row, ["i1_tail_share", "i2_tail_share"], shares, scale=1.0)


@pytest.mark.reference("hertz")
def test_hertz_penetration(row):
    names = ("force", "effective_modulus", "radius")
    close(row, ["penetration"], [asperity.hertz_penetration(**{name: row[name] for name in names})])


@pytest.mark.parametrize("reading", ["implicit", "added"])
@pytest.mark.reference("greenwood_williamson")
def test_separations_of_both_readings(row, reading):
    names = ("pressure", "effective_modulus", "rms_height", "q0")
    result = asperity.separation(
        **{name: row[name] for name in names},
        peaks=row["peaks"] if row["peaks"].size else None,
        reading=reading,
    )
    for kind, value in (("effective", result.effective), ("rigid", result.rigid)):
        column = f"{kind}_{reading}"
        close(row, [column], [value], scale=max(row["rms_height"], abs(row[column])))


@pytest.mark.reference("gaussian_moment")
def test_separation_at_the_load_of_its_moment(row):
    h, q0 = 1e-4, 1e3
    stiffness = 2 * q0 * h / (3 * np.pi**2 * np.sqrt(3 * np.sqrt(2)))
    load = stiffness * np.exp(row["log_moment"])
    if load < 1e-300:
        pytest.skip("no double holds such a load")
    result = asperity.separation(pressure=load, effective_modulus=1.0, rms_height=h, q0=q0)
    assert result.effective / h == pytest.approx(row["t"], rel=1e-12, abs=1e-12)


def test_one_peak_above_a_crowd_carries_its_load():
    """Where the crowd is just reached, Newton's steps jump to and fro over it."""
    h, q0, pressure = 265.7e-6, 2000.0, 1e3
    peaks = np.append(0, -1e-3 * (1 + 10 ** (-np.arange(1, 303) / 100)))  # no multiple of four
    stiffness = 2 * q0 / (3 * np.pi**2 * np.sqrt(3 * np.sqrt(2) * h))
    modulus = 10 ** (3 + np.arange(2000) / 300)
    d = asperity.separation(
        pressure=pressure, effective_modulus=modulus, rms_height=h, q0=q0, peaks=peaks
    ).effective
    carried = (np.maximum(0, peaks - d[:, None]) ** 1.5).mean(axis=1)
    np.testing.assert_allclose(modulus * stiffness * carried, pressure, rtol=1e-12)


@pytest.mark.reference("spectrum")
def test_self_affine_spectrum(row):
    spectrum = self_affine(row)
    result = [spectrum.at(row["wavenumber"]), spectrum.rms_slope, spectrum.cutoff_for_slope()]
    close(row, ["density", "rms_slope", "slope_cutoff"], result)


@pytest.mark.reference("tabulated_spectrum")
def test_tabulated_spectrum(row):
    spectrum = tabulated(row)
    result = [spectrum.at(row["wavenumber"]), spectrum.rms_height, spectrum.rms_slope]
    names = ["density", "rms_height", "rms_slope", "slope_cutoff"]
    close(row, names, [*result, spectrum.cutoff_for_slope()])


def test_differences_that_cancel():
    """An interval 1e-12 wide, and peaks 1e-9 of their height above the mean plane."""
    q = 2e3 * np.array([1, 1 + 1e-12])
    slope = np.sqrt(2 * np.pi * 1e-2 * 8e9 * (q[1] - q[0]))
    close_by = asperity.TabulatedSpectrum(wavenumber=q, density=[1e-2, 1e-2])
    assert close_by.rms_slope == pytest.approx(slope, rel=1e-11)
    peaks = [1e-3, -1e-3 + 3e-12, 0.0]
    below = sum(1e-3 - z for z in peaks) / 3
    shift = asperity.LocalPeaks(peaks).shift_factor
    assert shift - 1 == pytest.approx(1e-3 / below - 1, rel=1e-12)


@pytest.mark.reference("autocorrelation")
def test_autocorrelation_of_self_affine_spectra(row):
    result = self_affine(row).autocorrelation(row["distance"])
    close(row, ["autocorrelation"], [result], scale=row["rms_height"] ** 2)


def area_at(g, spectrum, correction, rtol):
    """Of an elastic contact: G = h'^2 / 8 (E* / p)^2."""
    return asperity.contact_area(
        spectrum,
        PronySeries(equilibrium_modulus=1e6, moduli=[], relaxation_times=[]),
        pressure=1e6 * spectrum.rms_slope / np.sqrt(8 * g),
        velocity=1.0,
        poisson_ratio=0,
        correction=correction,
        rtol=rtol,
    )


@pytest.mark.parametrize("rtol", [1e-4, 1e-10])
@pytest.mark.reference("nayak_s_factor")
def test_area_with_s_inside_g_that_knows_the_band(row, rtol):
    q1 = 1e3 * row["q1_over_q0"]
    spectrum = SelfAffineSpectrum(rms_height=1e-4, hurst=row["hurst"], q0=1e3, q1=q1)
    close(row, ["nayak_parameter"], [spectrum.nayak_parameter])
    result = area_at(row["g_uncorrected"], spectrum, asperity.NayakSFactor(), rtol)
    close({**row, "rtol": max(rtol, row["rtol"])}, ["contact_area"], [result])


def test_nayaks_parameter_by_hand():
    table = asperity.TabulatedSpectrum(wavenumber=[1, 2, 3], density=[1, 1, 0])
    m0, m2 = 3 / 2 + 7 / 6, 15 / 4 + 3 * 65 / 4 - 211 / 5
    m4 = 63 / 6 + 3 * 665 / 6 - 2059 / 7
    assert table.nayak_parameter == pytest.approx(1.5 * m0 * m4 / m2**2, rel=1e-14)


@pytest.mark.parametrize("rtol", [1e-4, 1e-12])
@pytest.mark.reference("implicit_s_factor")
def test_area_with_s_of_the_area_that_results(row, rtol):
    spectrum = SelfAffineSpectrum(rms_height=1e-4, hurst=0.7, q0=1e3, q1=1e5)
    correction = asperity.ImplicitSFactor(gamma=row["gamma"])
    result = area_at(row["g_uncorrected"], spectrum, correction, rtol)
    close({**row, "rtol": max(rtol, row["rtol"])}, ["contact_area"], [result])


@pytest.mark.reference("pressure_distribution")
def test_pressure_distribution_at_a_known_g(row):
    # elastic: G = h'^2 E^2 / (8 ((1 - nu^2) sigma0)^2), and h'^2 = h_rms^2 q0 q1 where H = 1/2
    pressure, poisson, q0, q1, rms = 1.0, 0.5, 1024.0, 2048.0, 1e-4
    slope_squared = rms**2 * q0 * q1
    modulus = np.sqrt(8 * row["g"] / slope_squared) * (1 - poisson**2) * pressure
    density = asperity.pressure_distribution(
        row["stress_over_pressure"] * pressure,
        SelfAffineSpectrum(rms_height=rms, hurst=0.5, q0=q0, q1=q1),
        PronySeries(equilibrium_modulus=modulus, moduli=[], relaxation_times=[]),
        pressure=pressure,
        velocity=1.0,
        poisson_ratio=poisson,
        rtol=1e-12,
    )
    close(row, ["density_times_pressure"], [density * pressure])


@pytest.mark.reference("friction_measured")
def test_friction_on_measured_spectra(row):
    """Zeros, jumps, fronts in the middle of the band, moduli beyond their table."""
    parts = tabulated(row), rubber(row)
    at = {name: row[name] for name in ("pressure", "velocity", "poisson_ratio")}
    plain = asperity.friction(*parts, **at)
    close(row, ["hysteresis", "contact_area"], [plain.hysteresis, plain.contact_area])
    assert plain.extrapolated_share == pytest.approx(row["extrapolated_share"] or 0, abs=1e-4)
    correction = asperity.SFactor(gamma=row["gamma"], applies_to="both")
    with_s = asperity.friction(*parts, **at, correction=correction)
    close(row, ["hysteresis_s", "contact_area_s"], [with_s.hysteresis, with_s.contact_area])


def test_a_front_on_a_ramp_from_zero_and_a_narrow_band_keep_their_digits():
    one_term = PronySeries(equilibrium_modulus=1e6, moduli=[1e9], relaxation_times=[1e-6])

    def mu(wavenumber, density):
        road = asperity.TabulatedSpectrum(wavenumber=wavenumber, density=density)
        return asperity.friction(road, one_term, pressure=1e5, velocity=1.0).mu

    # graded panels from the start of the ramp, 9 digits
    assert mu([1e3, 1.3e3], [0, 2.5e-5]) == pytest.approx(4664.89356, rel=2e-9)
    # flat over a relative width of d: G is the same for every d at C ~ 1 / d
    widths = [1e3 * (1 + d) - 1e3 for d in (1e-8, 1e-9, 1e-11, 1e-13)]
    first, *others = (mu([1e3, 1e3 + width], [1e-8 / width] * 2) for width in widths)
    assert others == pytest.approx([first] * 3, rel=1e-7)


class FrictionTable:
    """One promise a test; the scenes differ in the rubber only."""

    @staticmethod
    def rubber(row):
        return prony(row)

    def scene(self, row, *, shifted_by_hand):
        """The arguments of a row, C / p^2 put into the spectrum or left to AffineShift."""
        spectrum, p = self_affine(row), row["shift_factor"]
        conditions = {
            "pressure": row["pressure"],
            "velocity": row["velocity"],
            "poisson_ratio": row["poisson_ratio"],
            "form": row["form"],
        }
        if not shifted_by_hand:
            conditions["correction"] = AffineShift(p)
        if shifted_by_hand:
            spectrum = spectrum.scaled(1 / p**2)
        return (spectrum, self.rubber(row)), conditions

    def test_friction_and_area(self, row):
        parts, conditions = self.scene(row, shifted_by_hand=False)
        result = asperity.friction(*parts, **conditions)
        close(row, ["hysteresis", "contact_area"], [result.hysteresis, result.contact_area])
        assert result.shift_factor == row["shift_factor"]
        assert result.mu == result.hysteresis

    def test_contact_area_alone(self, row):
        parts, conditions = self.scene(row, shifted_by_hand=False)
        close(row, ["contact_area"], [asperity.contact_area(*parts, **conditions)])

    def test_s_factor_on_both(self, row):
        parts, conditions = self.scene(row, shifted_by_hand=True)
        correction = asperity.SFactor(gamma=row["gamma"], applies_to="both")
        result = asperity.friction(*parts, **conditions, correction=correction)
        area = asperity.contact_area(*parts, **conditions, correction=correction)
        names = ["hysteresis_s", "contact_area_s", "contact_area_s"]
        close(row, names, [result.hysteresis, result.contact_area, area])

    @pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
    @pytest.mark.parametrize("corrected", [False, True])
    def test_error_estimate_bounds_the_true_error_and_keeps_the_tolerance(
        self, row, rtol, corrected
    ):
        parts, conditions = self.scene(row, shifted_by_hand=True)
        correction = asperity.SFactor(gamma=row["gamma"]) if corrected else None
        result = asperity.friction(*parts, **conditions, correction=correction, rtol=rtol)
        expected = row["hysteresis_s" if corrected else "hysteresis"]
        rounding = 1e-11 * expected  # of the tables themselves: two methods agree this well
        assert abs(result.mu - expected) <= result.error_estimate + rounding
        assert result.error_estimate <= rtol * expected


@pytest.mark.reference("friction")
class TestFrictionOfPronySeries(FrictionTable):
    pass


@pytest.mark.reference("friction_tabulated")
class TestFrictionOfMasterCurves(FrictionTable):
    @staticmethod
    def rubber(row):
        return master_curve(row)
