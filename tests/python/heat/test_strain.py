"""Heat of a rubber that strain softens: its reference table and its limits."""

import numpy as np
import pytest

import asperity
from asperity import PartialContact, SFactor, StrainFactors
from helpers import table_rows
from helpers.examples import TREAD
from helpers.heat import CUT, STICKY, hot, rubber

PAYNE = StrainFactors(strain=[0.01, 0.1, 0.5], storage=[0.8, 0.5, 0.3], loss=[1.2, 0.8, 0.4])


@pytest.mark.reference("strain_hot")
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-8])
def test_reference(row, rtol):
    spectrum = table_rows.tabulated if row["rms_height"] is None else table_rows.self_affine
    names = ("strain", "storage", "loss", "strain_per_slope")
    tread = TREAD | {name: row[name] for name in ("heat_capacity", "residence")}
    result = hot(
        spectrum(row),
        rubber=table_rows.prony(row),
        **{name: row[name] for name in ("pressure", "velocity", "temperature")},
        poisson_ratio=row["poisson_ratio"],
        heating=asperity.Heating(**tread),
        correction=PartialContact(),
        strain_factors=StrainFactors(**{name: row[name] for name in names}),
        rtol=rtol,
    )
    assert abs(result.hysteresis - row["hysteresis"]) <= result.error_estimate
    assert result.error_estimate <= rtol * result.mu
    rise = result.temperature - row["temperature"]
    assert rise == pytest.approx(row["rise"], rel=3 * rtol)
    assert result.contact_area == pytest.approx(row["contact_area"], rel=3 * rtol)


W = np.geomspace(1e-5, 1e12, 90)
E = rubber().modulus(W)
CURVE = asperity.MasterCurve(angular_frequency=W, storage_modulus=E.real, loss_modulus=E.imag)
KINDS = [None, SFactor(gamma=0.5), PartialContact()]
AT = {"velocity": [0.01, 1.0], "adhesion": STICKY}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("compound", [None, CURVE])
def test_factors_of_one_change_no_bit(kind, compound):
    ones = StrainFactors(strain=[0.1, 99], storage=[1, 1], loss=[1, 1])
    scene = AT | {"correction": kind, "rubber": compound, "rtol": 1e-5}
    assert np.array_equal(hot(**scene, strain_factors=ones).mu, hot(**scene).mu)


@pytest.mark.parametrize("kind", KINDS)
def test_constant_factors_are_another_rubber(kind):
    f, g = 0.4, 0.7
    scaled = asperity.MasterCurve(
        angular_frequency=W, storage_modulus=f * E.real, loss_modulus=g * E.imag
    )
    constant = StrainFactors(strain=[0], storage=[f], loss=[g])
    scene = AT | {"correction": kind, "rtol": 1e-5}
    result, expected = (
        hot(**scene, rubber=CURVE, strain_factors=constant),
        hot(**scene, rubber=scaled),
    )
    np.testing.assert_allclose(result.mu, expected.mu, rtol=2e-5)
    np.testing.assert_allclose(result.temperature, expected.temperature, rtol=2e-5)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("compound", [None, CURVE])
def test_no_heat_is_the_cold_contact(kind, compound):
    still = asperity.WLF(c1=1e-12, c2=100.0, reference_temperature=293.15)
    result = hot(
        **AT, correction=kind, rubber=compound, shift=still, strain_factors=PAYNE, rtol=1e-6
    )
    np.testing.assert_allclose(result.mu, result.cold.mu, rtol=3e-6)
    assert np.all(
        abs(result.cold.mu / hot(**AT, correction=kind, rubber=compound).cold.mu - 1) > 0.1
    )


def test_sliding_length_and_density_know_the_strain():
    result = hot(CUT, velocity=1.0, strain_factors=PAYNE, contributions=True, rtol=1e-6)
    whole = np.trapezoid(result.dmu_dlnq, np.log(result.wavenumber))
    assert whole == pytest.approx(result.hysteresis, rel=0.01)
    assert result.sliding_length > 0
