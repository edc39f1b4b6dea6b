"""Anisotropy: ratio and direction against their definition and against surfaces of a known lay."""

import pickle

import numpy as np
import pytest

import asperity
from asperity import (
    HeightMap,
    InvalidInput,
    SelfAffineSpectrum,
    anisotropy,
    spectral_density,
    synthesize,
)

N, PIXEL = 512, 1e-6
DQ = 2 * np.pi / (N * PIXEL)
BAND = SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=DQ, q1=np.pi / PIXEL)


def from_definition(surface, window, q_min, q_max):
    """Slopes across and along, direction: eigenvalues of int q_i q_j C d^2q over a band."""
    plane = spectral_density(surface, window=window)
    qy, qx = np.meshgrid(plane.wavenumber_y, plane.wavenumber_x, indexing="ij")
    inside = (np.hypot(qx, qy) >= q_min) & (np.hypot(qx, qy) <= q_max)
    weight = np.where(inside, plane.density, 0) * (qx[0, 1] - qx[0, 0]) * (qy[1, 0] - qy[0, 0])
    tensor = [[np.sum(weight * a * b) for b in (qx, qy)] for a in (qx, qy)]
    values, vectors = np.linalg.eigh(tensor)
    least = vectors[:, 0]
    return np.sqrt(values[1]), np.sqrt(values[0]), np.arctan2(least[1], least[0])


def apart(angle, other):
    """Between two lays, which are the same after half a turn [rad]."""
    return abs((angle - other + np.pi / 2) % np.pi - np.pi / 2)


@pytest.mark.parametrize("window", ["split-cosine-bell", "hann", "none", "blackman"])
@pytest.mark.parametrize(
    ("shape", "pixel"), [((64, 64), (1, 1)), ((63, 80), (1, 1)), ((80, 51), (0.5, 2))]
)
def test_slopes_and_direction_are_those_of_the_definition(shape, pixel, window):
    z = np.cumsum(np.random.default_rng(5).normal(size=shape), axis=1)
    surface = HeightMap(z, pixel_size=pixel)
    q_min, q_max = 0.3, 0.9 * np.pi / max(pixel)
    result = anisotropy(surface, window=window, q_min=q_min, q_max=q_max)
    across, along, direction = from_definition(surface, window, q_min, q_max)
    assert result.across == pytest.approx(across, rel=1e-11)
    assert result.along == pytest.approx(along, rel=1e-11)
    assert result.ratio == pytest.approx(across / along, rel=1e-11)
    assert apart(result.direction, direction) < 1e-9
    assert -np.pi / 2 < result.direction <= np.pi / 2


def test_an_isotropic_surface_has_no_lay():
    for seed in range(4):
        whole = synthesize(BAND, shape=(1024, 1024), pixel_size=PIXEL, seed=seed)
        crop = HeightMap(whole.heights[100 : 100 + N, 300 : 300 + N].copy(), pixel_size=PIXEL)
        for window in ("split-cosine-bell", "hann"):
            assert 1 <= anisotropy(crop, window=window).ratio < 1.05


@pytest.mark.parametrize(("pixel", "lay"), [((3e-6, 1e-6), np.pi / 2), ((1e-6, 3e-6), 0)])
def test_a_stretched_surface_has_the_ratio_of_its_stretch(pixel, lay):
    # slopes along the stretch are a third: exact where the band holds every mode of the surface
    surface = synthesize(BAND, shape=(N, N), pixel_size=PIXEL, seed=2)
    stretched = HeightMap(surface.heights, pixel_size=pixel)
    band = {"q_min": DQ / 4, "q_max": BAND.q1 * 2}
    result = anisotropy(stretched, window="none", detrend=None, **band)
    assert result.ratio == pytest.approx(3, rel=1e-9)
    assert apart(result.direction, lay) < 1e-9
    assert result.across == pytest.approx(BAND.rms_slope / np.sqrt(2), rel=0.02)


