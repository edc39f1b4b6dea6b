"""Sections 3.1 and 6.1.1 checked: local peaks and the p_T1 that follows from them (Eq. 13)."""

from collections import defaultdict

import numpy as np

from asperity.correction import LocalPeaks
from asperity.surface import HeightMap, LineScan
from asperity_scripts.article.inputs import LAMBDA0, PIXEL_SIZE, PIXELS, SIDE, SKEWNESS, Inputs
from asperity_scripts.article.readings import Array
from asperity_scripts.article.statement import Finding, Findings

_DISTANCES = (2.0, 1.0, 0.75, 0.5, 0.25)  # smallest between peaks [lambda0]
_LINES = 64  # rows of a map that are taken as line scans
_TOLERANCE = 0.1  # of what is "about" a printed number, as in P5 and G10


def local_peaks(scan: HeightMap, distance: float) -> LocalPeaks:
    """Peaks no closer than `distance` in lambda0."""
    return LocalPeaks(scan, min_distance=distance * LAMBDA0)


def located(scan: HeightMap, distance: float) -> tuple[Array, Array, LocalPeaks]:
    """Where the peaks are, x and y [m], and the peaks; `distance` in lambda0."""
    peaks = local_peaks(scan, distance)
    above = scan.heights - scan.heights.mean()
    order = np.argsort(above, axis=None)
    nearest = np.searchsorted(above.ravel()[order], peaks.heights - 1e-15)
    y, x = np.unravel_index(order[nearest], above.shape)
    return PIXEL_SIZE * x.astype(float), PIXEL_SIZE * y.astype(float), peaks


def findings(inputs: Inputs) -> Findings:
    """Sections 3.1, 6.1.1 and 7 on scans with and without skewness."""
    findings: dict[str, dict[str, Finding]] = defaultdict(dict)
    lattice = 2 / np.sqrt(3)
    for skewness, scans in ((SKEWNESS, inputs.scans), (0.0, inputs.gaussian_scans)):
        peaks = [[local_peaks(scan, distance) for distance in _DISTANCES] for scan in scans]
        p = np.array([[each.shift_factor for each in row] for row in peaks])
        density = np.array([[each.heights.size / SIDE**2 for each in row] for row in peaks])
        mean, count = p.mean(axis=0), density.mean(axis=0)
        widest, wide, _, narrow, narrowest = mean
        larger, lines = (np.diff(p) < 0).all(axis=1), np.array([_of_lines(scan) for scan in scans])
        scatter = [f"{x.mean():.2f} ± {x.std(ddof=1):.2f}" for x in (*p.T, *lines.T)]
        name, crossing = f"skewness {skewness:g}", np.interp(2.0, mean[::-1], _DISTANCES[::-1])
        findings["P2"][name] = Finding(
            abs(wide / 2.5 - 1) < _TOLERANCE, p=scatter[1], lines=scatter[-2:], scans=len(scans)
        )
        findings["P3"][name] = Finding(
            abs(narrow / 2 - 1) < _TOLERANCE, p=scatter[3], middle=scatter[2], scans=len(scans)
        )
        more = np.diff(density).min() > 0, larger.all()
        findings["P4"][name] = Finding(
            more, mean=mean, count=count, larger=larger.sum(), scans=larger.size
        )
        matched = narrowest < 2 < widest, wide < (1 + _TOLERANCE) * narrow
        change = 100 * (wide / narrow - 1)
        findings["P5"][name] = Finding(matched, distance=crossing, change=change)
        findings["P7"][name] = Finding(
            abs(count[1] / lattice - 1) < 0.2, count=count[1], lattice=lattice, narrow=count[3]
        )
    return findings


def _of_lines(scan: HeightMap) -> Array:
    """Mean p_T1 of rows, as line scans, at lambda0 and at lambda0 / 2."""
    factors = []
    for row in scan.heights[:: PIXELS // _LINES]:
        line = LineScan(row, spacing=PIXEL_SIZE)
        for distance in (LAMBDA0, LAMBDA0 / 2):
            mean = line.local_peaks(min_distance=distance).mean()
            factors.append(line.z_max / (line.z_max - mean))
    return np.asarray(np.array(factors).reshape(-1, 2).mean(axis=0))
