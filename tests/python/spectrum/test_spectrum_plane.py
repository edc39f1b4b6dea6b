"""The plane of wavevectors, large and prime maps, top and bottom, and the unit of length."""

import numpy as np
import pytest

from asperity import (
    HeightMap,
    LineScan,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    anisotropy,
    fit_self_affine,
    line_spectrum,
    merge_spectra,
    power_spectrum,
    spectral_density,
    synthesize,
)
from helpers.plain_spectrum import detrended, plain, profile

RNG = np.random.default_rng(21)
WINDOWS = ["split-cosine-bell", "hann", "none", "blackman"]
ORDERS = ["plane", "quadratic", "offset", None]


@pytest.mark.parametrize("detrend", ORDERS)
@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize(
    ("shape", "pixel"),
    [((32, 48), (1e-6, 2e-6)), ((31, 48), (1, 1)), ((32, 47), (3, 1)), ((7, 5), (1, 1))],
)
def test_the_plane_is_that_of_a_plain_transform(shape, pixel, window, detrend):
    z = RNG.normal(size=shape) + 2
    result = spectral_density(HeightMap(z, pixel_size=pixel), window=window, detrend=detrend)
    w = np.outer(*(profile(window, n) for n in shape))
    area = z.size * pixel[0] * pixel[1]
    power = np.abs(np.fft.fft2(detrended(z, detrend) * w)) ** 2 / z.size**2
    expected = np.fft.fftshift(power) * area / (2 * np.pi) ** 2 / np.mean(w**2)
    for axis, name in enumerate(("wavenumber_y", "wavenumber_x")):
        q = 2 * np.pi * np.fft.fftshift(np.fft.fftfreq(shape[axis], pixel[axis]))
        np.testing.assert_allclose(getattr(result, name), q, rtol=1e-14)
    np.testing.assert_allclose(result.density, expected, rtol=1e-11, atol=1e-15 * expected.max())


@pytest.mark.parametrize("part", ["top", "bottom"])
@pytest.mark.parametrize("detrend", ORDERS)
@pytest.mark.parametrize("window", ["split-cosine-bell", "none"])
def test_a_top_spectrum_is_that_of_the_clipped_heights_over_their_share(window, detrend, part):
    y, x = np.indices((48, 64))
    z = RNG.gumbel(size=(48, 64)) + 0.05 * y - 0.02 * x
    result = power_spectrum(
        HeightMap(z, pixel_size=1e-6), window=window, detrend=detrend, part=part
    )
    above = detrended(z, detrend)
    above = above - above.mean()
    share = np.mean(above > 0 if part == "top" else above < 0)
    clipped = np.maximum(above, 0) if part == "top" else np.minimum(above, 0)
    q, density, count = plain(clipped, (1e-6, 1e-6), window, "offset")
    np.testing.assert_allclose(result.wavenumber, q, rtol=1e-12)
    np.testing.assert_array_equal(result.count, count)
    np.testing.assert_allclose(result.density, density / share, rtol=1e-10)


BAND = SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2 * np.pi / 64e-6, q1=np.pi / 1e-6)


def test_top_bottom_and_whole_agree_at_large_wavenumbers_where_heights_are_gaussian():
    ratios = []
    for seed in range(3):
        surface = synthesize(BAND, shape=(512, 512), pixel_size=1e-6, seed=seed)
        spectra = {part: power_spectrum(surface, part=part) for part in ("all", "top", "bottom")}
        fine = spectra["all"].reliable & (spectra["all"].wavenumber > 0.2 * BAND.q1)
        whole = spectra["all"].density[fine]
        ratios.append([np.mean(spectra[part].density[fine] / whole) for part in ("top", "bottom")])
    np.testing.assert_allclose(np.mean(ratios, axis=0), 1, atol=0.1)


def rows(spectrum, power):
    """Numbers of a spectrum with their powers of length."""
    names = {"wavenumber": -1, "density": power, "standard_error": power}
    table = {name: (getattr(spectrum, name), p) for name, p in names.items()}
    return {**table, "count": (spectrum.count, 0), "flag": (spectrum.flag, 0)}


def everything(unit):
    """What comes of one surface, measured in a unit of length, with its powers of length."""
    whole = SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e4, q1=1e7)
    z = synthesize(whole, shape=(256, 200), pixel_size=1e-6, seed=4).heights * unit
    surface = HeightMap(z, pixel_size=(1e-6 * unit, 1.3e-6 * unit))
    crop = HeightMap(z[:128, :160], pixel_size=(1e-6 * unit, 1.3e-6 * unit))
    spectra = [power_spectrum(m, window="hann") for m in (surface, crop)]
    profiles = line_spectrum(surface)
    fit = fit_self_affine(spectra[0], rolloff="none")
    lay = anisotropy(surface)
    q = np.geomspace(1e3, 1e6, 60) / unit
    knee = np.where(q < 3e4 / unit, 1.0, (q * unit / 3e4) ** -3.6) * (
        1 + 0.1 * np.sin(9 * q * unit)
    )
    rolled = fit_self_affine(TabulatedSpectrum(wavenumber=q, density=1e-20 * unit**4 * knee))
    result = {
        "rings": rows(spectra[0], 4),
        "top": rows(power_spectrum(surface, part="top"), 4),
        "lines": rows(profiles, 3),
        "scan": rows(line_spectrum(LineScan(z[7], spacing=1e-6 * unit)), 3),
        "binned": rows(spectra[0].log_binned(), 4),
        "binned lines": rows(profiles.log_binned(per_decade=7), 3),
        "isotropic": rows(profiles.isotropic(), 4),
        "merged": rows(merge_spectra(spectra, per_decade=10), 4),
        "fit": {
            "hurst": (fit.hurst, 0),
            "rms_height": (fit.rms_height, 1),
            "q0": (fit.q0, -1),
            "rms_error": (fit.standard_errors["rms_height"], 1),
            "hurst_error": (fit.standard_errors["hurst"], 0),
            "residual": (fit.residual, 0),
        },
        "lay": {name: (getattr(lay, name), 0) for name in ("across", "along", "direction")},
    }
    # found where a parabola is least: to the root of the rounding
    loose = {"rolloff": (rolled.rolloff, -1), "error": (rolled.standard_errors["rolloff"], -1)}
    return result, loose


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_spectra_scale_with_the_unit_of_length(unit):
    (first, first_loose), (other, other_loose) = everything(1.0), everything(unit)
    by_steps = {("isotropic", "standard_error"), ("fit", "rms_error")}  # numerical derivatives
    for name, numbers in first.items():
        for what, (value, power) in numbers.items():
            rtol = 1e-9 if (name, what) in by_steps else 1e-12
            np.testing.assert_allclose(
                other[name][what][0] / unit**power, value, rtol=rtol, err_msg=f"{name} {what}"
            )
    for what, (value, power) in first_loose.items():
        np.testing.assert_allclose(other_loose[what][0] / unit**power, value, rtol=1e-7)