@pytest.mark.parametrize("window", ["split-cosine-bell", "hann"])
def test_a_band_of_a_stretched_surface_has_the_slopes_of_its_spectrum(window):
    # C(q_x, q_y) = 3 C0(sqrt(q_x^2 + 9 q_y^2)) of the surface stretched 3 times along y
    whole = synthesize(BAND, shape=(2 * N, 2 * N), pixel_size=PIXEL, seed=7)
    crop = whole.heights[:N, :N].copy()
    q_min, q_max = 16 * DQ, np.pi / (3 * PIXEL) / 2
    result = anisotropy(
        HeightMap(crop, pixel_size=(3 * PIXEL, PIXEL)), window=window, q_min=q_min, q_max=q_max
    )
    angle = (np.arange(720) + 0.5) * np.pi / 720
    q = np.geomspace(q_min, q_max, 400)
    stretch = np.hypot(np.cos(angle), 3 * np.sin(angle))[:, None] * q
    moment = np.trapezoid(3 * BAND.at(stretch) * q**4, np.log(q), axis=1)
    expected = np.sqrt(np.sum(moment * np.cos(angle) ** 2) / np.sum(moment * np.sin(angle) ** 2))
    assert result.ratio == pytest.approx(expected, rel=0.03)
    assert expected > 2  # in a round band not 3: it holds more of the waves that run along x
    assert apart(result.direction, np.pi / 2) < np.radians(2)


def turned(degrees, seed, hurst=0.8):
    """A Gaussian surface stretched 3 times along a lay, from x towards rising rows."""
    k = np.fft.fftfreq(2 * N) * 2 * N
    ky, kx = k[:, None], k[: N + 1]
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    along, across = kx * c + ky * s, -kx * s + ky * c
    q = np.hypot(3 * along, across)
    q[0, 0] = np.inf
    noise = np.random.default_rng(seed).normal(size=(2 * N, 2 * N))
    z = np.fft.irfft2(np.fft.rfft2(noise) * q ** -(1 + hurst), s=(2 * N, 2 * N))
    return HeightMap(z[:N, :N].copy(), pixel_size=PIXEL)


@pytest.mark.parametrize("window", ["split-cosine-bell", "hann"])
@pytest.mark.parametrize("degrees", [30, -30, 75, 90])
def test_the_lay_of_a_turned_surface_is_found(degrees, window):
    result = anisotropy(turned(degrees, 3), window=window)
    assert apart(result.direction, np.radians(degrees)) < np.radians(2)
    assert 2 < result.ratio < 3


def test_grooves_run_from_x_towards_rising_rows():
    y, x = np.indices((128, 128))
    across = -x * np.sin(np.radians(30)) + y * np.cos(np.radians(30))
    surface = HeightMap(np.sin(2 * np.pi * across / 5.3), pixel_size=PIXEL)
    assert np.degrees(anisotropy(surface).direction) == pytest.approx(30, abs=0.2)
    upside_down = HeightMap(surface.heights[::-1], pixel_size=PIXEL)
    assert np.degrees(anisotropy(upside_down).direction) == pytest.approx(-30, abs=0.2)
    transposed = HeightMap(surface.heights.T, pixel_size=PIXEL)
    assert np.degrees(anisotropy(transposed).direction) == pytest.approx(60, abs=0.2)


def test_a_band_without_modes_is_refused():
    surface = synthesize(BAND, shape=(N, N), pixel_size=PIXEL, seed=0)
    with pytest.raises(InvalidInput, match=r"modes of the map in .* 16 or more"):
        anisotropy(surface, q_min=10.2 * DQ, q_max=10.3 * DQ)


def test_a_mean_over_directions_tells_of_its_lay():
    law = asperity.SelfAffineSpectrum(
        rms_height=1e-6, hurst=0.8, q0=2e4, q1=4e5, axis_ratio=2.5, lay=0.5
    )
    scan = asperity.synthesize(law, shape=(192, 256), pixel_size=(2e-6, 1.5e-6), seed=1)
    table = asperity.power_spectrum(scan)
    assert table.slope_ratio == pytest.approx(asperity.anisotropy(scan).ratio, rel=1e-9)
    rubber = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e7], relaxation_times=[1e-3])
    at = {"pressure": 1e5, "velocity": 1e-2}
    for one in (table, table.log_binned(), pickle.loads(pickle.dumps(table.truncated(q0=5e4)))):
        [note] = (n for n in asperity.friction(one, rubber, **at).notes if n.code == "lay")
        assert note.value == pytest.approx(table.slope_ratio, rel=1e-2)
        assert note.next_step
    kept = asperity.power_spectrum(scan, directional=True)
    assert "lay" not in [note.code for note in asperity.friction(kept, rubber, **at).notes]
    assert asperity.merge_spectra([table, table]).slope_ratio == table.slope_ratio
