"""The band of mu that goes with a fitted adhesion, where the surface has errors too."""

from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.io.read_friction import MeasuredFriction
from asperity.scene.experiment import Experiment
from asperity.scene.scene import load_scene

SCENE = """
[surface]
file = "scan.npy"
pixel_size_m = 1e-5
unit = "m"
[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e7, 1e8, 1e9]
relaxation_times_s = [1e-2, 1e-4, 1e-6]
[conditions]
pressure_pa = 81e3
velocity_m_s = [1e-5, 1e-3]
"""


@pytest.fixture
def scene(tmp_path):
    surface = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=2e4, q1=3e5)
    heights = asperity.synthesize(surface, shape=(200, 240), pixel_size=1e-5, seed=4).heights
    np.save(tmp_path / "scan.npy", heights)
    (tmp_path / "scene.toml").write_text(SCENE)
    return load_scene(tmp_path / "scene.toml")


def test_the_scatter_of_the_points_is_in_the_band_beside_the_surfaces_errors(scene):
    velocity = np.repeat(np.geomspace(1e-6, 1, 15), 3)
    truth = asperity.Adhesion(shear_stress=8.3e6)
    mu = asperity.friction(
        scene.spectrum, scene.rubber, pressure=81e3, velocity=velocity, adhesion=truth
    ).mu
    mu = mu * np.exp(0.05 * np.random.default_rng(1).normal(size=mu.size))
    measured = MeasuredFriction(velocity, mu, None)
    experiment = Experiment(Path("mu.csv"), measured, np.full(mu.size, 81e3), {})
    fit, _ = experiment.fit_scene(scene)
    band = experiment.curves(scene, fit, nullcontext).band
    assert band is not None
    without_errors = asperity.TabulatedSpectrum(
        wavenumber=scene.spectrum.wavenumber, density=scene.spectrum.density
    )
    own = asperity.friction_band(
        without_errors, scene.rubber, pressure=81e3, velocity=scene.velocity, adhesion=fit
    )
    # At these velocities the surface's errors alone make 0.15 of this width. Those of 100 draws
    # scatter by a tenth; the covariance is linear, and off by a few per cent at 5 % of noise.
    np.testing.assert_allclose((band[1] - band[0])[0], own.upper - own.lower, rtol=0.4)
