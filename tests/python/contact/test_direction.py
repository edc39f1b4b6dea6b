"""Friction by direction: plane sums of the definition, and the limits that are known."""

import numpy as np
import pytest
from scipy.special import erf

import asperity
from asperity import (
    MasterCurve,
    NayakSFactor,
    PartialContact,
    PronySeries,
    SelfAffineSpectrum,
    SFactor,
    TabulatedSpectrum,
)
from helpers import table_rows
from helpers.cases import case
from helpers.ridges import RUBBER, C, Q, ridges, rows
from helpers.rubbers import tread

VISCOUS = PronySeries(equilibrium_modulus=1e6, moduli=[1e6], relaxation_times=[1e-13])


@pytest.mark.parametrize("rtol", [1e-3, 1e-6])
def test_reference(reference_table, rtol):
    rubbers = {}  # harmonics of a curve are made once
    for row in reference_table("direction"):
        with case(case=row["case"], rtol=rtol):
            spectrum = SelfAffineSpectrum(
                **{name: row[name] for name in ("rms_height", "hurst", "q0", "q1", "axis_ratio")},
                lay=np.radians(row["lay_deg"]),
            )
            series = row["table_frequency"].size == 0
            rubber = rubbers.setdefault(
                series, (table_rows.prony if series else table_rows.master_curve)(row)
            )
            for correction, names in (
                (None, ("area", "mu", "lateral")),
                (PartialContact(), ("partial_area", "partial_mu", "partial_lateral")),
            ):
                found = asperity.friction(
                    spectrum,
                    rubber,
                    **{name: row[name] for name in ("pressure", "velocity", "poisson_ratio")},
                    correction=correction,
                    direction=np.radians(row["direction_deg"]),
                    rtol=rtol,
                )
                area, mu, lateral = (row[name] for name in names)
                least = row["rtol"] * mu
                assert abs(found.mu - mu) <= found.error_estimate + least
                assert abs(found.lateral - lateral) <= found.error_estimate + least
                assert found.contact_area == pytest.approx(area, rel=rtol)
                assert found.error_estimate <= rtol * found.mu


@pytest.mark.parametrize("correction", [None, SFactor(), NayakSFactor(), PartialContact()])
def test_no_harmonics_is_the_isotropic_result(correction):
    kwargs = {"pressure": 2e5, "velocity": [1e-4, 1e-1], "correction": correction}
    mean = TabulatedSpectrum(wavenumber=Q, density=C)
    isotropic = asperity.friction(mean, RUBBER, **kwargs, direction=0.7)
    np.testing.assert_array_equal(isotropic.mu, asperity.friction(mean, RUBBER, **kwargs).mu)
    np.testing.assert_array_equal(isotropic.lateral, 0)
    found = asperity.friction(rows(), RUBBER, **kwargs, direction=0.7)
    np.testing.assert_allclose(found.mu, isotropic.mu, rtol=1e-6)
    np.testing.assert_array_equal(found.lateral, 0)


@pytest.mark.parametrize("theta", np.radians([0, 20, 45, 77]))
def test_a_viscous_loss_has_one_harmonic(theta):
    """Im E ~ w in complete contact: 1 + a cos 2 theta along, a sin 2 theta across."""
    a, at = 0.6, {"pressure": 1e9, "velocity": 1e-6}
    mean = asperity.friction(rows(), VISCOUS, **at).mu
    found = asperity.friction(rows(a, 0, 0.2, 0.1), VISCOUS, **at, direction=theta)
    # the angle of C's ellipse is that of its long axis, from which sliding is -theta away
    assert found.mu / mean == pytest.approx(1 + a * np.cos(2 * theta), rel=1e-6)
    assert found.lateral / mean == pytest.approx(-a * np.sin(2 * theta), abs=1e-6)


