"""Faults that an attack on the numerics found, each once more."""

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, TabulatedSpectrum
from helpers.examples import FMAP


@pytest.mark.parametrize("cut", [{"q1": 3.0}, {"q0": 2.5}])
def test_a_cut_beside_a_zero_is_refused_and_one_at_a_row_changes_nothing(cut):
    table = TabulatedSpectrum(wavenumber=[1, 2, 4, 8], density=[1, 1, 0, 0])
    with pytest.raises(InvalidInput, match=r"^q[01] = .*: must be at a row .*, 2 or 4$"):
        table.truncated(**cut)
    assert table.truncated(q1=4.0).at(2.5) == table.at(2.5) == 0.75


def test_a_distance_of_too_many_oscillations_is_refused():
    table = TabulatedSpectrum(wavenumber=[1e3, 1e4, 1e5], density=[1e-10, 1e-12, 1e-17])
    with pytest.raises(asperity.NotConverged, match=r"^distance = 1e\+14: "):
        table.autocorrelation(1e14)


def test_a_rolled_off_spectrum_gives_its_rolloff_to_greenwood_williamson():
    spectrum = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=200, q1=1e6, rolloff=2000)
    rubber = asperity.PronySeries(equilibrium_modulus=3e7, moduli=[], relaxation_times=[])
    scene = {"pressure": 2e5, "velocity": 0.001}
    height = {"z_max": 4e-4, "z_min": -4e-4}
    default, given, lowest = (
        asperity.friction(
            spectrum, rubber, correction=asperity.GreenwoodWilliamson(**height, **q0), **scene
        ).shift_factor
        for q0 in ({}, {"q0": 2000}, {"q0": 200})
    )
    assert default == given != lowest


def test_a_measured_spectrum_that_had_to_give_its_lowest_bin_says_so():
    table = TabulatedSpectrum(wavenumber=[1e3, 1e4, 1e5], density=[1e-14, 1e-18, 1e-22])
    rubber = asperity.PronySeries(equilibrium_modulus=3e7, moduli=[], relaxation_times=[])
    for q0, said in ((None, True), (2e3, False)):
        correction = asperity.GreenwoodWilliamson(z_max=4e-4, z_min=-4e-4, q0=q0)
        notes = asperity.contact_notes(
            table, rubber, pressure=1e5, velocity=0.001, correction=correction
        )
        assert any("give q0" in note for note in notes) == said


def test_a_map_at_one_point_takes_shift_factors_of_any_shape():
    shifted = FMAP.mu(1.5e5, 0.1, a_T=np.array([1.0, 0.5]))
    np.testing.assert_allclose(
        shifted, [FMAP.mu(1.5e5, 0.1), FMAP.mu(1.5e5, 0.1, a_T=0.5)], rtol=1e-14
    )
