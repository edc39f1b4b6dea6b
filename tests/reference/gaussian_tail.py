"""The 3/2 moment of a Gaussian tail, shared by make_gaussian_moment.py and others."""

import mpmath as mp


def log_moment(t, nodes_per_width=6):
    """Return ln M(t), M(t) = int_t^inf (x - t)^1.5 exp(-x^2 / 2) / sqrt(2 pi) dx.

    With x = t + v^2 it is the integral of v^4 exp(-(t + v^2)^2 / 2) / sqrt(2 pi) over all real v.
    That is even and entire in v, so the trapezoidal rule converges faster than any power of its
    step. Factored by its largest value it neither over- nor underflows.
    """
    t = mp.mpf(t)
    top = 4 / (t + mp.sqrt(t * t + 8)) if t > 0 else (mp.sqrt(t * t + 8) - t) / 2
    width = 1 / mp.sqrt(4 / top + 2 * t + 6 * top)

    def log_integrand(u):
        return 2 * mp.log(u) - (t + u) ** 2 / 2

    step = width / nodes_per_width
    lower = max(1, int(mp.floor((mp.sqrt(top) - 20 * width) / step)))
    upper = int(mp.ceil((mp.sqrt(top) + 20 * width) / step))
    log_top = log_integrand(top)
    total = sum(mp.exp(log_integrand((n * step) ** 2) - log_top) for n in range(lower, upper + 1))
    return mp.log(2 * step * total / mp.sqrt(2 * mp.pi)) + log_top


def log_moment_closed(t):
    """Return ln M(t) from Gamma(5/2) / sqrt(2 pi) exp(-t^2 / 4) U(2, t), THEORY.md section 4."""
    with mp.workdps(2 * mp.mp.dps):
        t = mp.mpf(t)
        value = mp.log(mp.gamma(2.5) / mp.sqrt(2 * mp.pi)) - t * t / 4 + mp.log(mp.pcfu(2, t))
    return +value
