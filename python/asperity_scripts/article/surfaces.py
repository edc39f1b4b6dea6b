"""Eq. 12 and Section 5.2 checked: scans, windows, spectra; Figs 2, 3, 6 and 7."""

from typing import Any

import numpy as np

from asperity.draw.figure import new_figure
from asperity.draw.style import grey, narrow, palette
from asperity.measured_spectrum import power_spectrum
from asperity.self_affine_fit import SelfAffineFit, fit_self_affine
from asperity.spectrum import SelfAffineSpectrum, TabulatedSpectrum
from asperity.surface import HeightMap, LineScan
from asperity_scripts.article.inputs import (
    LAMBDA0,
    MAGNIFICATION,
    PIXEL_SIZE,
    PIXELS,
    Q0,
    SIDE,
    Inputs,
)
from asperity_scripts.article.page import (
    LOG,
    asphalt_inputs,
    page,
    panel,
    sandpaper_inputs,
    scan_inputs,
    stacked,
)
from asperity_scripts.article.peaks import local_peaks
from asperity_scripts.article.readings import Array
from asperity_scripts.article.statement import Finding, Findings

_SHORT, _LONG = 4, 12  # sides of scans that are cut out of the periodic maps [lambda0]
_SHIFT = 2.0  # p_T of Fig. 2
_TILT, _OFFSET = 0.02, 1e-3  # of the line scan of Fig. 6: slope, height [m]
# Rows of a fit: clear of lambda0, and of what half of pi / pixel folds back.
_BAND: dict[str, Any] = {"q_min": 1.25 * Q0, "q_max": np.pi / PIXEL_SIZE / 2}


def cut(scan: HeightMap, side: int) -> HeightMap:
    """A corner of a periodic map, which is periodic no more; `side` in lambda0."""
    pixels = side * PIXELS // SIDE
    return HeightMap(scan.heights[:pixels, :pixels], pixel_size=PIXEL_SIZE)


def slope_fit(measured: TabulatedSpectrum) -> SelfAffineFit:
    """Eq. 28: H of a straight line through the rows of the band."""
    return fit_self_affine(measured, **_BAND, method="slope")


def printed_eq12(surface: SelfAffineSpectrum) -> SelfAffineSpectrum:
    return SelfAffineSpectrum.from_article(
        h0=surface.rms_height, hurst=surface.hurst, q0=surface.q0, q1=surface.q1
    )


def findings(inputs: Inputs) -> Findings:
    h0, own = inputs.asphalt.rms_height, (inputs.sandpaper, inputs.asphalt)
    printed = printed_eq12(inputs.asphalt).rms_height
    level = np.mean([printed_variance(scan) for scan in inputs.asphalt_scans])
    steep, flat = (
        SelfAffineSpectrum(rms_height=1e-4, hurst=s.hurst, q0=Q0, q1=s.q1).rms_slope for s in own
    )
    slopes = [surface.rms_slope for surface in own]
    findings = {
        "A4": Finding(abs(printed / h0 - 1) < 0.01, rms=1e6 * printed, share=printed / h0),
        "S1": _sloped(inputs.asphalt_scans[0]),
        "S5": Finding(
            abs(level - 1) < 0.05, level=level, window=np.mean(split_cosine_bell(PIXELS) ** 2) ** 2
        ),
        "S6": _filled(inputs.asphalt_scans[0]),
        "S8": Finding(steep > flat, ratio=steep / flat, own=slopes),
        **_windows(inputs),
    }
    return {name: {"": finding} for name, finding in findings.items()}


def _windows(inputs: Inputs) -> dict[str, Finding]:
    """On short scans, by window: mean H, and the scatter of C between q0 and 2 q0."""
    truth, scatter, hurst = inputs.asphalt, {}, {}
    windows: dict[str, Any] = {"bell": "split-cosine-bell", "hann": "hann", "none": "none"}
    for name, window in windows.items():
        levels, exponents = [], []
        for scan in inputs.asphalt_scans:
            spectrum = power_spectrum(cut(scan, _SHORT), window=window)
            low = (spectrum.wavenumber > Q0) & (spectrum.wavenumber < 2 * Q0)
            levels.append(np.mean(spectrum.density[low] / truth.at(spectrum.wavenumber[low])))
            exponents.append(slope_fit(spectrum).hurst)
        scatter[name], hurst[name] = np.std(levels, ddof=1), np.mean(exponents)
    off = {name: abs(h - truth.hurst) for name, h in hurst.items()}
    held = off["none"] > 0.03, off["hann"] < 0.03, off["bell"] < 0.03
    return {
        "S2": Finding(held, **hurst),
        "S4": Finding(scatter["hann"] > scatter["bell"], **scatter),
    }


