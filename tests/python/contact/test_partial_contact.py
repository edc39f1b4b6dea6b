"""The rule of PartialContact: its reference table, and what it promises."""

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.special import erfinv

import asperity
from asperity import InvalidInput, MasterCurve, PartialContact, PronySeries, SelfAffineSpectrum
from helpers import table_rows
from helpers.cases import case

sys.path.insert(0, str(Path(__file__).parents[2] / "reference"))

RULE = PartialContact()
ROAD = SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5)
MODES = {
    "equilibrium_modulus": 3e6,
    "moduli": np.array([1e9, 3e8, 1e8, 1e7]),
    "relaxation_times": np.array([1e-8, 1e-6, 1e-4, 1e-2]),
}
RUBBER = PronySeries(**MODES)
Q = 2e3 * np.arange(1, 50)
NOISE = 1 + 0.3 * np.sin(7.0 * np.arange(49) ** 1.5)
SCAN = asperity.TabulatedSpectrum(wavenumber=Q, density=ROAD.at(Q) * NOISE)


def parts(row):
    spectrum = table_rows.tabulated if row["rms_height"] is None else table_rows.self_affine
    rubber = table_rows.prony if row["table_frequency"].size == 0 else table_rows.master_curve
    conditions = {name: row[name] for name in ("pressure", "velocity", "poisson_ratio")}
    return spectrum(row), rubber(row), conditions


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_reference(reference_table, rtol):
    for row in reference_table("partial_contact"):
        with case(case=row["case"], rtol=rtol):
            spectrum, rubber, conditions = parts(row)
            result = asperity.friction(
                spectrum, rubber, **conditions, correction=RULE, rtol=rtol, adhesion=None
            )
            off = abs(result.hysteresis - row["hysteresis"])
            assert off <= result.error_estimate + row["rtol"] * row["hysteresis"]
            assert result.error_estimate <= rtol * result.mu
            assert result.contact_area == pytest.approx(row["contact_area"], rel=rtol)
            area = asperity.contact_area(spectrum, rubber, **conditions, correction=RULE, rtol=rtol)
            assert area == result.contact_area


def test_complete_contact_is_that_of_the_theory():
    for spectrum in (ROAD, SCAN):
        exact = asperity.friction(spectrum, RUBBER, pressure=1e11, velocity=[1e-4, 1], rtol=1e-11)
        result = asperity.friction(
            spectrum, RUBBER, pressure=1e11, velocity=[1e-4, 1], correction=RULE, rtol=1e-11
        )
        np.testing.assert_allclose(result.mu, exact.mu, rtol=1e-11)
        assert np.all(result.contact_area == 1)


def test_light_loads_have_an_area_in_proportion_to_them():
    # (1 - A1^(1/10))^3 goes to 1 slowly: the exponent comes to 1 from above
    pressure = 10.0 ** np.arange(-24, 2, 5.0)
    result = asperity.friction(ROAD, RUBBER, pressure=pressure, velocity=0.1, correction=RULE)
    exponent = np.diff(np.log(result.contact_area)) / np.diff(np.log(pressure))
    assert np.all(np.abs(exponent - 1) < 0.01)
    assert exponent[0] == pytest.approx(1, abs=2e-3)


@pytest.mark.parametrize("spectrum", [ROAD, SCAN])
def test_stress_is_at_most_that_of_complete_contact(spectrum):
    q = np.geomspace(spectrum.q0, spectrum.q1, 60)
    scene = {"pressure": [1e3, 1e6, 1e8], "velocity": 0.01, "correction": RULE}
    stress = asperity.correction_factor(spectrum, RUBBER, **scene, wavenumber=q)
    assert np.all((stress > 0) & (stress <= 1))


@pytest.mark.parametrize("spectrum", [ROAD, SCAN])
def test_area_at_a_wavenumber_has_the_kappa_of_the_whole_band(spectrum):
    scene = {"pressure": 2e5, "velocity": 0.01, "rtol": 1e-9}
    q = np.array([spectrum.q0, 5e3, 4e4, spectrum.q1])
    result = asperity.contact_area(spectrum, RUBBER, **scene, correction=RULE, wavenumber=q)
    bare = asperity.contact_area(spectrum, RUBBER, **scene, wavenumber=q)
    assert result[0] == 1
    assert result[-1] == asperity.contact_area(spectrum, RUBBER, **scene, correction=RULE)
    kappa = (erfinv(bare[1:]) / erfinv(result[1:])) ** 2  # A = erf(1 / (2 sqrt(kappa G)))
    np.testing.assert_allclose(kappa, kappa[-1], rtol=1e-7)
    pressure = asperity.mean_pressure(spectrum, RUBBER, **scene, correction=RULE, wavenumber=q)
    np.testing.assert_allclose(pressure, 2e5 / result, rtol=1e-14)


