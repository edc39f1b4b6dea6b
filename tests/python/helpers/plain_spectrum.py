"""The spectrum of a map by NumPy's transform over the full plane."""

import numpy as np


def profile(window, n):
    x = np.arange(n) / n
    if window == "hann":
        return np.sin(np.pi * x) ** 2
    if window == "blackman":
        return 0.42 - 0.5 * np.cos(2 * np.pi * x) + 0.08 * np.cos(4 * np.pi * x)
    if window == "split-cosine-bell":  # Eq. 25
        return np.where((x < 0.1) | (x > 0.9), np.cos(5 * np.pi * x - np.pi / 2) ** 2, 1.0)
    return np.ones(n)


def detrended(z, detrend):
    v, u = (np.linspace(-1, 1, n) for n in z.shape)
    v, u = np.meshgrid(v, u, indexing="ij")
    terms = {"offset": [1 + 0 * u], "plane": [1 + 0 * u, u, v]}
    terms["quadratic"] = [*terms["plane"], u * u, u * v, v * v]
    if detrend is None:
        return z
    matrix = np.stack(terms[detrend], axis=-1).reshape(z.size, -1)
    return z - (matrix @ np.linalg.lstsq(matrix, z.ravel(), rcond=None)[0]).reshape(z.shape)


def modes(shape, pixel):
    """|q| of every mode of the full plane, and the index of its ring."""
    qy, qx = (2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(shape, pixel, strict=True))
    q = np.hypot(qy[:, None], qx)
    dq = 2 * np.pi / max(n * d for n, d in zip(shape, pixel, strict=True))
    return q, np.floor(q / dq + 0.5).astype(int)


def plain(z, pixel, window, detrend):
    """q, C and count of every ring, by NumPy's transform over the full plane (Eqs 25-27)."""
    w = np.outer(profile(window, z.shape[0]), profile(window, z.shape[1]))
    area = z.size * pixel[0] * pixel[1]
    power = np.abs(np.fft.fft2(detrended(z, detrend) * w)) ** 2 / z.size**2
    c = power * area / (2 * np.pi) ** 2 / (w**2).mean()
    q, ring = modes(z.shape, pixel)
    count = np.bincount(ring.ravel())
    with np.errstate(invalid="ignore"):
        columns = [np.bincount(ring.ravel(), values.ravel()) / count for values in (q, c)]
    kept = (count > 0) & (np.arange(len(count)) > 0)
    return columns[0][kept], columns[1][kept], count[kept]
