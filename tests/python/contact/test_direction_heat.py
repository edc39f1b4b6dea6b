"""Friction by direction with strain and heat."""

import numpy as np
import pytest

import asperity
from asperity import (
    MasterCurve,
    PartialContact,
    PronySeries,
    SelfAffineSpectrum,
    SFactor,
    StrainFactors,
    TabulatedSpectrum,
)
from helpers import table_rows
from helpers.cases import case
from helpers.ridges import RUBBER, C, Q, ridges, rows
from helpers.rubbers import curve_of, tread

PAYNE = StrainFactors(strain=[0.01, 0.1, 0.5], storage=[0.8, 0.5, 0.3], loss=[1.2, 0.8, 0.4])
HEAT = {
    "heating": tread(),
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    "temperature": 293.15,
}
EXTRAS = {"plain": {}, "strain": {"strain_factors": PAYNE}, "hot": {**HEAT, "rtol": 1e-5}}
W = np.geomspace(1e-3, 1e12, 90)
CURVE = curve_of(W, RUBBER.modulus(W))
AT = {"pressure": 2e5, "velocity": 0.3, "direction": 0.6}


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_strain_and_heat_by_definition(reference_table, rtol):
    for row in reference_table("direction_hot"):
        with case(case=row["case"], rtol=rtol):
            given = {name: row[name] for name in ("pressure", "velocity", "poisson_ratio")}
            if row["heated"]:
                heating = tread(heat_capacity=row["heat_capacity"])
                given |= {**HEAT, "heating": heating, "temperature": row["temperature"]}
            law = ("rms_height", "hurst", "q0", "q1", "axis_ratio")
            found = asperity.friction(
                SelfAffineSpectrum(
                    **{name: row[name] for name in law}, lay=np.radians(row["lay_deg"])
                ),
                table_rows.prony(row),
                **given,
                strain_factors=StrainFactors(
                    **{k: row[k] for k in ("strain", "storage", "loss", "strain_per_slope")}
                ),
                direction=np.radians(row["direction_deg"]),
                correction=PartialContact(),
                rtol=rtol,
            )
            off = found.error_estimate + row["rtol"] * row["mu"]
            assert abs(found.mu - row["mu"]) <= off
            assert abs(found.lateral - row["lateral"]) <= off
            assert found.contact_area == pytest.approx(row["contact_area"], rel=rtol)
            if row["heated"]:
                rise = found.temperature - row["temperature"]
                assert rise == pytest.approx(row["rise"], rel=10 * rtol)


@pytest.mark.parametrize("correction", [None, SFactor(), PartialContact()])
@pytest.mark.parametrize("extra", EXTRAS.values(), ids=EXTRAS)
@pytest.mark.parametrize("rubber", [RUBBER, CURVE], ids=["series", "curve"])
def test_few_rows_and_many_are_one_law(correction, extra, rubber):
    """Panels end at rows, pieces take them together."""
    law = ridges(axis_ratio=2, lay=0.3)
    q, phi = np.geomspace(2e3, 2e5, 60), 2 * np.pi * np.arange(512) / 512
    means = np.fft.fft(law.toward(q[:1], phi)) / law.toward(q[:1], phi).sum()
    many = TabulatedSpectrum(
        wavenumber=q,
        density=law.at(q),
        cosine=np.tile(means.real[2:66:2], (60, 1)),
        sine=np.tile(-means.imag[2:66:2], (60, 1)),
    )
    one, two = (
        asperity.friction(spectrum, rubber, **AT, correction=correction, **extra)
        for spectrum in (law, many)
    )
    allowed = one.error_estimate + two.error_estimate
    assert abs(one.mu - two.mu) <= allowed
    assert abs(one.lateral - two.lateral) <= allowed
    assert one.contact_area == pytest.approx(two.contact_area, rel=2 * allowed / one.mu)


@pytest.mark.parametrize("correction", [None, PartialContact()])
@pytest.mark.parametrize("extra", EXTRAS.values(), ids=EXTRAS)
def test_no_harmonics_turns_and_mirrors_with_all_that_friction_takes(correction, extra):
    how = {"correction": correction, **extra}

    def found(spectrum, **turned):
        result = asperity.friction(spectrum, RUBBER, **{**AT, **turned}, **how)
        return np.array([result.mu, result.lateral, result.contact_area])

    mean = TabulatedSpectrum(wavenumber=Q, density=C)
    np.testing.assert_allclose(found(rows()), found(mean), rtol=2 * extra.get("rtol", 1e-6))
    along, across = found(ridges(lay=0.2)), found(ridges(lay=-0.2), direction=-0.6)
    np.testing.assert_allclose(across, [1, -1, 1] * along, rtol=1e-7)
    turned = found(ridges(lay=0.5), direction=0.9 + np.pi)
    np.testing.assert_allclose(turned, along, rtol=1e-7)


SOFT = PronySeries(
    equilibrium_modulus=1.5e6,
    moduli=[5e8, 1.5e8, 5e7, 5e6],
    relaxation_times=[1e-8, 1e-6, 1e-4, 1e-2],
)
SOFT_CURVE = MasterCurve(
    angular_frequency=W,
    storage_modulus=0.4 * RUBBER.modulus(W).real,
    loss_modulus=0.7 * RUBBER.modulus(W).imag,
)


@pytest.mark.parametrize(
    ("rubber", "soft", "f", "g"), [(RUBBER, SOFT, 0.5, 0.5), (CURVE, SOFT_CURVE, 0.4, 0.7)]
)
@pytest.mark.parametrize("correction", [None, PartialContact()])
def test_constant_factors_of_strain_are_another_rubber(rubber, soft, f, g, correction):
    how = {**AT, "correction": correction}
    factors = StrainFactors(strain=[0], storage=[f], loss=[g])
    one = asperity.friction(ridges(), rubber, **how, strain_factors=factors)
    two = asperity.friction(ridges(), soft, **how)
    for name in ("mu", "lateral", "contact_area"):
        assert getattr(one, name) == pytest.approx(getattr(two, name), rel=2e-6)


@pytest.mark.parametrize("extra", EXTRAS.values(), ids=EXTRAS)
@pytest.mark.parametrize("correction", [None, PartialContact()])
def test_parts_sum_to_the_whole(correction, extra):
    found = asperity.friction(
        ridges(), RUBBER, **AT, correction=correction, **extra, contributions=True
    )
    assert found.decade_share.sum() == pytest.approx(1, rel=1e-5)
    whole = np.trapezoid(found.dmu_dlnq, np.log(found.wavenumber))
    assert whole == pytest.approx(found.hysteresis, rel=5e-3)  # of the trapezoids
    plain = asperity.friction(ridges(), RUBBER, **AT, correction=correction, **extra)
    assert found.mu == pytest.approx(plain.mu, abs=2 * plain.error_estimate)
    assert found.lateral == pytest.approx(plain.lateral, abs=2 * plain.error_estimate)


def test_a_table_is_heated_after_it_was_cold():
    # what cold results keep with the rows must outlive the copy of the table that made it
    def scan():
        a = 0.2 + 0.1 * np.sin(np.log(Q))
        return TabulatedSpectrum(wavenumber=Q, density=C, cosine=a[:, None], sine=0 * a[:, None])

    used = scan()
    for _ in range(3):
        asperity.friction(used, RUBBER, **AT)
    again = asperity.friction(used, RUBBER, **AT, **HEAT)
    fresh = asperity.friction(scan(), RUBBER, **AT, **HEAT)
    assert (again.mu, again.lateral) == (fresh.mu, fresh.lateral)
