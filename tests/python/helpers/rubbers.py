"""Series of terms, and a synthetic rubber whose truth is a formula, with its isotherms."""

import numpy as np

from asperity import Heating, Isotherm, MasterCurve, PronySeries, build_master_curve

T_REF = 293.15
TEMPERATURES = np.arange(-30, 78, 5) + 273.15  # 22
SWEEP = 2 * np.pi * np.geomspace(0.1, 30, 16)  # [rad/s]


def prony(equilibrium_modulus, moduli, relaxation_times):
    return PronySeries(
        equilibrium_modulus=equilibrium_modulus, moduli=moduli, relaxation_times=relaxation_times
    )


def tread(**changed):
    """The heat of a tread compound in contacts of a millimetre, with other constants."""
    constants = {"density": 1200.0, "heat_capacity": 1650.0}
    constants |= {"conductivity": 0.23, "contact_diameter": 1e-3}
    return Heating(**{**constants, **changed})


def curve_of(angular_frequency, modulus, **more):
    """The master curve of complex moduli."""
    rows = {"storage_modulus": modulus.real, "loss_modulus": modulus.imag}
    return MasterCurve(angular_frequency=angular_frequency, **rows, **more)


def true_modulus(w):
    """Like SBR: a glass transition of 2 GPa (Cole-Cole), a slow process, 3 MPa at rest."""
    glass = 2e9 / (1 + (1j * w * 1e-7) ** -0.45)
    return 3e6 + glass + 5e6 / (1 + (1j * w * 1e-2) ** -0.3)


def true_shift(temperature):
    """Return log10 a_T, WLF about 20 C."""
    d = np.asarray(temperature) - T_REF
    return -8.86 * d / (101.6 + d)


def sweeps(temperatures=TEMPERATURES, *, noise=0.0, seed=0, frequency=SWEEP, change=None, b_t=None):
    """Isotherms of the rubber; `change(temperature, modulus)` spoils them, b_t(T) scales them."""
    rng = np.random.default_rng(seed)
    result = []
    for t in temperatures:
        modulus = true_modulus(frequency * 10 ** true_shift(t)) * (1 if b_t is None else b_t(t))
        if change is not None:
            modulus = change(t, modulus)
        scatter = np.exp(noise * rng.standard_normal((2, frequency.size)))
        isotherm = Isotherm(
            temperature=t,
            angular_frequency=frequency,
            storage_modulus=modulus.real * scatter[0],
            loss_modulus=modulus.imag * scatter[1],
        )
        result.append(isotherm)
    return result


def built(isotherms, reference_temperature=T_REF, **options):
    return build_master_curve(isotherms, reference_temperature=reference_temperature, **options)


def worst(build):
    """Largest error of log10 a_T [decades]."""
    return np.abs(build.log10_a_T - true_shift(build.temperature)).max()
