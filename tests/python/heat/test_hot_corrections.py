"""Heat with the corrections for partial contact that have a fixed point of their own."""

import numpy as np
import pytest

import asperity
from helpers import table_rows
from helpers.cases import case
from helpers.examples import TREAD
from helpers.heat import ASPHALT, CUT, STICKY, hot, rubber

PEAKS = np.random.default_rng(0).normal(3e-4, 8e-5, 300)
HEIGHTS = {"z_max": 1.2e-3, "z_min": -1.5e-3}
CORRECTIONS = {
    "partial": asperity.PartialContact(),
    "gw": asperity.GreenwoodWilliamson(**HEIGHTS),
    "gw added": asperity.GreenwoodWilliamson(**HEIGHTS, reading="added"),
    "gw q0 below the band": asperity.GreenwoodWilliamson(**HEIGHTS, q0=500.0),
    "gw q0 in the band": asperity.GreenwoodWilliamson(**HEIGHTS, q0=5000.0),
    "gw peaks": asperity.GreenwoodWilliamson(**HEIGHTS, peaks=PEAKS),
    "peaks then gw": asperity.PeaksThenGreenwoodWilliamson(PEAKS, **HEIGHTS),
    "nayak": asperity.NayakSFactor(),
}
STILL = asperity.ArrheniusFit(
    activation_energy=0.0,
    reference_temperature=293.15,
    standard_errors={"activation_energy": 0.0},
    residual=0.0,
)
SPEEDS = np.array([1e-3, 0.1, 10.0])


@pytest.mark.parametrize("name", list(CORRECTIONS))
def test_without_a_shift_in_the_modulus_heat_changes_nothing(name):
    for spectrum in (CUT, ASPHALT):
        result = hot(
            spectrum,
            velocity=[1e-3, 0.3],
            shift=STILL,
            correction=CORRECTIONS[name],
            adhesion=STICKY,
            rtol=1e-8,
        )
        np.testing.assert_allclose(result.mu, result.cold.mu, rtol=2e-8)
        np.testing.assert_allclose(result.contact_area, result.cold.contact_area, rtol=2e-8)
        np.testing.assert_allclose(result.shift_factor, result.cold.shift_factor, rtol=1e-11)
        assert (result.temperature > 293.2).all()
        np.testing.assert_array_equal(result.gain, 0)


def rings_with_lines(rng):
    """One ring in twenty has up to 1e5 times the density of those beside it."""
    wavenumber = 500.0 * (4 + np.arange(200))
    lines = np.where(rng.random(200) < 0.05, 10 ** rng.uniform(1, 5, 200), 1)
    rings = asperity.TabulatedSpectrum(wavenumber=wavenumber, density=wavenumber**-3.6 * lines)
    return rings.scaled(rings.rms_slope**-2)


@pytest.mark.parametrize("rtol", [1e-7, 1e-9])
@pytest.mark.parametrize("name", ["partial", "nayak"])
def test_an_elastic_rubber_has_the_area_that_it_has_without_heat(name, rtol):
    """It has no friction by which grids could be judged: areas were up to 13e-7 off at 1e-7.

    At 1e-8 they were up to 4e-7 off, or grids never agreed, while panels did not end at all kinks
    of PartialContact's window.
    """
    rng = np.random.default_rng(1)
    elastic = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[], relaxation_times=[])
    for number in range(10):
        rings = rings_with_lines(rng)
        given = {"pressure": 10 ** rng.uniform(2, 6.7, 3), "correction": CORRECTIONS[name]}
        result = hot(rings, velocity=0.01, rubber=elastic, **given, rtol=rtol)
        truth = asperity.contact_area(rings, elastic, velocity=0.01, **given, rtol=rtol / 1000)
        with case(number=number):
            np.testing.assert_array_equal(result.mu, 0)
            np.testing.assert_allclose(result.contact_area, truth, rtol=rtol)


