"""Section 5.2 checked: scans, windows, spectra, Hurst exponents."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from asperity.article.inputs import PIXEL_SIZE, PIXELS, Q0, SIDE, Inputs
from asperity.article.statement import (
    Statement,
    by_construction,
    judged,
    listed,
    percent,
    unchecked,
)
from asperity.measured_spectrum import SelfAffineFit, fit_self_affine, power_spectrum
from asperity.spectrum import SelfAffineSpectrum, TabulatedSpectrum
from asperity.surface import HeightMap

_Array = NDArray[np.float64]
_POINTS = 1000  # of the window
_SHORT, _LONG = 4, 12  # sides of scans that are cut out of the periodic maps [lambda0]
# Rows of a fit: clear of lambda0, and of what half of pi / pixel folds back.
BAND = (1.25 * Q0, np.pi / PIXEL_SIZE / 2)


@dataclass(frozen=True, eq=False)
class Spectra:
    """Spectra of one scan of either surface, cut out of its map, and Eq. 28's line."""

    name: str
    truth: SelfAffineSpectrum
    measured: TabulatedSpectrum
    fit: SelfAffineFit


def compute(inputs: Inputs) -> list[Spectra]:
    """Sandpaper, then asphalt, each as a scan of 12 x 12 lambda0 would show it."""
    result = []
    for name, truth, scan in (
        ("120-grit sandpaper", inputs.sandpaper, inputs.scans[0]),
        ("asphalt", inputs.asphalt, inputs.asphalt_scans[0]),
    ):
        measured = power_spectrum(cut(scan, _LONG))
        result.append(Spectra(name, truth, measured, slope_fit(measured)))
    return result


def cut(scan: HeightMap, side: int) -> HeightMap:
    """A corner of a periodic map, which is periodic no more; `side` in lambda0."""
    pixels = side * PIXELS // SIDE
    return HeightMap(scan.heights[:pixels, :pixels], pixel_size=PIXEL_SIZE)


def slope_fit(measured: TabulatedSpectrum) -> SelfAffineFit:
    """Eq. 28: H of a straight line through the rows of BAND."""
    return fit_self_affine(measured, q_min=BAND[0], q_max=BAND[1], method="slope")


def statements(inputs: Inputs, spectra: Sequence[Spectra]) -> list[Statement]:
    """What Section 5.2 says of scans and their spectra."""
    return [*_scans(inputs), *_fits(inputs, spectra)]


