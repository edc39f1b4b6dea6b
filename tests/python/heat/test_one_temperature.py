"""One temperature for all roughness: its equation by brute force, its error, its estimate."""

import math

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from helpers import scenes
from helpers.cases import case, each
from helpers.examples import TREAD
from helpers.heat import CUT, LAW, rubber

ONE = asperity.Heating(**TREAD, model="one-temperature")
STICKY = asperity.Adhesion(shear_stress=8.3e6)


def solved(spectrum=CUT, *, velocity, temperature=293.15, shift=LAW, **more):
    given = {"heating": ONE, "rtol": 1e-9, "pressure": 2e5} | more
    return asperity.friction(
        spectrum, rubber(), velocity=velocity, temperature=temperature, shift=shift, **given
    )


def mean_rise(velocity, temperature, rise, nodes=500):
    """The mean over dmu of theta(q), all roughness at temperature + rise, by Gauss-Legendre."""
    x, weight = np.polynomial.legendre.leggauss(nodes)
    length = math.log(CUT.q1 / CUT.q0)
    q, weight = CUT.q0 * np.exp(length * (x + 1) / 2), length / 2 * weight
    a_t = 10 ** LAW.log10_a_T(temperature + rise)
    i1, i2 = rubber().angular_integrals(velocity * q * a_t)
    q4c = q**4 * CUT.at(q)
    part = weight * q4c * i2 / (8 * 0.75**2 * 2e5**2)
    g = np.cumsum(part) - part / 2
    share = np.array([math.erf(0.5 / math.sqrt(one)) for one in g])
    dmu = weight * q4c * share * i1 / (2 * 0.75 * 2e5)
    macro = np.interp(math.log(2 * math.pi / 1e-3), np.log(q), share)
    kernel = [asperity.heat_kernel(one, q, velocity=velocity, heating=ONE) for one in q]
    theta = 2 * velocity * 2e5 / (1200 * 1650 * macro) * np.array(kernel) @ (q * dmu)
    return float(theta @ dmu / dmu.sum())


def test_the_temperature_keeps_itself_up():
    for velocity, temperature in ((1e-2, 293.15), (1.0, 293.15), (10.0, 273.15)):
        found = solved(velocity=velocity, temperature=temperature)
        rise = found.temperature - temperature
        with case(velocity=velocity):
            assert rise > 0.3
            assert mean_rise(velocity, temperature, rise) == pytest.approx(rise, rel=2e-3)
            assert found.gain < 0
            at_it = asperity.friction(
                CUT,
                rubber(),
                pressure=2e5,
                velocity=velocity,
                temperature=found.temperature,
                shift=LAW,
                rtol=1e-10,
            )
            assert found.mu == pytest.approx(at_it.mu, rel=1e-9)
            assert found.contact_area == pytest.approx(at_it.contact_area, rel=1e-9)


def test_its_error_is_what_the_documentation_says():
    v = np.array([1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0])
    full = solved(velocity=v, heating=asperity.Heating(**TREAD))
    off = solved(velocity=v).mu / full.mu - 1
    assert (np.abs(off[:4]) < 0.015).all()
    np.testing.assert_allclose(off[4:], [0.05, 0.12, 0.21], atol=0.01)


def test_on_the_glassy_side_it_is_off_by_a_factor():
    v = np.array([1e-2, 0.1, 1.0, 10.0])
    at = {"velocity": v, "temperature": 253.15}
    full = solved(**at, heating=asperity.Heating(**TREAD))
    np.testing.assert_allclose(solved(**at).mu / full.mu, [1.71, 2.16, 2.43, 2.61], atol=0.01)


def test_the_estimate_is_kept():
    v = np.geomspace(1e-3, 10, 4)
    for more in ({}, {"adhesion": STICKY}, {"correction": asperity.SFactor(gamma=0.4)}):
        for temperature in (263.15, 293.15):
            given = {"velocity": v, "temperature": temperature} | more
            truth = solved(**given, rtol=1e-11)
            for rtol in (1e-3, 1e-6):
                found = solved(**given, rtol=rtol)
                with case(rtol=rtol, temperature=temperature, more=more):
                    assert (found.error_estimate <= rtol * found.mu).all()
                    assert (np.abs(found.mu - truth.mu) <= found.error_estimate).all()


def test_without_a_shift_in_the_modulus_it_is_the_cold_rubber():
    still = asperity.ArrheniusFit(
        activation_energy=0.0,
        reference_temperature=293.15,
        standard_errors={"activation_energy": 0.0},
        residual=0.0,
    )
    found = solved(velocity=[1e-3, 1.0], shift=still, adhesion=STICKY)
    np.testing.assert_allclose(found.mu, found.cold.mu, rtol=2e-9)
    assert (found.temperature > 293.15).all()


def test_states_of_a_thermal_runaway():
    cold = solved(velocity=10.0, temperature=243.15)
    hot = solved(velocity=10.0, temperature=243.15, branch="hot")
    assert cold.branches == hot.branches == 3
    assert cold.temperature - 243.15 < 0.1
    assert hot.temperature - 243.15 > 30
    assert any("more than one steady state" in note for note in cold.notes)


def test_it_gives_what_the_profile_gives():
    v = np.geomspace(1e-4, 1, 150)
    one, two = (solved(velocity=v, rtol=1e-4, threads=n) for n in (1, 2))
    assert one == two
    found = solved(velocity=[1e-2, 1.0], contributions=True)
    np.testing.assert_allclose(found.decade_share.sum(axis=-1), 1, rtol=1e-9)
    np.testing.assert_array_equal(
        found.temperature_profile,
        np.broadcast_to(found.temperature[:, None], (2, 65))[:, :1]
        + np.zeros_like(found.temperature_profile),
    )
    assert (found.macro_area > 0).all()
    assert found.sliding_length.shape == (2,)


@each("model", ["profile", "one-temperature"])
def test_a_scene_names_the_model(folder, model):
    law = "\nwlf_c1 = 8.86\nwlf_c2_k = 101.6\nreference_temperature_k = 293.15\n"
    names = ("density_kg_m3", "heat_capacity_j_kg_k", "conductivity_w_m_k", "contact_diameter_m")
    heating = "\n".join(f"{k} = {x}" for k, x in zip(names, TREAD.values(), strict=True))
    text = (
        scenes.SURFACE + scenes.RUBBER + law + scenes.CONDITIONS + "\ntemperature_k = 300\n"
        f'\n[heating]\n{heating}\nmodel = "{model}"\n'
    )
    (folder / "one.toml").write_text(text)
    assert main(["friction", "one.toml", "--output", "one.csv"]) == 0
    assert f'heating.model = "{model}"' in (folder / "one.csv").read_text()


def test_a_model_that_there_is_not_is_refused():
    with pytest.raises(
        asperity.InvalidInput, match='model = "two": must be one of "profile", "one'
    ):
        asperity.Heating(**TREAD, model="two")
