"""Gaussian surfaces whose C(q) is known, by NumPy's transform of white noise, and what spoils them.

A white map of n points has <|h(q)|^2> = 1 / n; C = A / (2 pi)^2 <|h(q)|^2> after Eqs 25-27.
"""

import numpy as np


def law(hurst, *, rolloff=0.0, level=1e-26):
    """C(q) = level (max(q, rolloff) / 1e5)^(-2 (H + 1)) [m^4]."""
    return lambda q: level * (np.maximum(q, rolloff) / 1e5) ** (-2 * (hurst + 1))


def surface(density, shape, pixel, seed, *, dtype=np.float64, stretch=1.0):
    """A crop of a map that is a fifth longer either way: it does not repeat.

    `stretch` makes q_y count as many times: C then depends on the direction, and its mean over a
    ring is `ring_mean(density, stretch)`.
    """
    dy, dx = np.broadcast_to(pixel, 2)
    ny, nx = (length(n + n // 5) for n in shape)
    rng = np.random.default_rng(seed)
    modes = np.fft.rfft2(rng.standard_normal((ny, nx), dtype=dtype))
    q = np.hypot(
        (2 * np.pi * stretch * np.fft.fftfreq(ny, dy))[:, None], 2 * np.pi * np.fft.rfftfreq(nx, dx)
    )
    q[0, 0] = np.inf
    power = density(q) * (2 * np.pi) ** 2 / (dy * dx)  # over A / n, the area of a pixel
    modes *= np.sqrt(power)
    return np.fft.irfft2(modes, s=(ny, nx))[: shape[0], : shape[1]].astype(dtype)


def length(n):
    """The next number that has no factors but 2, 3 and 5."""
    while True:
        rest = n
        for factor in (2, 3, 5):
            while rest % factor == 0:
                rest //= factor
        if rest == 1:
            return n
        n += 1


def ring_mean(density, stretch):
    """The mean of C over the directions of a ring."""
    angle = (np.arange(180) + 0.5) * np.pi / 360
    factor = np.hypot(stretch * np.sin(angle), np.cos(angle))
    return lambda q: density(np.multiply.outer(q, factor)).mean(axis=-1)


def tilted(heights, *, tilt, bow=0.0):
    """The same with heights added that rise by `tilt` and bend by `bow` across the map [m]."""
    v, u = (np.linspace(-1, 1, n) for n in heights.shape)
    return (heights + tilt * (v[:, None] + u) + bow * (v[:, None] ** 2 + u * u)).astype(
        heights.dtype
    )


def with_holes(heights, share, seed, *, blob=1):
    """The same with about that share of the points missing, in squares of `blob` points."""
    rng = np.random.default_rng(seed)
    ny, nx = (-(-n // blob) for n in heights.shape)
    missing = np.kron(rng.random((ny, nx)) < share, np.ones((blob, blob), bool))
    return np.where(missing[: heights.shape[0], : heights.shape[1]], np.nan, heights)
