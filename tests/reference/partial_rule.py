"""The rule of PartialContact: sums over nodes at a kappa, and its root by two searches.

With y = ln q, c = q^4 C, K = 1 / (8 ((1 - nu^2) sigma0)^2), G = K int c I2 dy, M = int c dy, c_w
half of the integral of c over [y - 1, y + 1] (c is 0 off the band), ln q_e the mean of y over that
last part of the band that has a tenth of M(q1), c_e = max(c_w(q_e), M(q1) / 20), and rho =
K I2(v q_e) M(q1) / G(q1):
  A = erf(1 / (2 sqrt(kappa G))), A1 = A(q1), R = A / (1 + Z)^2,
  Z = OBSTACLE (4 c_e / M(q1))^0.2 kappa^(1/4) (1 - A1)^(1/8) (1 + LIGHT (1 - A1^(1/10))^3)
      A^2 K I2 c_w,
  T = EDGES A1 (1 - A1^(1/4)) max(1, 0.1 / rho) K c_e I2(v q_e) (I2(v q) / I2(v q_e))^1.25
      x^-3, x = q / q_e from 1 to 33,
  2 (int R dG + int T dln x) = m (1 + (SPREAD A1 + STIFF max(0, 1 - 1 / rho)^4) (1 - A1^8)) with
  m = (1 + 2 g) erf(s) + 2 sqrt(g / pi) exp(-s^2) - 1, g = kappa G(q1), s = 1 / (2 sqrt g): the
  variance of Persson's pressure over sigma0^2. This fixes kappa, and
  mu_H = 4 (1 - nu^2) sigma0 (int (I1 / I2) R dG + int (I1 / I2) T dln x).
"""

import numpy as np
from scipy.optimize import brentq
from scipy.special import erf, erfc

OBSTACLE, LIGHT, EDGES, SPREAD, STIFF = 0.67, 6.3, 3.55, 0.105, 0.45
TAIL_END = 33.0


def sums(kappa, nodes, tail):
    """Return int R dG + int T dln x, over the factor of m, and the same with I1 / I2."""
    g, weights, steepness, ratio, g1, end, excess = nodes
    s = 0.5 / np.sqrt(kappa * g1)
    rest, share1 = erfc(s), erf(s)
    share = erf(0.5 / np.sqrt(kappa * np.maximum(g, 1e-300)))
    log_share = np.log1p(-rest) if rest < 0.5 else np.log(share1)
    tenth, fourth, eighth = (-np.expm1(p * log_share) for p in (0.1, 0.25, 8))
    obstacle = OBSTACLE * end**0.2 * kappa**0.25 * rest**0.125 * (1 + LIGHT * tenth**3)
    stress = share / (1 + obstacle * share**2 * steepness) ** 2 * weights
    edges = EDGES * share1 * fourth * max(1.0, 0.1 * (1 - excess))
    factor = 1 + (SPREAD * share1 + STIFF * max(0.0, excess) ** 4) * eighth
    return (stress.sum() + edges * tail[0]) / factor, (stress * ratio).sum() + edges * tail[1]


def variance(g):
    """Return half the variance of Persson's pressure over sigma0^2."""
    s = 0.5 / np.sqrt(g)
    most = g * erf(s) if s < 1 else g - g * erfc(s)
    return most - erfc(s) / 2 + np.sqrt(g / np.pi) * np.exp(-s * s)


def by_kappa(nodes, tail):
    """Return kappa, searched for in its logarithm."""
    g1 = nodes[4]

    def miss(x):
        return np.log(variance(np.exp(x) * g1) / sums(np.exp(x), nodes, tail)[0])

    return np.exp(brentq(miss, -5, 5, xtol=1e-14))


def by_inverse(nodes, tail):
    """Return kappa, searched for in s = 1 / (2 sqrt(kappa G1)); 1 where A1 = erf(s) is 1."""
    g1 = nodes[4]
    usual = 0.5 / np.sqrt(g1)
    if erfc(usual / 1.5) < 1e-30:
        return 1.0

    def miss(s):
        g = 0.25 / s**2
        moment = (1 + 2 * g) * erf(s) + 2 * np.sqrt(g / np.pi) * np.exp(-s * s) - 1
        return moment / 2 - sums(g / g1, nodes, tail)[0]

    return 0.25 / brentq(miss, usual / 3, 3 * usual, xtol=1e-15 * usual, rtol=1e-15) ** 2 / g1
