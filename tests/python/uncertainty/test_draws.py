"""Draws of fitted inputs: spread and correlation are those of the fit's covariance."""

import numpy as np
import pytest

import asperity
from asperity.uncertainty.draws import draw_adhesion, draw_fit
from helpers.rubbers import prony

ROAD = asperity.SelfAffineSpectrum(rms_height=2e-4, hurst=0.7, q0=2e3, q1=2e5, rolloff=8e3)


def check(drawn, covariance):
    """Rows of 4000 draws against the covariance of their columns."""
    deviations = np.outer(*2 * [np.sqrt(np.diag(covariance))])
    assert np.abs(covariance / deviations).min() > 0.2  # else there is no correlation to see
    # a correlation scatters by 1 / sqrt(4000) = 0.016, a variance by sqrt(2 / 4000) = 0.022:
    # four times that
    assert len(drawn) == 4000
    np.testing.assert_allclose(np.cov(drawn.T) / deviations, covariance / deviations, atol=0.09)


def test_drawn_self_affine_laws_have_the_fits_covariance():
    q = np.geomspace(ROAD.q0, ROAD.q1, 60)
    count = np.full(q.size, 400.0)  # H to 0.005: no draw is near 1
    density = ROAD.at(q) * np.random.default_rng(1).gamma(count / 2) / (count / 2)
    table = asperity.TabulatedSpectrum(
        wavenumber=q, density=density, count=count, standard_error=density * np.sqrt(2 / count)
    )
    fit = asperity.fit_self_affine(table)
    rng = np.random.default_rng(2)
    draws = [draw_fit(fit, rng) for _ in range(4000)]
    drawn = np.array([[np.log(d.rms_height), d.hurst, np.log(d.rolloff)] for d in draws])
    scale = np.array([fit.rms_height, 1, fit.rolloff])  # d ln x = dx / x
    check(drawn, fit.covariance[:3, :3] / np.outer(scale, scale))


def test_drawn_adhesions_have_the_fits_covariance():
    covariance = np.array([[4, 3, -1], [3, 9, -2], [-1, -2, 1]]) * 1e-4
    scale = np.array([8e6, 6e-3, 1])
    fit = asperity.AdhesionFit(
        shear_stress=scale[0],
        reference_velocity=scale[1],
        width=0.1,
        covariance=covariance * np.outer(scale, scale),
        residual=0.05,
        outliers=np.zeros(9, bool),
    )
    rng = np.random.default_rng(3)
    draws = [draw_adhesion(fit, rng) for _ in range(4000)]
    drawn = [[np.log(d.shear_stress), np.log(d.reference_velocity), d.width] for d in draws]
    check(np.array(drawn), covariance)


def test_factors_of_strain_are_drawn_as_a_whole():
    rows = {"strain": [0.01, 0.1, 0.5], "storage": [0.8, 0.5, 0.3], "loss": [1.2, 0.8, 0.4]}
    errors = {"storage_error": [0.1, 0.1, 0.1], "loss_error": [0.1, 0.1, 0.1]}
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5)
    rubber = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
    scene = {"pressure": 1e7, "velocity": 1e-2, "samples": 400}
    band = asperity.friction_band(
        road, rubber, **scene, strain_factors=asperity.StrainFactors(**rows, **errors)
    )
    mu = [
        asperity.friction(
            road,
            rubber,
            pressure=1e7,
            velocity=1e-2,
            strain_factors=asperity.StrainFactors(
                **rows | {"loss": np.multiply(rows["loss"], np.exp(0.1 * z))}
            ),
        ).mu
        for z in (-1.96, 1.96)
    ]
    # hardly more than that of g alone, in proportion to which mu is at a high load
    assert band.lower < mu[0] * 1.02
    assert band.upper > mu[1] * 0.98
    assert band.upper / band.lower < 1.3 * mu[1] / mu[0]
    with pytest.raises(asperity.InvalidInput, match="none has errors"):
        asperity.friction_band(road, rubber, **scene, strain_factors=asperity.StrainFactors(**rows))


def gaussian_map(seed, law, points=128):
    """Heights whose waves are all random, as those of a measured surface are."""
    q = 2 * np.pi * np.fft.fftfreq(points, 1 / points)  # a map of side 1
    q_x, q_y = np.meshgrid(q, q)
    size = np.hypot(q_x, q_y)
    inside = (size > law.q0) & (size < law.q1)
    amplitude = np.zeros_like(size)
    amplitude[inside] = law.toward(size[inside], np.arctan2(q_y[inside], q_x[inside])) ** 0.5
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal(size.shape))
    heights = 2 * np.pi * points * np.fft.ifft2(noise * amplitude).real
    return asperity.HeightMap(heights, pixel_size=1 / points)


def test_bands_of_directions_are_as_wide_as_scans_scatter():
    law = asperity.SelfAffineSpectrum(
        rms_height=1e-3, hurst=0.8, q0=3.5 * 2 * np.pi, q1=58 * 2 * np.pi, axis_ratio=2.5, lay=1.9
    )
    rubber = prony(1e6, [9e6, 2e7], [1e-1, 1e-3])
    at = {"pressure": 2e5, "velocity": 0.1, "correction": asperity.PartialContact()}
    at["direction"] = np.radians([0, 60, 110, 160])
    how = {"window": "none", "detrend": None, "directional": True}
    spectra = [
        asperity.power_spectrum(gaussian_map(seed, law), **how).truncated(q0=4 * 2 * np.pi)
        for seed in range(24)
    ]
    mu = np.array([asperity.friction(one, rubber, **at).mu for one in spectra])
    bands = [asperity.friction_band(one, rubber, **at, samples=40) for one in spectra[:6]]
    np.testing.assert_array_equal([band.mu for band in bands], mu[:6])
    wide = np.mean([np.log(band.upper / band.lower) for band in bands], axis=0) / (2 * 1.96)
    scatter = np.log(mu).std(axis=0, ddof=1)
    np.testing.assert_allclose(wide, scatter, rtol=0.4)  # three standard errors of 24 maps
    one = asperity.friction_band(spectra[0], rubber, **{**at, "direction": 0.0}, samples=40)
    assert (one.lower, one.upper) == (bands[0].lower[0], bands[0].upper[0])
    assert one.direction == 0
