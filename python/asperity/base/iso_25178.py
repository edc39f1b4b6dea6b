"""Parameters of ISO 25178-2 of a map, by their names."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.arguments import Array

_PRUNED = 0.05  # of Sz: hills that are less high above their saddles are none (ISO 25178-3)
_MOST = 2**22  # points of a map whose hills are counted
_BESIDE = ((0, 1), (1, 0), (1, 1), (1, -1))  # half of the eight neighbours


def height_parameters(
    rms: float, skewness: float, kurtosis: float, highest: float, lowest: float, slope: float
) -> dict[str, float]:
    """Those that the statistics of heights about their mean plane have already."""
    return {
        "Sq": rms,
        "Ssk": skewness,
        "Sku": kurtosis,
        "Sp": highest,
        "Sv": -lowest,
        "Sz": highest - lowest,
        "Sdq": slope,
    }


def measured_parameters(heights: NDArray[Any], pixel_size: tuple[float, float]) -> dict[str, float]:
    """Sa [m], Sdr [-] and Spd [1/m^2] of a map of up to 2^22 points, all measured."""
    z = np.asarray(heights, dtype=np.float64)
    dy, dx = pixel_size
    parameters = {"Sa": float(np.nanmean(np.abs(z - np.nanmean(z))))}
    if min(z.shape) < 3:
        return parameters
    across = (z[1:-1, 2:] - z[1:-1, :-2]) / (2 * dx)
    along = (z[2:, 1:-1] - z[:-2, 1:-1]) / (2 * dy)
    parameters["Sdr"] = float(np.nanmean(np.sqrt(1 + across**2 + along**2) - 1))
    if z.size <= _MOST and np.isfinite(z).all() and np.ptp(z) > 0:
        area = (z.shape[0] - 1) * dy * (z.shape[1] - 1) * dx
        parameters["Spd"] = _count_hills(z) / area
    return parameters


def _count_hills(z: Array) -> int:
    """Peaks off the edge whose hills are above 5 % of Sz after pruning (G. W. Wolf, 1991).

    Pruning joins the hill that is least above its highest saddle with the one beyond it. So what is
    left are the maxima of which one must come down by that much before going up to a higher one.
    """
    hills, peaks = _hills(z)
    saddles = _saddles(z, hills)
    least = _PRUNED * float(np.ptp(z))
    heights = z.ravel()[peaks]
    parent = np.arange(peaks.size)

    def top(one: int) -> int:
        while parent[one] != one:
            parent[one] = parent[parent[one]]
            one = int(parent[one])
        return one

    kept = np.ones(peaks.size, bool)
    for height, first, second in saddles:  # from the highest down
        a, b = top(int(first)), top(int(second))
        if a == b:
            continue
        low, high = (a, b) if heights[a] < heights[b] else (b, a)
        kept[low] = heights[low] - height >= least
        parent[low] = high
    y, x = np.divmod(peaks, z.shape[1])
    inside = (y > 0) & (y < z.shape[0] - 1) & (x > 0) & (x < z.shape[1] - 1)
    return int(np.count_nonzero(kept & inside))


def _hills(z: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """For each point the hill that leads up from it along the highest neighbours, and the points
    that are the peaks of these hills."""
    ny, nx = z.shape
    rank = np.empty(z.size, np.intp)  # so that no two points are equally high
    rank[np.argsort(z, axis=None, kind="stable")] = np.arange(z.size)
    best, place = rank.reshape(z.shape).copy(), np.arange(z.size).reshape(z.shape)
    up = place.copy()
    for dy, dx in (*_BESIDE, *((-a, -b) for a, b in _BESIDE)):
        here = np.s_[max(0, -dy) : ny - max(0, dy), max(0, -dx) : nx - max(0, dx)]
        there = np.s_[max(0, dy) : ny - max(0, -dy), max(0, dx) : nx - max(0, -dx)]
        beside = rank.reshape(z.shape)[there]
        higher = beside > best[here]
        best[here] = np.where(higher, beside, best[here])
        up[here] = np.where(higher, place[there], up[here])
    flat = up.ravel()
    while not np.array_equal(flat, flat[flat]):
        flat = flat[flat]
    peaks, hills = np.unique(flat, return_inverse=True)
    return hills.reshape(z.shape), peaks


def _saddles(z: Array, hills: NDArray[np.intp]) -> list[tuple[float, int, int]]:
    """The highest pass between each two hills that touch, from the highest down."""
    ny, nx = z.shape
    passes = []
    for dy, dx in _BESIDE:
        here = np.s_[0 : ny - dy, max(0, -dx) : nx - max(0, dx)]
        there = np.s_[dy:ny, max(0, dx) : nx - max(0, -dx)]
        pair = np.sort(np.stack([hills[here].ravel(), hills[there].ravel()]), axis=0)
        height = np.minimum(z[here], z[there]).ravel()
        passes.append(np.stack([height, *pair])[:, pair[0] != pair[1]])
    every = np.concatenate(passes, axis=1)
    every = every[:, np.lexsort(every[::-1])[::-1]]
    first = np.unique(every[1] * z.size + every[2], return_index=True)[1]
    return [(h, int(a), int(b)) for h, a, b in every[:, np.sort(first)].T.tolist()]