@pytest.mark.parametrize("theta", np.radians([10, 50]))
def test_a_constant_loss_modulus_has_two_thirds_along_and_four_across(theta):
    w = np.geomspace(1e-8, 1e12, 30)
    flat = MasterCurve(
        angular_frequency=w, storage_modulus=np.full(30, 1e7), loss_modulus=np.full(30, 1e6)
    )
    a, at = 0.3, {"pressure": 1e11, "velocity": 1.0}
    mean = asperity.friction(rows(), flat, **at).mu
    found = asperity.friction(rows(a), flat, **at, direction=theta)
    assert found.mu / mean == pytest.approx(1 + 2 * a / 3 * np.cos(2 * theta), rel=1e-6)
    assert found.lateral / mean == pytest.approx(-4 * a / 3 * np.sin(2 * theta), abs=2e-6)


@pytest.mark.parametrize("rolloff", [None, 6e3])
@pytest.mark.parametrize("heat", [False, True])
def test_faint_ridges_have_the_macro_asperities_of_none(rolloff, heat):
    """Greenwood-Williamson takes the roll-off of a law, or where it begins, with directions too."""
    at = {"pressure": 2e5, "velocity": 1e-2}
    if heat:
        law = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
        at |= {"shift": law, "temperature": 293.15, "heating": tread()}

    def found(ratio):
        law = {"rms_height": 1e-4, "hurst": 0.8, "q0": 1e3, "q1": 2e5, "rolloff": rolloff}
        tops = asperity.GreenwoodWilliamson(z_max=3e-4, z_min=-3e-4)
        spectrum = SelfAffineSpectrum(**law, axis_ratio=ratio)
        return asperity.friction(spectrum, RUBBER, **at, correction=tops)

    faint, none = found(1 + 1e-7), found(1.0)
    assert faint.mu == pytest.approx(none.mu, rel=3e-6)
    assert faint.shift_factor == pytest.approx(none.shift_factor, rel=1e-6)
    assert [note.code for note in faint.notes] == [note.code for note in none.notes]


@pytest.mark.parametrize("correction", [None, PartialContact()])
def test_half_a_turn_changes_nothing_and_a_mirror_turns_the_lateral_force(correction):
    at = {"pressure": 2e5, "velocity": 1e-2, "correction": correction}
    spectrum = SelfAffineSpectrum(
        rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, rolloff=6e3, axis_ratio=2.5, lay=0.4
    )

    def found(direction, lay=0.4):
        turned = SelfAffineSpectrum(
            rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, rolloff=6e3, axis_ratio=2.5, lay=lay
        )
        result = asperity.friction(turned, RUBBER, **at, direction=direction)
        return np.array([result.mu, result.lateral, result.contact_area])

    assert spectrum.is_directional
    np.testing.assert_allclose(found(1.1 + np.pi), found(1.1), rtol=1e-9)
    np.testing.assert_allclose(found(-1.1, lay=-0.4), [1, -1, 1] * found(1.1), rtol=1e-9)
    np.testing.assert_allclose(found(1.6, lay=0.9), found(1.1), rtol=1e-9)
    assert found(0.4)[0] < found(0.4 + np.pi / 2)[0]  # along the ridges, and across


def test_grooves_along_the_sliding_have_no_friction():
    """C on the line q_x = 0: cos 2 m phi = (-1)^m."""
    m = 24
    harmonics = [x for k in range(1, m + 1) for x in ((-1.0) ** k * (1 - k / (m + 1)), 0)]
    grooves = rows(*harmonics)
    at = {"pressure": 2e6, "velocity": 1e-5}
    along = asperity.friction(grooves, RUBBER, **at, rtol=1e-4)
    across = asperity.friction(grooves, RUBBER, **at, direction=np.pi / 2, rtol=1e-4)
    assert along.mu < 0.1 * across.mu
    assert abs(along.lateral) < 1e-10


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_harmonics_that_turn_from_ring_to_ring_do_not_matter(rtol):
    """Waves of all rings shape the spots together: the rule knows their mean."""
    q = 2e3 * np.arange(40, 840)
    density = 1e-14 * (q / 2e3) ** -3.7
    turning = 0.4 * (-1.0) ** np.arange(q.size)[:, None]
    at = {"pressure": 2e5, "velocity": [1e-3, 1e-1, 1e1], "correction": PartialContact()}
    mu, isotropic = (
        asperity.friction(
            TabulatedSpectrum(wavenumber=q, density=density, **kinds), RUBBER, **at, rtol=rtol
        ).mu
        for kinds in ({"cosine": turning, "sine": 0 * turning}, {})
    )
    np.testing.assert_allclose(mu, isotropic, rtol=5e-5)