def _scans(inputs: Inputs) -> list[Statement]:
    scan = inputs.asphalt_scans[0]
    tilted = HeightMap(scan.heights + 0.02 * np.arange(PIXELS) * PIXEL_SIZE, pixel_size=PIXEL_SIZE)
    flat = tilted.detrend("plane")
    wrong, right = (slope_fit(power_spectrum(s, detrend="offset")) for s in (tilted, flat))
    low, hurst = _windows(inputs)
    truth = inputs.asphalt.hurst
    tilt = tilted.detrend("offset").rms_height
    bell = packaged_bell(_POINTS)
    kept = float(np.mean(bell > 1 - 1e-9))
    level = np.mean([printed_variance(surface) for surface in inputs.asphalt_scans])
    lost = np.mean(split_cosine_bell(PIXELS) ** 2) ** 2
    filled, holes = _dropouts(scan)
    patched, whole = (slope_fit(power_spectrum(s)).hurst for s in (filled, scan))
    return [
        Statement(
            "S1",
            "Sec. 5.2, Fig. 6",
            "offset, slope and curvature must go before any statistic",
            "rms height or H wrong by more than 5 % when a slope of 0.02 stays",
            f"rms height {tilt * 1e6:.4g} um with the slope, {flat.rms_height * 1e6:.4g} um "
            f"without; H {wrong.hurst:.3f} and {right.hurst:.3f}",
            judged(
                abs(tilt / flat.rms_height - 1) > 0.05 or abs(wrong.hurst / right.hurst - 1) > 0.05
            ),
            "asphalt, 16 x 16 lambda0",
        ),
        Statement(
            "S2",
            "Sec. 5.2",
            "without a window the spectrum leaks",
            "H off by more than 0.03 without, by less than 0.03 with either window",
            f"H of asphalt ({truth:g}) {hurst['none']:.3f} without, "
            f"{hurst['split-cosine-bell']:.3f} split cosine bell, {hurst['hann']:.3f} Hann",
            judged(
                [
                    abs(hurst["none"] - truth) > 0.03,
                    abs(hurst["hann"] - truth) < 0.03,
                    abs(hurst["split-cosine-bell"] - truth) < 0.03,
                ]
            ),
            f"mean of {len(inputs.asphalt_scans)} scans of {_SHORT} x {_SHORT} lambda0",
        ),
        Statement(
            "S3",
            "Sec. 5.2, Eq. 25",
            "the split cosine bell leaves 80 % of the length as it is",
            f"the window of power_spectrum, as spectra of {_POINTS} maps of one peak each show it: "
            "80 % within 1 %; Eq. 25 at every point within 1e-9",
            f"{100 * kept:.1f} % a direction, {100 * kept**2:.1f} % of a map; off Eq. 25 by at "
            f"most {np.abs(bell - split_cosine_bell(_POINTS)).max():.0e}",
            by_construction(
                [
                    abs(kept - 0.8) < 0.01,
                    np.allclose(bell, split_cosine_bell(_POINTS), rtol=0, atol=1e-9),
                ]
            ),
            "the default window is made by Eq. 25",
        ),
        Statement(
            "S4",
            "Sec. 5.2",
            "the Hann window harms low frequencies; the split cosine bell suits short signals",
            "between q0 and 2 q0, C scatters more under Hann from scan to scan",
            f"standard deviation of C over the true C: {low['hann']:.2f} Hann, "
            f"{low['split-cosine-bell']:.2f} split cosine bell",
            judged(low["hann"] > low["split-cosine-bell"]),
            f"{len(inputs.asphalt_scans)} asphalt scans of {_SHORT} x {_SHORT} lambda0",
        ),
        Statement(
            "S5",
            "Eqs 26-27",
            "Eqs 25 to 27 give the spectrum of the surface",
            "the variance of C within 5 % of that of the heights, mean of the asphalt scans",
            f"{level:.3f} of it, with a window whose mean square is {lost:.3f}",
            judged(bool(abs(level - 1) < 0.05)),
            "nothing divides by the window's mean square; H does not notice, area and friction do",
        ),
        Statement(
            "S6",
            "Sec. 5.2",
            "up to 10 % of the points may be filled by linear interpolation",
            "rms height within 1 % and H within 0.01 after 10 % of random drop-outs are filled",
            f"rms height {percent(filled.rms_height / scan.rms_height - 1)}, H {patched:.4f} "
            f"against {whole:.4f}; {100 * holes:.1f} % missing",
            judged(
                [
                    abs(filled.rms_height / scan.rms_height - 1) < 0.01,
                    abs(patched - whole) < 0.01,
                ]
            ),
            "filled points are smooth: the short waves lose, the rms height does not notice",
        ),
    ]


