"""Bands at temperatures, and of friction that heats its rubber."""

import numpy as np

import asperity
from helpers.cases import case
from helpers.rubbers import prony, tread

ROAD = asperity.SelfAffineSpectrum(rms_height=2e-4, hurst=0.8, q0=2e3, q1=2e4)
RUBBER = prony(3e6, np.geomspace(2e8, 2e6, 9), np.geomspace(1e-8, 1e0, 9))
LAW = asperity.WLF(c1=8.0, c2=110.0, reference_temperature=293.0)
HEATING = tread()
AT = {"pressure": 2e5, "velocity": [1e-3, 0.1, 3.0]}


def measured_road(seed, rows=25, factor=1.0):
    """The road's densities as a scan's rings would scatter about them."""
    q = np.geomspace(ROAD.q0, ROAD.q1, rows)
    count = np.round(40 * (q / q[0]) ** 1.5)
    relative = factor * np.sqrt(2 / count)
    density = ROAD.at(q) * np.exp(relative * np.random.default_rng(seed).normal(size=rows))
    return asperity.TabulatedSpectrum(
        wavenumber=q, density=density, count=count, standard_error=density * relative
    )


def measured_rubber(seed, noise=0.01):
    """Sweeps of the rubber, a_T after WLF, every modulus off by 1 %."""
    rng = np.random.default_rng(seed)
    w = np.geomspace(0.1, 100, 13)
    sweeps = []
    for t in np.arange(253.0, 354.0, 10.0):
        modulus = RUBBER.modulus(w * 10 ** LAW.log10_a_T(t))
        off = 1 + noise * rng.normal(size=(2, w.size))
        sweeps.append(
            asperity.Isotherm(
                temperature=t,
                angular_frequency=w,
                storage_modulus=modulus.real * off[0],
                loss_modulus=modulus.imag * off[1],
            )
        )
    return asperity.build_master_curve(sweeps, reference_temperature=293.0)


def inside(band, truth):
    return (band.lower <= truth).all() and (truth <= band.upper).all()


def test_the_truth_of_heated_friction_lies_in_its_band():
    at = AT | {"temperature": 288.0, "heating": HEATING}
    truth = asperity.friction(ROAD, RUBBER, shift=LAW, **at)
    assert (truth.mu[1:] < 0.99 * truth.cold.mu[1:]).all()  # the heat matters
    held = 0
    for seed in range(4):
        band = asperity.friction_band(
            measured_road(seed), RUBBER, shift=LAW, samples=40, level=0.99, **at
        )
        width = (band.upper - band.lower) / truth.mu
        with case(seed=seed):
            assert ((width > 0.01) & (width < 1)).all()
        held += inside(band, truth.mu)
    assert held >= 3


def test_a_build_is_drawn_with_its_shift():
    at = {"pressure": 2e5, "velocity": [1e-5, 1e-3], "temperature": 283.0}
    build = measured_rubber(1)
    truth = asperity.friction(ROAD, RUBBER, shift=LAW, **at).mu
    drawn, held = (
        asperity.friction_band(ROAD, build, samples=60, level=0.99, shift=shift, **at)
        for shift in (None, LAW)
    )
    assert inside(drawn, truth)
    # at another temperature than the reference the errors of a_T come to those of the curve
    assert (drawn.upper - drawn.lower != held.upper - held.lower).any()
    hot = asperity.friction_band(ROAD, build, samples=20, heating=HEATING, **at)
    true_hot = asperity.friction(ROAD, RUBBER, shift=LAW, heating=HEATING, **at).mu
    assert (np.abs(hot.lower / true_hot - 1) < 0.2).all()


def test_heat_that_changes_no_modulus_changes_no_band():
    still = asperity.ArrheniusFit(
        activation_energy=0.0,
        reference_temperature=293.0,
        standard_errors={"activation_energy": 0.0},
        residual=0.0,
    )
    given = AT | {"samples": 20, "temperature": 293.0, "shift": still}
    cold = asperity.friction_band(measured_road(1), RUBBER, **given)
    hot = asperity.friction_band(measured_road(1), RUBBER, heating=HEATING, **given)
    np.testing.assert_allclose(hot.lower, cold.lower, rtol=3e-4)
    np.testing.assert_allclose(hot.upper, cold.upper, rtol=3e-4)


def test_temperatures_broadcast_and_threads_change_nothing():
    t = np.array([[283.0], [303.0]])
    given = AT | {"samples": 20, "temperature": t, "shift": LAW, "heating": HEATING}
    one, two = (
        asperity.friction_band(measured_road(2), RUBBER, threads=n, **given) for n in (1, 2)
    )
    assert one == two
    assert one.lower.shape == (2, 3)
    single = asperity.friction_band(measured_road(2), RUBBER, **given | {"temperature": 303.0})
    np.testing.assert_allclose(single.upper, one.upper[1], rtol=1e-3)