@pytest.mark.parametrize("pressure", [1e4, 1e6])
@pytest.mark.parametrize("slope", [0.3, 1.75, 5.0])
@pytest.mark.parametrize("seed", range(4))
def test_area_never_rises_with_magnification(seed, slope, pressure):
    """Rings scatter as a scan's do; with a kappa of its own for each cut, areas rose."""
    q = np.geomspace(1e3, 1e5, 60)
    density = q**-3.9 * np.random.default_rng(seed).lognormal(0, 0.5, q.size)
    rings = asperity.TabulatedSpectrum(wavenumber=q, density=density)
    scaled = asperity.TabulatedSpectrum(
        wavenumber=q, density=density * (slope / rings.rms_slope) ** 2
    )
    stiffening = PronySeries(equilibrium_modulus=1e6, moduli=[1e7], relaxation_times=[1e-3])
    area = asperity.contact_area(
        scaled, stiffening, pressure=pressure, velocity=1e4, correction=RULE, wavenumber=q
    )
    assert np.all(np.diff(area) <= 0)


def test_pressure_distribution_has_the_area_and_the_load():
    scene = {"pressure": 2e6, "velocity": 0.01, "correction": RULE}
    area = asperity.contact_area(ROAD, RUBBER, **scene)
    stress = np.linspace(0, 40, 400001) * 2e6 / area
    density = asperity.pressure_distribution(stress, ROAD, RUBBER, **scene)
    step = stress[1]
    assert density.sum() * step == pytest.approx(area, rel=1e-6)
    assert (density * stress).sum() * step == pytest.approx(2e6, rel=1e-6)


def end_of_roughness(spectrum):
    """The mean of ln q over the last tenth of the slope variance, as q."""
    y = np.linspace(np.log(spectrum.q0), np.log(spectrum.q1), 200001)
    q = np.exp((y[1:] + y[:-1]) / 2)
    mass = np.cumsum(spectrum.at(q) * q**4)
    return np.exp(np.log(q[mass >= 0.9 * mass[-1]]) @ _weights(mass))


def _weights(mass):
    last = np.diff(mass, prepend=0)[mass >= 0.9 * mass[-1]]
    return last / last.sum()


@pytest.mark.parametrize("spectrum", [ROAD, SCAN])
def test_contributions_add_up_beyond_the_spectrum_too(spectrum):
    result = asperity.friction(
        spectrum,
        RUBBER,
        pressure=2e5,
        velocity=[1e-3, 1.0],
        correction=RULE,
        contributions=True,
    )
    plain = asperity.friction(spectrum, RUBBER, pressure=2e5, velocity=[1e-3, 1.0], correction=RULE)
    np.testing.assert_allclose(result.mu, plain.mu, rtol=2e-6)
    np.testing.assert_allclose(result.decade_share.sum(axis=1), 1, rtol=1e-6)
    y = np.log(result.wavenumber)
    assert result.wavenumber[-1] == pytest.approx(33 * end_of_roughness(spectrum), rel=1e-4)
    assert np.all(np.diff(result.wavenumber) > 0)
    middle = (result.dmu_dlnq[:, 1:] + result.dmu_dlnq[:, :-1]) / 2
    rel = 5e-3 if spectrum is ROAD else 5e-2  # rows between the wavenumbers
    np.testing.assert_allclose((middle * np.diff(y)).sum(axis=1), result.hysteresis, rtol=rel)


def test_order_and_neighbours_do_not_matter():
    rng = np.random.default_rng(3)
    velocity, pressure = 10 ** rng.uniform(-5, 1, 50), 10 ** rng.uniform(2, 8, 50)
    velocity[::3] = velocity[0]
    for spectrum in (ROAD, SCAN):
        scene = {"correction": RULE, "rtol": 1e-5}
        many = asperity.friction(spectrum, RUBBER, pressure=pressure, velocity=velocity, **scene)
        for i in range(0, 50, 7):
            one = asperity.friction(
                spectrum, RUBBER, pressure=pressure[i], velocity=velocity[i], **scene
            )
            assert (one.mu, one.contact_area) == (many.mu[i], many.contact_area[i])


def test_the_modulus_is_held_where_a_table_ends_in_the_tail():
    w = np.geomspace(1e-3, 1e9, 121)
    e = RUBBER.modulus(w)
    tables = [
        MasterCurve(angular_frequency=w[:n], storage_modulus=e.real[:n], loss_modulus=e.imag[:n])
        for n in (121, 101)
    ]
    scene = {"pressure": 1e6, "velocity": w[100] / 2e5 * 0.999, "correction": RULE}
    whole, cut = (asperity.friction(ROAD, table, **scene) for table in tables)
    assert whole.extrapolated_share < 1e-3
    assert 0.01 < cut.extrapolated_share < 0.5
    assert cut.mu == pytest.approx(whole.mu, rel=0.3)
    if cut.extrapolated_share > 0.05:
        assert any("unmeasured" in note.code for note in cut.notes)