def _fits(inputs: Inputs, spectra: Sequence[Spectra]) -> list[Statement]:
    found = [spectrum.fit.hurst for spectrum in spectra]
    truth = [spectrum.truth.hurst for spectrum in spectra]
    equal = [
        SelfAffineSpectrum(rms_height=1e-4, hurst=h, q0=Q0, q1=inputs.sandpaper.q1).rms_slope
        for h in truth
    ]
    own = [inputs.sandpaper.rms_slope, inputs.asphalt.rms_slope]
    return [
        Statement(
            "S7",
            "Eq. 28, Fig. 7",
            f"H = |slope| / 2 - 1: {truth[0]:g} of the sandpaper, {truth[1]:g} of the asphalt",
            "within 0.02 on scans that are synthesized with these H",
            f"H = {listed(found, '.3f')}",
            by_construction(abs(h - put) < 0.02 for h, put in zip(found, truth, strict=True)),
            "the scans were given these H: checks the way to H; measured surfaces are not at hand",
        ),
        Statement(
            "S8",
            "Sec. 5.2",
            "a smaller H means a more irregular topography",
            "at equal rms height, q0 and q1 the rms slope is larger with "
            f"H {truth[0]:g} than with {truth[1]:g}",
            f"rms slope x {equal[0] / equal[1]:.3g}; of the surfaces themselves "
            f"{listed(own)}: the asphalt is steeper, being higher",
            judged(equal[0] > equal[1]),
            "more of the roughness is short",
        ),
        unchecked(
            "S9",
            "Sec. 1, 5.2, Fig. 7",
            "sandpaper and asphalt are self-affine over several decades, from about 2000 1/m",
            "the measured spectra are not at hand; the surfaces here are self-affine by synthesis",
            f"scans of {SIDE} lambda0 and {PIXELS} pixels show {np.log10(PIXELS / 2 / SIDE):.1f} "
            "decades of it",
        ),
    ]


def split_cosine_bell(points: int) -> _Array:
    """Eq. 25, at n = 0 ... N - 1."""
    n = np.arange(points) / points
    edge = np.minimum(n, 1 - n)
    return np.asarray(np.where(edge < 0.1, np.sin(5 * np.pi * edge) ** 2, 1.0))


def packaged_bell(points: int) -> _Array:
    """The default window of `power_spectrum` over one side, at most 1.

    The spectrum of a map with one peak has the window's square there as its variance.
    """
    variance = np.zeros(points)
    for row in range(points):
        heights = np.zeros((points, 2))
        heights[row, 1] = PIXEL_SIZE
        found = power_spectrum(HeightMap(heights, pixel_size=PIXEL_SIZE), detrend=None)
        variance[row] = np.sum(found.density * np.asarray(found.count))
    return np.asarray(np.sqrt(variance / variance.max()))


def printed_variance(scan: HeightMap) -> float:
    """Sum of Eq. 27's C over all modes, with Eqs 25 and 26 as printed, over the mean square height.

    The printed sums run to N, where a periodic window and map are at 0 again: N points a side.
    """
    z = scan.heights - scan.heights.mean()
    length, points = PIXEL_SIZE * z.shape[0], z.shape[0]
    bell = split_cosine_bell(points)
    modes = (length / (2 * np.pi * points)) ** 2 * np.fft.fft2(np.outer(bell, bell) * z)
    density = (2 * np.pi / length) ** 2 * np.abs(modes) ** 2
    return float(np.sum(density) * (2 * np.pi / length) ** 2 / np.mean(z**2))


def _windows(inputs: Inputs) -> tuple[dict[str, float], dict[str, float]]:
    """On short scans, by window: scatter of C between q0 and 2 q0, and mean H."""
    scatter, hurst = {}, {}
    for window in ("split-cosine-bell", "hann", "none"):
        levels, exponents = [], []
        for scan in inputs.asphalt_scans:
            found = power_spectrum(cut(scan, _SHORT), window=window)
            q = found.wavenumber
            low = (q > Q0) & (q < 2 * Q0)
            levels.append(np.mean(found.density[low] / inputs.asphalt.at(q[low])))
            exponents.append(slope_fit(found).hurst)
        scatter[window] = float(np.std(levels, ddof=1))
        hurst[window] = float(np.mean(exponents))
    return scatter, hurst


def _dropouts(scan: HeightMap) -> tuple[HeightMap, float]:
    missing = np.random.default_rng(1).random(scan.heights.shape) < 0.0995
    holed = HeightMap(np.where(missing, np.nan, scan.heights), pixel_size=PIXEL_SIZE)
    return holed.fill_dropouts(), holed.dropout_fraction
