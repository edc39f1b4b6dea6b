"""Where spectra fail: each map or scan that a user may bring, and what is said or comes of it."""

from functools import partial

import numpy as np
import pytest

from asperity import (
    HeightMap,
    LineScan,
    LineSpectrum,
    SelfAffineSpectrum,
    anisotropy,
    fit_self_affine,
    line_spectrum,
    power_spectrum,
    spectral_density,
    synthesize,
)
from helpers.refusals import refused

RNG = np.random.default_rng(31)
N, PIXEL = 512, 1e-6
DQ = 2 * np.pi / (N * PIXEL)
WHOLE = SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=DQ, q1=np.pi / PIXEL)


def surface_of(heights):
    return HeightMap(heights, pixel_size=PIXEL)


def test_a_constant_map_has_no_roughness_and_no_fit():
    flat = surface_of(np.full((64, 48), 3e-6))
    for part in ("all", "top", "bottom"):
        assert np.all(power_spectrum(flat, part=part).density == 0)
    assert np.all(line_spectrum(flat).density == 0)
    assert np.all(spectral_density(flat).density == 0)
    assert (flat.rms_height, flat.rms_slope, flat.skewness) == (0, 0, 0)


def test_a_map_of_one_row_is_a_scan_to_line_spectrum():
    z = RNG.normal(size=200)
    assert line_spectrum(surface_of(z[None])) == line_spectrum(LineScan(z, spacing=PIXEL))


@pytest.mark.parametrize("shape", [(509, 521), (499, 131)])
def test_prime_sides_are_no_worse_than_others(shape):
    lower = SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=DQ / 2, q1=WHOLE.q1)
    whole = synthesize(lower, shape=(1024, 1024), pixel_size=PIXEL, seed=1).heights
    rings = power_spectrum(surface_of(whole[: shape[0], : shape[1]].copy()))
    binned = rings.log_binned()
    ok = binned.reliable
    miss = binned.density[ok] - lower.at(binned.wavenumber[ok])
    assert np.all(np.abs(miss) < 4 * binned.standard_error[ok])
    assert ok.sum() >= 4
    fit = fit_self_affine(rings)
    assert fit.standard_errors["hurst"] < 0.05
    assert abs(fit.hurst - 0.8) < 4 * fit.standard_errors["hurst"]


def framed(width):
    z = synthesize(WHOLE, shape=(N, N), pixel_size=PIXEL, seed=2).heights.copy()
    z[:width], z[-width:], z[:, :width], z[:, -width:] = (np.nan,) * 4
    return z


def test_a_frame_of_drop_outs_is_filled_or_refused_by_its_share():
    thin, thick = surface_of(framed(2)), surface_of(framed(16))
    with refused("heights", "invalid-input"):
        thick.fill_dropouts()
    whole = synthesize(WHOLE, shape=(N, N), pixel_size=PIXEL, seed=2)
    for surface, filled in (
        (thin, thin.fill_dropouts()),
        (thick, thick.fill_dropouts(max_fraction=0.2)),
    ):
        assert filled.dropout_fraction == 0
        known = ~np.isnan(surface.heights)
        np.testing.assert_array_equal(filled.heights[known], surface.heights[known])
    # the window brings the frame to zero anyhow
    result, expected = power_spectrum(thin.fill_dropouts()), power_spectrum(whole)
    ok = expected.reliable
    np.testing.assert_allclose(result.density[ok], expected.density[ok], rtol=1e-3)


def test_rows_of_drop_outs_cost_little_once_filled():
    z = synthesize(WHOLE, shape=(N, N), pixel_size=PIXEL, seed=3).heights.copy()
    expected = power_spectrum(surface_of(z)).log_binned()
    z[RNG.choice(N, 8, replace=False)] = np.nan
    filled = surface_of(z).fill_dropouts()
    assert np.all(np.isfinite(filled.heights))
    result = power_spectrum(filled).log_binned()
    low = expected.reliable & (expected.wavenumber < 0.3 * WHOLE.q1)
    np.testing.assert_allclose(result.density[low], expected.density[low], rtol=0.05)


