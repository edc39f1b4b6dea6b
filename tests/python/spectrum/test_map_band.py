"""The band of a map's spectrum ends at pi / coarser pixel; its rows go to the corner."""

import pickle

import numpy as np
import pytest

import asperity
from asperity import OutOfRange, TabulatedSpectrum

DY, DX = 2e-5, 1e-5
NYQUIST = np.pi / DY
LAW = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.7, q0=5e3, q1=4e5)
RUBBER = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
POINT = {"pressure": 1e5, "velocity": 0.1}


@pytest.fixture(scope="module")
def map_():
    return asperity.synthesize(LAW, shape=(96, 160), pixel_size=(DY, DX), seed=3)


@pytest.fixture(scope="module")
def spectrum(map_):
    return asperity.power_spectrum(map_)


def moment(spectrum, n, q1):
    """sqrt(2 pi int q^n C dq) up to q1 by the trapezoid rule on a fine grid."""
    q = np.geomspace(spectrum.q0, q1, 400_001)
    return np.sqrt(2 * np.pi * np.trapezoid(q**n * spectrum.at(q), q))


def test_moments_and_contact_are_those_of_the_band_alone(spectrum):
    assert spectrum.q1 == NYQUIST
    corner = np.pi * np.hypot(1 / DY, 1 / DX)
    assert spectrum.wavenumber[-1] == pytest.approx(corner, rel=0.05)
    assert spectrum.rms_height == pytest.approx(moment(spectrum, 1, NYQUIST), rel=1e-6)
    assert spectrum.rms_slope == pytest.approx(moment(spectrum, 3, NYQUIST), rel=1e-6)
    cut = spectrum.truncated(q1=NYQUIST)
    assert cut.wavenumber[-1] == NYQUIST
    rows = TabulatedSpectrum(wavenumber=cut.wavenumber, density=cut.density)
    for one in (cut, rows):
        mu = asperity.friction(one, RUBBER, **POINT).mu
        assert asperity.friction(spectrum, RUBBER, **POINT).mu == pytest.approx(mu, rel=1e-9)
        area = asperity.contact_area(one, RUBBER, **POINT)
        assert asperity.contact_area(spectrum, RUBBER, **POINT) == pytest.approx(area, rel=1e-9)


def test_truncated_takes_more_up_to_the_last_row(spectrum):
    last = spectrum.wavenumber[-1]
    whole = spectrum.truncated(q1=last)
    assert whole.q1 == last
    assert whole.rms_slope == pytest.approx(moment(spectrum, 3, last), rel=1e-6)
    assert whole.rms_slope > 1.05 * spectrum.rms_slope
    assert np.array_equal(whole.density, spectrum.density)
    with pytest.raises(OutOfRange, match="the spectrum's rows"):
        spectrum.truncated(q1=1.01 * last)
    assert spectrum.at(last) == pytest.approx(spectrum.density[-1], rel=1e-14)
    with pytest.raises(OutOfRange):
        spectrum.at(1.01 * last)


CHANGED = {
    "scaled": lambda s: s.scaled(2.0),
    "begun later": lambda s: s.truncated(q0=2 * s.q0),
    "binned": lambda s: s.log_binned(per_decade=20),
    "merged": lambda s: asperity.merge_spectra([s, s]),
    "pickled": lambda s: pickle.loads(pickle.dumps(s)),
}


@pytest.mark.parametrize("how", CHANGED)
def test_the_band_stays_where_rows_change(spectrum, how):
    changed = CHANGED[how](spectrum)
    assert changed.q1 == spectrum.q1
    assert changed.wavenumber[-1] > changed.q1


def test_of_scans_at_two_magnifications_the_finer_ends_the_band(map_, spectrum):
    fine = asperity.HeightMap(map_.heights[:48, :48], pixel_size=DX / 2)
    merged = asperity.merge_spectra([spectrum, asperity.power_spectrum(fine)], per_decade=10)
    assert merged.q1 == np.pi / (DX / 2)


def test_by_tiles_it_is_the_same(map_):
    large = np.tile(map_.heights, (12, 8))
    tiled = asperity.power_spectrum(large, pixel_size=(DY, DX), tiles=(576, 640))
    assert tiled.q1 == NYQUIST < tiled.wavenumber[-1]


@pytest.mark.parametrize("directional", [False, True])
def test_a_result_states_how_the_heights_were_prepared(map_, directional):
    """In the words of a scene, through what keeps the rows, a pickle and directions."""
    made = asperity.power_spectrum(
        map_, window="hann", detrend="quadratic", directional=directional
    )
    text = 'window = "hann", detrend = "quadratic"'
    kept = pickle.loads(pickle.dumps(made)).truncated(q1=2e5).scaled(0.5)
    for one in (made, kept, made.log_binned(per_decade=20)):
        assert one.preparation == text
        assert one == pickle.loads(pickle.dumps(one))
    for direction in (0.0, [0.0, 1.0]):
        result = asperity.friction(kept, RUBBER, **POINT, direction=direction)
        assert result.preparation == text
        assert text in repr(result)
        assert result.to_xarray().attrs["preparation"] == text
    assert asperity.friction(LAW, RUBBER, **POINT).preparation is None
    merged = asperity.merge_spectra([made, made])
    assert merged.preparation is None