def test_model_error_is_known_where_exact_contacts_were_solved():
    scene = {"pressure": 2e5, "velocity": [1e-4, 1e-2, 1.0]}
    light = asperity.friction(ROAD, RUBBER, **scene | {"pressure": 1.0}, correction=RULE)
    assert np.all(np.isnan(light.model_error))
    assert "unknown-model-error" in {note.code for note in light.notes}
    result = asperity.friction(ROAD, RUBBER, **scene, correction=RULE)
    plain = asperity.friction(ROAD, RUBBER, **scene)
    assert np.all((result.model_error > 0.01) & (result.model_error < 0.12))
    assert np.all(plain.model_error > 2 * result.model_error)
    of_area = asperity.contact_notes(ROAD, RUBBER, **scene, correction=RULE)
    assert set(of_area) == set(result.notes)
    for unknown in (asperity.AffineShift(2), asperity.SFactor(gamma=0.3)):
        other = asperity.friction(ROAD, RUBBER, **scene, correction=unknown)
        assert np.all(np.isnan(other.model_error))
    narrow = asperity.friction(ROAD.truncated(q1=4e3), RUBBER, **scene, correction=RULE)
    assert np.all(np.isnan(narrow.model_error))
    nayak = asperity.friction(ROAD, RUBBER, **scene, correction=asperity.NayakSFactor())
    factor = asperity.friction(ROAD, RUBBER, **scene, correction=asperity.SFactor(gamma=0.4))
    np.testing.assert_array_equal(nayak.model_error, factor.model_error)


@pytest.mark.parametrize("function", [asperity.friction, asperity.contact_area])
@pytest.mark.parametrize(("argument", "value"), [("form", "interpolated"), ("method", "qag")])
def test_other_forms_and_methods_know_no_rule(function, argument, value):
    with pytest.raises(InvalidInput) as caught:
        function(ROAD, RUBBER, pressure=1e5, velocity=0.1, correction=RULE, **{argument: value})
    assert caught.value.argument == argument


@pytest.mark.parametrize("share", [1e-12, 1e-8, 1e-4, 1e-2])
def test_what_faint_rows_beyond_the_roughness_add_is_as_small_as_they_are(share):
    rows = np.geomspace(2e3, 2e4, 40)
    beyond = np.geomspace(2e4 * (1 + 1e-9), 1.9e5, 40)
    short = asperity.TabulatedSpectrum(wavenumber=rows, density=ROAD.at(rows))
    level = ROAD.at(beyond) * (short.rms_slope / ROAD.truncated(q1=1.9e5).rms_slope) ** 2
    long = asperity.TabulatedSpectrum(
        wavenumber=np.concatenate([rows, beyond]),
        density=np.concatenate([ROAD.at(rows), share * level]),
    )
    scene = {"pressure": [1e4, 1e6], "velocity": [1e-3, 1e-1], "correction": RULE}
    one, two = (asperity.friction(surface, RUBBER, **scene) for surface in (short, long))
    # a tenth of the slope variance makes the end: their share moves it by ten times 2 units
    most = 20 * ((long.rms_slope / short.rms_slope) ** 2 - 1) + 2e-6
    np.testing.assert_allclose(two.mu, one.mu, rtol=most)
    np.testing.assert_allclose(two.contact_area, one.contact_area, rtol=most)


def test_rows_far_below_the_rounding_of_what_is_before_them():
    """c falls by 23 decades and comes back by 17: such rows were cut until no memory was left."""
    q = np.array([528.9476864548653, 1207.8832142660053, 11314.974351090672])
    density = [2.5504540239931017e-24, 4.846099303839358e-49, 5.11541012428675e-35]
    storage = [1.4, 1.4, 1.7, 1.9, 3.7, 4.8, 6.9, 8.5, 11, 12, 14, 29, 33, 35, 38]
    loss = [1.1, 1.2, 0.54, 0.57, 1.3, 2.2, 6.4, 0.88, 7.3, 4.3, 10, 20, 18, 14, 0.96]
    rubber = MasterCurve(
        angular_frequency=np.geomspace(0.5 * q[0], 2 * q[-1], 15),
        storage_modulus=1e6 * np.array(storage),
        loss_modulus=1e6 * np.array(loss),
    )
    scene = {"pressure": 1e5, "velocity": 1.0, "correction": RULE}
    rows = asperity.TabulatedSpectrum(wavenumber=q, density=density)
    front = asperity.TabulatedSpectrum(wavenumber=q[:2], density=density[:2])
    mu = [asperity.friction(one, rubber, **scene).mu for one in (rows, front)]
    assert mu[0] == pytest.approx(mu[1], rel=1e-3)