@pytest.mark.parametrize("window", ["split-cosine-bell", "hann"])
def test_a_step_looks_like_a_surface_of_hurst_one_half(window):
    # |h(q)|^2 ~ 1 / q^2 on the one axis, over 2 pi q / dq modes of a ring: C ~ q^-3
    step = 1e-6 * (np.arange(N) > N // 2 + 7) * np.ones((N, 1))
    rings = power_spectrum(surface_of(step), window=window)
    fit = fit_self_affine(rings, q_max=N / 8 * DQ)
    assert fit.hurst == pytest.approx(0.5, abs=0.03)
    assert fit.rolloff is None
    # sampled, it falls less steeply towards Nyquist, where 1 / q^2 is folded to 1 / (4 sin^2)
    assert 0.4 < fit_self_affine(rings).hurst < 0.47
    smooth = synthesize(WHOLE, shape=(N, N), pixel_size=PIXEL, seed=0).heights
    rough = [
        fit_self_affine(power_spectrum(surface_of(smooth + k * step), window=window)).hurst
        for k in (0, 1, 5, 100)
    ]
    assert rough[0] == pytest.approx(0.8, abs=0.02)
    assert np.all(np.diff(rough) < 0)
    tilted = surface_of(smooth + 100 * step)
    for order in ("plane", "quadratic"):  # neither takes a step out
        assert tilted.detrend(order).rms_height > 0.1 * tilted.rms_height


def test_a_map_smaller_than_its_longest_waves_shows_a_power_law_only():
    rolled = SelfAffineSpectrum(
        rms_height=1e-5, hurst=0.8, q0=DQ / 4, rolloff=DQ / 2, q1=np.pi / PIXEL
    )
    whole = synthesize(rolled, shape=(4 * N, 4 * N), pixel_size=PIXEL, seed=0)
    rings = power_spectrum(surface_of(whole.heights[:N, :N].copy()))
    fit = fit_self_affine(rings)
    assert fit.rolloff is None
    assert fit.hurst == pytest.approx(0.8, abs=0.02)
    assert fit.rms_height < 0.2 * rolled.rms_height  # of the band that the map shows
    with refused("spectrum", "invalid-input"):
        fit_self_affine(rings, rolloff="require")


def test_quantised_heights_have_the_noise_floor_of_their_last_bit():
    smooth = SelfAffineSpectrum(rms_height=1e-6, hurst=0.9, q0=2 * DQ, q1=100 * DQ)
    z = synthesize(smooth, shape=(N, N), pixel_size=PIXEL, seed=0).heights
    bit = np.ptp(z) / 65535
    counts = np.round(z / bit).astype("i4")
    floor = bit**2 / 12 * PIXEL**2 / (2 * np.pi) ** 2
    fine = {"window": "none", "detrend": None}
    rings = power_spectrum(surface_of(counts * bit), **fine)
    high = rings.wavenumber > 110 * DQ
    assert np.average(rings.density[high], weights=rings.count[high]) == pytest.approx(
        floor, rel=0.2, abs=0
    )
    assert np.all(np.abs(rings.density[high & (rings.count > 500)] / floor - 1) < 0.3)
    clean = power_spectrum(surface_of(z), **fine)
    assert np.all(clean.density[high] < 1e-6 * floor)
    low = rings.wavenumber < 50 * DQ
    held = low & (clean.density > 0)
    np.testing.assert_allclose(rings.density[held][5:], clean.density[held][5:], rtol=0.01)


def test_stitching_lines_tilt_the_lay_and_raise_the_spectrum():
    for seed in range(3):
        z = synthesize(WHOLE, shape=(N, N), pixel_size=PIXEL, seed=seed).heights
        clean = surface_of(z)
        offsets = np.random.default_rng(seed).normal(size=8) * clean.rms_height
        stitched = surface_of(z + np.repeat(offsets, N // 8))
        before, after = anisotropy(clean), anisotropy(stitched)
        assert before.ratio < 1.05
        assert after.ratio > 1.5
        assert abs(abs(np.degrees(after.direction)) - 90) < 1  # the lines run along y
        rise = power_spectrum(stitched).density / power_spectrum(clean).density
        assert rise[:16].mean() > 1.2
        assert rise[16:64].mean() > 1.5
        assert fit_self_affine(power_spectrum(stitched)).hurst < 0.7


@pytest.mark.parametrize("aspect", [1e-3, 1e-2, 1, 100])
def test_narrow_pixels_are_no_trouble(aspect):
    heights = RNG.normal(size=(64, 64))
    result = power_spectrum(HeightMap(heights, pixel_size=(aspect * 1e-6, 1e-6)), window="none")
    assert result.count.sum() == 64**2 - 1


PLANE = (power_spectrum, spectral_density, anisotropy)
FLAT = surface_of(np.full((64, 48), 3e-6))
LINE = LineScan(RNG.normal(size=200), spacing=PIXEL)
STEEP = LineSpectrum(wavenumber=[1, 2, 3, 4], density=[1, 20, 400, 4])
RISING = LineSpectrum(wavenumber=[1, 2, 3], density=[1, 2, 4])
NARROW = [(a * 1e-6, 1e-6) for a in (1e-294, 1e-7, 1e-6, 1e6, 1e7, 1e300)]  # rings without modes


def noise(*shape, pixel_size=PIXEL):
    return HeightMap(RNG.normal(size=shape), pixel_size=pixel_size)


REFUSED = [
    *(("surface", f, (noise(*s),)) for f in PLANE for s in ((1, 200), (200, 1), (1, 1))),
    *(("surface", f, (LINE,)) for f in PLANE),
    *(("surface", f, (surface_of(framed(2)),)) for f in (*PLANE, line_spectrum)),
    *(("surface", line_spectrum, (noise(1, n),)) for n in (1, 2, 3)),
    ("surface", power_spectrum, (noise(3, 3),)),
    *(("pixel_size", power_spectrum, (noise(64, 64, pixel_size=size),)) for size in NARROW),
    ("spectrum", fit_self_affine, (power_spectrum(noise(8, 8)),)),
    ("spectrum", RISING.isotropic, ()),
    ("spectrum", partial(STEEP.isotropic, per_decade=None), ()),
    ("density", line_spectrum(FLAT).isotropic, ()),
    ("heights", FLAT.height_histogram, ()),
    ("heights", surface_of, (np.where(np.eye(50) > 0, -np.inf, 1.0),)),
]


@pytest.mark.parametrize(("argument", "function", "given"), REFUSED)
def test_what_has_no_spectrum_is_refused_by_its_argument(argument, function, given):
    code = "invalid-value" if argument == "density" or function is surface_of else "invalid-input"
    with refused(argument, code):
        function(*given)
