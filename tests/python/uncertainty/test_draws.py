"""Draws of fitted inputs: spread and correlation are those of the fit's covariance."""

import numpy as np

import asperity
from asperity.uncertainty.draws import draw_adhesion, draw_fit

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