def by_definition(spectrum, rubber, pressure, velocity, direction):
    """Return mu along and across by sums over the plane.

    C is a power law from row to row, its harmonics are straight in ln q.
    """
    x, weight = np.polynomial.legendre.leggauss(8)
    power = np.polynomial.legendre.legvander(x, 7)
    to_node = np.polynomial.legendre.legint(np.linalg.inv(power), lbnd=-1, axis=0)
    to_node = np.polynomial.legendre.legval(x, to_node).T
    rows = np.log(spectrum.wavenumber)
    front = rows[0] + (rows[1] - rows[0]) * 0.5 ** np.arange(40, 0, -1)  # where G begins
    ends = np.concatenate([rows[:1], front, rows[1:]])
    half = np.diff(ends)[:, None] / 2
    y = ends[:-1, None] + half * (1 + x)
    q = np.exp(y)
    roughness = half * weight * q**4 * np.exp(np.interp(y, rows, np.log(spectrum.density)))
    z = 0.2 * np.arange(220)
    cosine, phi = 1 / np.cosh(z), np.arctan(np.sinh(z))
    circle = 4 * 0.2 * cosine * np.where(z > 0, 1, 0.5)
    modulus = rubber.modulus(velocity * q[..., None] * cosine)
    square, loss = circle * abs(modulus) ** 2, circle * modulus.imag
    i2, along, across = square.sum(-1), loss @ cosine, 0
    for m, (a, b) in enumerate(zip(spectrum.cosine.T, spectrum.sine.T, strict=True), 1):
        a, b = np.interp(y, rows, a), np.interp(y, rows, b)
        even, odd = np.cos(2 * m * phi), np.sin(2 * m * phi)
        ahead = a * np.cos(2 * m * direction) + b * np.sin(2 * m * direction)
        i2 = i2 + 2 * ahead * (square @ even)
        along = along + 2 * ahead * (loss @ (cosine * even))
        behind = b * np.cos(2 * m * direction) - a * np.sin(2 * m * direction)
        across = across + 2 * behind * (loss @ (np.sin(phi) * odd))
    load = pressure * (1 - 0.5**2)
    dg = roughness * i2 / (8 * load**2)
    before = np.cumsum(dg.sum(1)) - dg.sum(1)
    stress = erf(0.5 / np.sqrt(before[:, None] + (dg / weight) @ to_node.T)) / (2 * load)
    return tuple((roughness * stress * part).sum() for part in (along, across))


@pytest.mark.parametrize(("seed", "rtol"), [(768, 1e-6), (183, 1e-6), (1062, 1.5e-6)])
def test_harmonics_that_scatter_from_ring_to_ring(seed, rtol):
    """Where these take three hundred rings together two levels miss them alike."""
    q = 2e4 * np.arange(1, 269)
    cosine, sine = np.random.default_rng(seed).uniform(-0.17, 0.17, (2, q.size, 2))
    spectrum = TabulatedSpectrum(
        wavenumber=q, density=5.623886613e-4 * q**-3.7, cosine=cosine, sine=sine
    )
    rubber = PronySeries(equilibrium_modulus=3e6, moduli=[1e7, 1e8], relaxation_times=[1e-3, 1e-6])
    at = {"pressure": 1e6, "velocity": 0.1, "direction": 1.2}
    found = asperity.friction(spectrum, rubber, **at, rtol=rtol)
    mu, lateral = by_definition(spectrum, rubber, **at)
    assert abs(found.mu - mu) <= found.error_estimate
    assert abs(found.lateral - lateral) <= found.error_estimate