@pytest.mark.parametrize("name", ["partial", "nayak"])
def test_rings_with_strong_lines_are_as_near_as_they_say(name):
    """Lines, steps and empty rings, each a kink of the window a unit of ln q away."""
    rng = np.random.default_rng(6)
    for number in range(8):
        rings = rings_with_lines(rng)
        density = rings.density.copy()
        if number % 4 == 1:
            density[90:95] = 0
        if number % 4 == 2:
            density[120:] *= 1e-4
        given = {
            "spectrum": asperity.TabulatedSpectrum(wavenumber=rings.wavenumber, density=density),
            "pressure": 10 ** rng.uniform(3, 6.7),
            "velocity": 10 ** rng.uniform(-4, 0.5),
            "correction": CORRECTIONS[name],
        }
        truth = hot(**given, rtol=1e-10)
        for rtol in (1e-4, 1e-7, 3e-8, 1e-8):
            with case(number=number, rtol=rtol):
                result = hot(**given, rtol=rtol)
                assert result.error_estimate <= rtol * result.mu
                assert abs(result.mu - truth.mu) <= result.error_estimate + truth.error_estimate
                assert result.contact_area == pytest.approx(truth.contact_area, rel=rtol)


@pytest.mark.parametrize("name", list(CORRECTIONS))
def test_the_profile_is_what_the_heat_of_the_contributions_makes(name):
    """theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu_H(q'), by the trapezoid."""
    for velocity in (0.01, 3.0):
        result = hot(velocity=velocity, correction=CORRECTIONS[name], contributions=True, rtol=1e-6)
        order = np.argsort(result.wavenumber)
        q, density = result.wavenumber[order], result.dmu_dlnq[order]
        heating = asperity.Heating(**TREAD)
        g = asperity.heat_kernel(q[:, None], q[None, :], velocity=velocity, heating=heating)
        unit = 2 * velocity * 2e5 / (1200 * 1650 * result.macro_area)
        rise = unit * np.trapezoid(q * g * density, np.log(q), axis=-1)
        with case(velocity=velocity):
            found_rise = result.temperature_profile[order] - 293.15
            np.testing.assert_allclose(found_rise, rise, rtol=0.01)
            hysteresis = np.trapezoid(density, np.log(q))
            assert hysteresis == pytest.approx(result.hysteresis, rel=0.01)
            np.testing.assert_allclose(result.decade_share.sum(), 1, rtol=1e-12)


@pytest.mark.parametrize("name", list(CORRECTIONS))
def test_the_estimate_is_kept_and_tight_solutions_agree(name):
    for adhesion in (None, STICKY):
        given = {"velocity": SPEEDS, "correction": CORRECTIONS[name], "adhesion": adhesion}
        for spectrum in (CUT, ASPHALT):
            truth = hot(spectrum, **given, rtol=1e-10)
            for rtol in (1e-3, 1e-6):
                result = hot(spectrum, **given, rtol=rtol)
                assert (result.error_estimate <= rtol * result.mu).all()
                off = np.abs(result.mu - truth.mu)
                assert (off <= result.error_estimate + truth.error_estimate).all()


def test_the_separation_follows_the_temperature_of_q0():
    """p_T of Greenwood and Williamson at the modulus that the rubber has at T(q0)."""
    correction = CORRECTIONS["gw"]
    result = hot(velocity=3.0, correction=correction, adhesion=STICKY, contributions=True)
    at_q0 = result.temperature_profile[0]
    assert at_q0 > 296
    as_warm = hot(velocity=3.0, correction=correction, temperature=at_q0).cold
    assert result.shift_factor == pytest.approx(as_warm.shift_factor, rel=1e-9)
    assert result.shift_factor < result.cold.shift_factor * (1 - 1e-3)


def test_no_contact_makes_no_heat():
    aloft = asperity.GreenwoodWilliamson(z_max=1e-5, z_min=-1e-5)
    result = hot(velocity=1.0, pressure=1e3, correction=aloft, adhesion=STICKY)
    assert (result.mu, result.contact_area, result.temperature) == (0, 0, 293.15)
    assert np.isinf(result.shift_factor)


def of_row(row, **more):
    """The scene of a row of hot_partial_contact.csv."""
    spectrum = table_rows.tabulated if row["rms_height"] is None else table_rows.self_affine
    at = {name: row[name] for name in ("pressure", "velocity", "temperature", "poisson_ratio")}
    tread = TREAD | {name: row[name] for name in ("heat_capacity", "residence")}
    given = {"heating": asperity.Heating(**tread), "correction": asperity.PartialContact()}
    return hot(spectrum(row), rubber=table_rows.prony(row), **at, **given | more)


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_partial_contact_is_that_of_its_definition(reference_table, rtol):
    for row in reference_table("hot_partial_contact"):
        with case(case=row["case"], rtol=rtol):
            result = of_row(row, rtol=rtol)
            off = abs(result.hysteresis - row["hysteresis"])
            assert off <= result.error_estimate + row["rtol"] * row["hysteresis"]
            assert result.error_estimate <= rtol * result.mu
            rise = result.temperature - row["temperature"]
            near = pytest.approx
            assert rise == near(row["rise"], rel=3 * rtol + row["rtol"], abs=2e-13)
            assert result.contact_area == near(row["contact_area"], rel=3 * rtol + row["rtol"])
            assert result.macro_area == near(row["macro_area"], rel=3 * rtol + row["rtol"])


