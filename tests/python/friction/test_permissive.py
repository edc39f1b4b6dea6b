"""A build without GSL refuses GSL's methods by name, and keeps its promises without them."""

import importlib.metadata

import numpy as np
import pytest

import asperity
from helpers.rubbers import prony

LICENCE = importlib.metadata.metadata("asperity")["License-Expression"]
pytestmark = pytest.mark.skipif(LICENCE != "BSD-3-Clause", reason="this build has GSL and FFTW")

ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
RUBBER = prony(3e6, [1e7, 1e8, 1e9], [1e-2, 1e-4, 1e-6])


@pytest.mark.parametrize("method", ["qag", "qags", "cquad"])
@pytest.mark.parametrize("correction", [None, asperity.PartialContact()])
@pytest.mark.parametrize("function", [asperity.friction, asperity.contact_area])
def test_the_methods_of_gsl_are_refused(function, correction, method):
    said = f"method = {method}: must be gauss in a build without GSL"
    with pytest.raises(asperity.InvalidInput, match=said):
        function(ROAD, RUBBER, pressure=1e5, velocity=1.0, method=method, correction=correction)


def test_integrals_beside_the_panels_are_there():
    q = np.geomspace(1e3, 9e5, 5)
    profile = ROAD.line_density(q)
    assert np.all(profile > 0)
    assert ROAD.autocorrelation(0.0) == pytest.approx(265.7e-6**2, rel=1e-8)
    friction = asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=[1e-3, 1.0])
    assert np.all(friction.error_estimate <= 1e-6 * friction.mu)