def _sloped(scan: HeightMap) -> Finding:
    """With a slope that is added, and with it removed."""
    tilted = HeightMap(scan.heights + 0.02 * np.arange(PIXELS) * PIXEL_SIZE, pixel_size=PIXEL_SIZE)
    flat, tilt = tilted.detrend("plane"), tilted.detrend("offset").rms_height
    wrong, right = (slope_fit(power_spectrum(s, detrend="offset")).hurst for s in (tilted, flat))
    return Finding(
        abs(tilt / flat.rms_height - 1) > 0.05 or abs(wrong / right - 1) > 0.05,
        rms=[1e6 * tilt, 1e6 * flat.rms_height],
        hurst=[wrong, right],
    )


def _filled(scan: HeightMap) -> Finding:
    """With drop-outs that are made, and filled."""
    missing = np.random.default_rng(1).random(scan.heights.shape) < 0.0995
    holed = HeightMap(np.where(missing, np.nan, scan.heights), pixel_size=PIXEL_SIZE)
    filled = holed.fill_dropouts()
    hurst = [slope_fit(power_spectrum(s)).hurst for s in (filled, scan)]
    change, share = filled.rms_height / scan.rms_height - 1, 100 * holed.dropout_fraction
    held = abs(change) < 0.01, abs(hurst[0] - hurst[1]) < 0.01
    return Finding(held, change=change, hurst=hurst, share=share)


def split_cosine_bell(points: int) -> Array:
    """Eq. 25, at n = 0 ... N - 1."""
    n = np.arange(points) / points
    edge = np.minimum(n, 1 - n)
    return np.asarray(np.where(edge < 0.1, np.sin(5 * np.pi * edge) ** 2, 1.0))


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


def fig02(inputs: Inputs) -> dict[str, bytes]:
    """A sinusoid of the sandpaper's rms height, in full contact and shifted to partial contact."""
    figure, panels = new_figure(2)
    x = np.linspace(0, 2 * LAMBDA0, 401)
    h = np.sqrt(2) * inputs.sandpaper.rms_height * np.cos(Q0 * x)
    shifted = (h - h.max()) / _SHIFT + h.max()
    mm, um, top = 1e3 * x, 1e6 * h, 1e6 * h.max()
    for axes, rubber, p, title in (
        (panels[0], 1e6 * h, 1.0, "(a) full contact, $p_T$ = 1"),
        (panels[1], 1e6 * shifted, _SHIFT, f"(b) partial contact, $p_T$ = {_SHIFT:g}"),
    ):
        axes.fill_between(
            mm, rubber, 200, color=palette()[5], alpha=0.35, linewidth=0, label="rubber"
        )
        axes.fill_between(mm, -150, um, color=grey(0.75), linewidth=0, label="substrate")
        axes.plot(mm, um, color=grey(0.3), linewidth=1.2, label="$h(x)$")
        axes.plot(mm, rubber, color=palette()[0], linewidth=1.8, label="$h_T(x)$")
        axes.axhline(top, color=palette()[1], linestyle=":", label=r"$z_{\mathrm{max}}$")
        mean, label = 1e6 * h.max() * (1 - 1 / p), r"$\langle h_T \rangle$"
        axes.axhline(mean, color=palette()[2], linestyle="--", label=label)
        limits = {"xlim": (0, mm[-1]), "ylim": (-150, 200)}
        panel(axes, title, **limits, xlabel="$x$ [mm]", ylabel="Height $z$ [µm]")
    named = panels[0].get_legend_handles_labels()
    beside: dict[str, Any] = {"loc": "outside right center"}
    below: dict[str, Any] = {"loc": "outside lower center", "ncols": 3}
    figure.legend(*named, fontsize="small", **(below if narrow() else beside))
    columns = {"x_m": x.tolist(), "height_m": h.tolist(), "transformed_height_m": shifted.tolist()}
    facts = {"rms_height_m": inputs.sandpaper.rms_height, "q0_per_m": Q0, "shift_factor": _SHIFT}
    note = "the gap between h and h_T in (b) is where the rubber does not reach"
    return page("fig02", figure, facts, columns, note)


def fig03(inputs: Inputs) -> dict[str, bytes]:
    """A profile through the highest point of the scan, with heights and peaks of the whole scan."""
    scan = inputs.scans[0]
    figure, (left, right) = new_figure(2)
    above = scan.heights - scan.heights.mean()
    row = above[np.unravel_index(above.argmax(), above.shape)[0]]
    x = np.arange(PIXELS) * PIXEL_SIZE
    edges, density = scan.height_histogram(bins=60)
    middle = (edges[1:] + edges[:-1]) / 2
    peaks = local_peaks(scan, 1.0).heights
    counts, peak_edges = np.histogram(peaks, bins=12, density=True)
    peak_middle = (peak_edges[1:] + peak_edges[:-1]) / 2
    left.plot(1e3 * x, 1e6 * row, color=grey(0.3), linewidth=0.6)
    right.plot(1e-3 * density, 1e6 * middle, color=palette()[0], label="heights")
    right.stairs(
        1e-3 * counts,
        1e6 * peak_edges,
        orientation="horizontal",
        color=palette()[1],
        linewidth=1.5,
        label=r"local peaks, $\lambda_0$ apart",
    )
    mean, label = 1e6 * peaks.mean(), r"$\langle h_{\mathrm{Peaks}} \rangle$"
    for axes in (left, right):
        axes.axhline(mean, color=palette()[1], linestyle="--", label=label)
    height = {"ylabel": "Height $z$ [µm]", "ylim": (1.08e6 * scan.z_min, 1.15e6 * scan.z_max)}
    panel(left, "(a) profile", xlim=(0, 1e3 * x[-1]), xlabel="$x$ [mm]", **height)
    right.set_xlim(left=0)
    label = "Probability density [1/mm]"
    panel(right, "(b) distributions, whole scan", "lower right", xlabel=label, **height)
    columns = stacked(
        [
            {"curve": "profile", "x_m": x, "height_m": row},
            {"curve": "heights", "height_m": middle, "density_per_m": density},
            {"curve": "peaks", "height_m": peak_middle, "density_per_m": counts},
        ]
    )
    facts = {
        **sandpaper_inputs(inputs),
        **scan_inputs(),
        "min_distance_m": LAMBDA0,
        "mean_peak_height_m": float(peaks.mean()),
    }
    return page("fig03", figure, facts, columns)