def test_the_area_is_that_of_the_friction():
    at = {"pressure": [[1e5], [2e5]], "velocity": 1e-2, "direction": [0.6, 0, 1.2]}
    at["correction"] = PartialContact()
    spectrum = rows(0.4, 0.1)
    area = asperity.contact_area(spectrum, RUBBER, **at)
    np.testing.assert_array_equal(area, asperity.friction(spectrum, RUBBER, **at).contact_area)
    one = at | {"pressure": 2e5, "direction": 1.2}
    assert asperity.contact_area(spectrum, RUBBER, **one) == area[1, 2]
    by_scale = asperity.contact_area(spectrum, RUBBER, **at, wavenumber=[1e4, 2e5])
    np.testing.assert_allclose(by_scale[..., 1], area, rtol=2e-6)
    stress = np.array([[1e5], [1e6]])
    del at["pressure"], at["correction"]
    parts = asperity.pressure_distribution(stress, spectrum, RUBBER, **at, pressure=1e5)
    alone = asperity.pressure_distribution(
        1e6, spectrum, RUBBER, **one | {"pressure": 1e5, "correction": None}
    )
    assert parts[1, 2] == alone


def test_areas_of_magnifications_and_the_pressure_there():
    q = np.array([3e3, 2e4, 2e5])
    at = {"pressure": 2e5, "velocity": 0.3, "direction": 0.6}
    area = asperity.contact_area(ridges(), RUBBER, **at, wavenumber=q)
    cut = [asperity.contact_area(ridges().truncated(q1=one), RUBBER, **at) for one in q]
    np.testing.assert_allclose(area, cut, rtol=2e-6)
    np.testing.assert_allclose(
        asperity.correction_factor(ridges(), RUBBER, **at, wavenumber=q), area, rtol=2e-6
    )
    np.testing.assert_allclose(
        asperity.mean_pressure(ridges(), RUBBER, **at, wavenumber=q), 2e5 / area, rtol=2e-6
    )
    sigma = np.linspace(0, 4e7, 20001)
    density = asperity.pressure_distribution(sigma, ridges(), RUBBER, **at, wavenumber=2e4)
    assert np.trapezoid(density, sigma) == pytest.approx(area[1], rel=1e-4)
    by_rule = asperity.contact_area(
        ridges(), RUBBER, **at, wavenumber=q, correction=PartialContact()
    )
    assert (np.diff(by_rule) < 0).all()


def test_complete_contact_has_no_edges_to_cross():
    complete = {"pressure": 1e10, "velocity": 1e-2, "rtol": 1e-4}
    plain = asperity.friction(ridges(), RUBBER, **complete).mu
    found = asperity.friction(ridges(), RUBBER, **complete, correction=PartialContact()).mu
    assert found == pytest.approx(plain, rel=1e-3)


@pytest.mark.parametrize("finer", [4, 8])
def test_noise_beyond_the_roughness_hides_no_harmonics(finer):
    n, u = 64, 2 * np.pi / 1e-3
    law = SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=4 * u, q1=28 * u, axis_ratio=4, lay=0.4)
    rough = asperity.synthesize(law, shape=(n, n), pixel_size=1e-3 / n, seed=3).heights
    modes, points = np.fft.fftshift(np.fft.fft2(rough)), n * finer
    padded = np.pad(modes, (points - n) // 2)
    heights = np.fft.ifft2(np.fft.ifftshift(padded)).real * finer**2
    heights += 1e-10 * np.random.default_rng(0).normal(size=heights.shape)
    fine = asperity.HeightMap(heights, pixel_size=1e-3 / points)
    plain = asperity.HeightMap(rough, pixel_size=1e-3 / n)
    how = {"window": "none", "detrend": "offset", "directional": True}
    spectra = [asperity.power_spectrum(one, **how) for one in (plain, fine)]
    coarse_mu, fine_mu = (
        asperity.friction(
            one.truncated(q0=5 * u, q1=27 * u), RUBBER, pressure=2e5, velocity=0.1, direction=0.4
        ).mu
        for one in spectra
    )
    assert fine_mu == pytest.approx(coarse_mu, rel=5e-3)