def test_partial_contact_heats_beyond_the_end_of_its_roughness(reference_table):
    """The edges begin at q_e, inside of the band or not; all the friction is in the density."""
    inside = 0
    for row in reference_table("hot_partial_contact"):
        with case(case=row["case"]):
            result = of_row(row, contributions=True, rtol=1e-6)
            q, density = result.wavenumber, result.dmu_dlnq
            assert q[-1] == pytest.approx(33 * row["end"], rel=1e-9) or q[-1] > 33 * row["end"]
            assert (density[q > 1.001 * row["end"]][:3] > 0).all()
            assert np.trapezoid(density, np.log(q)) == pytest.approx(result.hysteresis, rel=0.03)
            np.testing.assert_allclose(result.decade_share.sum(), 1, rtol=1e-12)
            at_end = np.interp(np.log(row["end"]), np.log(q), result.temperature_profile)
            assert at_end - row["temperature"] == pytest.approx(row["rise_at_end"], rel=0.01)
            top = row["q1"] if row["q1"] is not None else row["table_wavenumber"][-1]
            inside += row["end"] < top / 2
    assert inside >= 4


def test_partial_contact_that_heat_does_not_change_is_the_cold_one_to_rounding(reference_table):
    for row in reference_table("hot_partial_contact"):
        with case(case=row["case"]):
            result = of_row(row, shift=STILL, rtol=1e-12)
            np.testing.assert_allclose(result.mu, result.cold.mu, rtol=1e-12)
            np.testing.assert_allclose(result.contact_area, result.cold.contact_area, rtol=1e-12)


def measured(noise):
    """The rubber as if it had been measured, up to 1e5 rad/s."""
    w = np.geomspace(1e-2, 1e5, 140)
    scatter = np.random.default_rng(4).normal(scale=noise, size=(2, w.size))
    modulus = rubber().modulus(w)
    return asperity.MasterCurve(
        angular_frequency=w,
        storage_modulus=modulus.real * np.exp(scatter[0]),
        loss_modulus=modulus.imag * np.exp(scatter[1]),
    )


@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_edges_of_contacts_beyond_the_measured_frequencies(noise):
    """There the modulus is held: at its kink panels end, which moves with the temperature."""
    curve = measured(noise)
    road = ASPHALT.truncated(q1=1e5)
    q = np.geomspace(2e3, 1e5, 60)
    scatter = np.random.default_rng(5).normal(scale=0.2, size=q.size)
    rings = asperity.TabulatedSpectrum(wavenumber=q, density=road.at(q) * np.exp(scatter))
    for compound in (asperity.fit_prony(curve), curve):
        given = {
            "rubber": compound,
            "velocity": np.array([0.1, 0.3, 0.95]),
            "correction": asperity.PartialContact(),
        }
        for spectrum in (road, rings):
            result = hot(spectrum, **given, shift=STILL, rtol=1e-6)
            off = np.abs(result.mu - result.cold.mu)
            assert (off <= result.error_estimate + result.cold.error_estimate).all()
            warmed, truth = (hot(spectrum, **given, rtol=rtol) for rtol in (1e-5, 1e-6))
            assert (truth.temperature > 294).all()
            off = np.abs(warmed.mu - truth.mu)
            assert (off <= warmed.error_estimate + truth.error_estimate).all()


def test_a_tolerance_out_of_reach_ends():
    """On the finest grid of a master curve no rule has the nodes that a panel should have."""
    given = {"velocity": 0.1, "correction": asperity.PartialContact(), "rubber": measured(0.1)}
    with pytest.raises(asperity.NotConverged, match=r"velocity = 0\.1, temperature = \d"):
        hot(ASPHALT.truncated(q1=1e5), **given, rtol=1e-12)