def fig06(inputs: Inputs) -> dict[str, bytes]:
    """A line scan of the asphalt with a slope and an offset that we add, and without them."""
    figure, panels = new_figure(2)
    row = np.asarray(inputs.asphalt_scans[0].heights[0], dtype=float)
    x = np.arange(PIXELS) * PIXEL_SIZE
    raw = row + _OFFSET + _TILT * x
    flat = np.asarray(LineScan(raw, spacing=PIXEL_SIZE).detrend("plane").heights)
    titles = ("(a) with slope and offset", "(b) slope and offset suppressed")
    for axes, heights, title in zip(panels, (raw, flat), titles, strict=True):
        axes.plot(1e3 * x, 1e3 * heights, color=palette()[0], linewidth=0.7)
        axes.axhline(0, color=grey(0.5), linewidth=0.8)
        length = 1e3 * x[-1]
        panel(axes, title, xlim=(0, length), xlabel="$x$ [mm]", ylabel="Height $z$ [mm]")
    columns = {"x_m": x.tolist(), "height_m": raw.tolist(), "detrended_height_m": flat.tolist()}
    facts = {
        **asphalt_inputs(inputs),
        **scan_inputs(0.0),
        "slope": _TILT,
        "offset_m": _OFFSET,
    }
    return page("fig06", figure, facts, columns, "slope and offset are added to a synthetic scan")


def fig07(inputs: Inputs) -> dict[str, bytes]:
    """Spectra of synthetic scans of both surfaces, with Eq. 28's lines."""
    figure, panels = new_figure(2)
    curves, facts = [], {**scan_inputs(), "skewness": "sandpaper as given, asphalt 0"}
    surfaces = (
        ("120-grit sandpaper", inputs.sandpaper, inputs.scans[0]),
        ("asphalt", inputs.asphalt, inputs.asphalt_scans[0]),
    )
    for axes, (name, truth, scan), mark in zip(panels, surfaces, "ab", strict=True):
        measured = power_spectrum(cut(scan, _LONG))
        fit, q, density = slope_fit(measured), measured.wavenumber, measured.density
        shown, good = q <= np.pi / PIXEL_SIZE, measured.reliable & (q >= Q0)
        for rows, colour, label in (
            (good, palette()[0], "synthetic scan"),
            (shown & ~good, grey(0.7), "unreliable or below $q_0$"),
        ):
            axes.plot(q[rows], density[rows], ".", markersize=3, color=colour, label=label)
        whole = np.geomspace(Q0, MAGNIFICATION * Q0, 50)
        axes.plot(whole, truth.at(whole), color=grey(0.2), linewidth=1, label="analytic, to $q_1$")
        line = np.geomspace(fit.q0, fit.q1, 50)
        label = f"Eq. 28: $H$ = {fit.hurst:.3f}"
        axes.plot(line, fit.spectrum.at(line), "--", color=palette()[1], linewidth=2, label=label)
        axes.axvline(Q0, color=grey(0.5), linestyle=":", label="$q_0$ = 2000/m")
        labels = {"xlabel": "Wavenumber $q$ [1/m]", "ylabel": "Roughness spectrum $C(q)$ [m$^4$]"}
        panel(axes, f"({mark}) {name}", "upper right", **LOG, **labels)
        curves.append(
            {
                "surface": name,
                "wavenumber_per_m": q[shown],
                "density_m4": density[shown],
                "standard_error_m4": np.asarray(measured.standard_error)[shown],
                "reliable": measured.reliable[shown].astype(int),
                "synthesized_density_m4": [
                    float(truth.at(k)) if k >= Q0 else 0.0 for k in q[shown]
                ],
            }
        )
        facts[f"hurst_{name}"] = fit.hurst
    facts |= {f"rms_height_m_{name}": truth.rms_height for name, truth, _ in surfaces}
    return page("fig07", figure, facts, stacked(curves))
