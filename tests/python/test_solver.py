"""The two ways to integrate against each other, and what the error estimate promises."""

import sys
from pathlib import Path

import numpy as np
import pytest

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "stability"))
import random_scenes

ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6, moduli=[1e7, 1e8, 1e9], relaxation_times=[1e-2, 1e-4, 1e-6]
)


def test_the_error_estimate_is_kept_on_random_scenes():
    outcomes = [random_scenes.compute(7, scene, tables=0.05) for scene in range(300)]
    assert [i for i, outcome in enumerate(outcomes) if not outcome.kept] == []


def test_a_point_does_not_depend_on_the_points_beside_it():
    pressure, velocity = np.geomspace(1e3, 1e7, 5), np.geomspace(1e-6, 1, 7)[:, None]
    for correction in (None, asperity.SFactor()):
        options = {"correction": correction, "adhesion": asperity.Adhesion(shear_stress=5e6)}
        grid = asperity.friction(ROAD, RUBBER, pressure=pressure, velocity=velocity, **options)
        for i, v in enumerate(velocity[:, 0]):
            for j, p in enumerate(pressure):
                alone = asperity.friction(ROAD, RUBBER, pressure=p, velocity=v, **options)
                assert (alone.mu, alone.error_estimate) == (
                    grid.mu[i, j],
                    grid.error_estimate[i, j],
                )


@pytest.mark.parametrize(
    "call", [asperity.contact_area, asperity.mean_pressure, asperity.correction_factor]
)
def test_both_methods_agree_at_every_magnification(call):
    options = {"pressure": 81e3, "velocity": [1e-4, 1.0], "wavenumber": np.geomspace(2000, 1e6, 7)}
    gauss = call(ROAD, RUBBER, rtol=1e-9, **options)
    qag = call(ROAD, RUBBER, rtol=1e-9, method="qag", **options)
    np.testing.assert_allclose(gauss, qag, rtol=1e-9)


def test_both_methods_agree_on_contributions():
    options = {"pressure": 81e3, "velocity": [1e-4, 1.0], "contributions": True, "rtol": 1e-9}
    gauss = asperity.friction(ROAD, RUBBER, **options)
    qag = asperity.friction(ROAD, RUBBER, method="qag", **options)
    np.testing.assert_allclose(gauss.decade_share, qag.decade_share, rtol=0, atol=1e-9)
    np.testing.assert_allclose(gauss.dmu_dlnq, qag.dmu_dlnq, rtol=1e-8)


def test_an_unknown_method_is_refused():
    with pytest.raises(asperity.InvalidInput, match="method"):
        asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=1.0, method="simpson")
