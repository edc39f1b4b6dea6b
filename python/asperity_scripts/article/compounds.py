"""Surrogates of the article's two SBR compounds, of which only T_g is published."""

import numpy as np

from asperity.rubber import PronySeries

T_G = {"A": -32.0, "B": -21.7}  # [C], Section 5.1
ROOM = 20.0  # [C]: the article says "room temperature" of v0
POISSON_RATIO = 0.5
# Universal constants about T_g (M. L. Williams, R. F. Landel, J. D. Ferry, J. Am. Chem. Soc. 77,
# 3701 (1955)).
C1, C2 = 17.44, 51.6  # -, K
GLASS_TIME = 100.0  # s, relaxation time at T_g (C. A. Angell, J. Non-Cryst. Solids 131, 13 (1991))
# Not measured: of the size usual for a filled tread compound at small strain.
EQUILIBRIUM_MODULUS = 5e6  # Pa
GLASSY_MODULUS = 2.5e9  # Pa
FILLER_MODULUS = 0.5e6  # Pa a decade of time, above GLASS_TIME
TERMS = 24  # two a decade, from 1e-3 GLASS_TIME


def log10_a_t(temperature: float, t_g: float) -> float:
    """log10 of the shift factor from T_g to `temperature` [C], by WLF."""
    return -C1 * (temperature - t_g) / (C2 + temperature - t_g)


def temperature_of(decades: float, t_g: float) -> float:
    """[C] at which relaxation is `decades` slower than at room temperature, by WLF."""
    total = log10_a_t(ROOM, t_g) + decades
    return t_g - C2 * total / (C1 + total)


def compound(t_g: float, temperature: float = ROOM) -> PronySeries:
    """Master curve at `temperature` [C] of a filled rubber with the glass transition `t_g` [C].

    Moduli about GLASS_TIME as 1 / (x^(1/2) + x^(-1/2)), x = tau / GLASS_TIME: Rouse's tau^(-1/2) on
    the side of the rubber (P. E. Rouse, J. Chem. Phys. 21, 1272 (1953)), as broad on that of the
    glass; a constant for the filler; all times moved by WLF.
    """
    decade = 0.5 * np.arange(TERMS) - 3.0  # log10 of x
    weight = 1 / (10 ** (decade / 2) + 10 ** (-decade / 2))
    moduli = (GLASSY_MODULUS - EQUILIBRIUM_MODULUS) * weight / weight.sum()
    moduli += np.where(decade >= 0, FILLER_MODULUS / 2, 0.0)
    times = GLASS_TIME * 10 ** (decade + log10_a_t(temperature, t_g))
    return PronySeries(
        equilibrium_modulus=EQUILIBRIUM_MODULUS, moduli=moduli, relaxation_times=times
    )
