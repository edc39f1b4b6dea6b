"""The modulus at the strain of each magnification: its reference table and its limits."""

import numpy as np
import pytest

import asperity
from asperity import PartialContact, SFactor, StrainFactors
from helpers import table_rows
from helpers.rubbers import prony

KINDS = {"": None, "_s": SFactor(gamma=0.5), "_partial": PartialContact()}


def scene(row):
    spectrum = table_rows.tabulated if row["rms_height"] is None else table_rows.self_affine
    rubber = table_rows.prony if row["table_frequency"].size == 0 else table_rows.master_curve
    names = ("strain", "storage", "loss", "strain_per_slope")
    return {
        "spectrum": spectrum(row),
        "rubber": rubber(row),
        "strain_factors": StrainFactors(**{name: row[name] for name in names}),
        **{name: row[name] for name in ("pressure", "velocity", "poisson_ratio")},
    }


@pytest.mark.reference("strain")
@pytest.mark.parametrize("rtol", [1e-4, 1e-7])
@pytest.mark.parametrize("kind", KINDS)
def test_reference(row, kind, rtol):
    result = asperity.friction(**scene(row), correction=KINDS[kind], rtol=rtol)
    off = abs(result.hysteresis - row["hysteresis" + kind])
    assert off <= result.error_estimate + row["rtol"] * result.hysteresis
    assert result.error_estimate <= rtol * result.mu
    area = row["area_partial" if kind == "_partial" else "area"]
    assert result.contact_area == pytest.approx(area, rel=rtol)


ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5)
Q = 2e3 * np.arange(1, 60)
RINGS = asperity.TabulatedSpectrum(
    wavenumber=Q, density=ROAD.at(Q) * (1 + 0.3 * np.sin(7.0 * np.arange(59) ** 1.5))
)
SERIES = prony(3e6, [1e9, 3e8, 1e8, 1e7], [1e-8, 1e-6, 1e-4, 1e-2])
W = np.geomspace(1e-3, 1e9, 60)
E = SERIES.modulus(W)
CURVE = asperity.MasterCurve(angular_frequency=W, storage_modulus=E.real, loss_modulus=E.imag)
PAYNE = StrainFactors(strain=[0.01, 0.1, 0.5], storage=[0.8, 0.5, 0.3], loss=[1.2, 0.8, 0.4])
POINTS = {"pressure": [[1e4], [3e5]], "velocity": [1e-4, 1e-2, 1]}


def constant(f, g):
    return StrainFactors(strain=[0], storage=[f], loss=[g])


@pytest.mark.parametrize("kind", KINDS.values())
@pytest.mark.parametrize("spectrum", [ROAD, RINGS])
@pytest.mark.parametrize("rubber", [SERIES, CURVE])
def test_factors_of_one_change_no_bit(spectrum, rubber, kind):
    ones = StrainFactors(strain=[0.1, 0.5, 90, 99], storage=[1, 1, 1, 9], loss=[1, 1, 1, 0.1])
    plain = asperity.friction(spectrum, rubber, **POINTS, correction=kind)
    result = asperity.friction(spectrum, rubber, **POINTS, correction=kind, strain_factors=ones)
    for name in ("mu", "contact_area", "error_estimate"):
        assert np.array_equal(getattr(result, name), getattr(plain, name))


@pytest.mark.parametrize("kind", KINDS.values())
@pytest.mark.parametrize("spectrum", [ROAD, RINGS])
def test_constant_factors_are_another_rubber(spectrum, kind):
    f, g = 0.4, 0.7
    scaled = asperity.MasterCurve(
        angular_frequency=W, storage_modulus=f * E.real, loss_modulus=g * E.imag
    )
    expected = asperity.friction(spectrum, scaled, **POINTS, correction=kind)
    result = asperity.friction(
        spectrum, CURVE, **POINTS, correction=kind, strain_factors=constant(f, g)
    )
    np.testing.assert_allclose(result.mu, expected.mu, rtol=2e-6)
    np.testing.assert_allclose(result.contact_area, expected.contact_area, rtol=2e-6)


def test_a_soft_rubber_is_a_higher_load():
    # f = g = c: G and the areas are those at the pressure over c
    c = 0.5
    load = asperity.friction(ROAD, SERIES, pressure=1e5 / c, velocity=POINTS["velocity"])
    result = asperity.friction(
        ROAD, SERIES, pressure=1e5, velocity=POINTS["velocity"], strain_factors=constant(c, c)
    )
    np.testing.assert_allclose(result.mu, load.mu, rtol=2e-6)
    np.testing.assert_allclose(result.contact_area, load.contact_area, rtol=2e-6)


@pytest.mark.parametrize("rubber", [SERIES, CURVE])
def test_gsl_agrees(rubber):
    scene = {"pressure": 1e5, "velocity": 1e-2, "strain_factors": PAYNE}
    result = asperity.friction(ROAD, rubber, **scene, rtol=1e-6)
    check = asperity.friction(ROAD, rubber, **scene, rtol=1e-6, method="qag")
    assert result.mu == pytest.approx(check.mu, rel=2e-6)


@pytest.mark.parametrize("kind", KINDS.values())
def test_parts_sum_to_the_whole(kind):
    result = asperity.friction(
        ROAD, SERIES, **POINTS, correction=kind, strain_factors=PAYNE, contributions=True
    )
    np.testing.assert_allclose(result.decade_share.sum(axis=-1), 1, rtol=1e-6)
    whole = np.trapezoid(result.dmu_dlnq, np.log(result.wavenumber), axis=-1)
    np.testing.assert_allclose(whole, result.hysteresis, rtol=5e-3)  # of the trapezoids


def test_exact_contacts_of_a_scan_soften_too():
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2.5e3, q1=1.5e4)
    scan = asperity.synthesize(road, shape=(96, 96), pixel_size=1e-4, seed=3)
    rows = asperity.power_spectrum(scan, window="none", detrend=None).truncated(q0=2.5e3, q1=1.5e4)

    def solved(rubber, factors=None, kind=None):
        exact = kind or asperity.ScanContact(scan, periodic=True, tolerance=0.1)
        point = {"pressure": 2e5, "velocity": 1e-2, "correction": exact}
        return asperity.friction(rows, rubber, **point, strain_factors=factors)

    half = prony(1.5e6, 0.5 * SERIES.moduli, [1e-8, 1e-6, 1e-4, 1e-2])
    both = asperity.ScanContact(scan, periodic=True, tolerance=0.1)
    solved(SERIES, kind=both)
    kept = len(both.contacts)
    assert (both.contacts.to_dataframe()["strain"] == 0).all()
    result, expected, plain = solved(SERIES, constant(0.5, 0.5), both), solved(half), solved(SERIES)
    table = both.contacts.to_dataframe()  # of the same rubber, with and without
    assert table["rubber"].nunique() == 1
    assert (table["strain"] != 0).sum() == len(table) - kept > 0
    assert result.mu == pytest.approx(expected.mu, rel=1e-6)
    assert result.contact_area == pytest.approx(expected.contact_area, rel=1e-6)
    assert solved(SERIES, constant(1, 1)).mu == plain.mu
    # exact contact and the rule soften alike
    soft = solved(SERIES, PAYNE)
    by_rule = solved(SERIES, PAYNE, PartialContact()).contact_area / plain.contact_area
    assert 1.5 < soft.contact_area / plain.contact_area < 4
    assert soft.contact_area / plain.contact_area == pytest.approx(by_rule, rel=0.15)
