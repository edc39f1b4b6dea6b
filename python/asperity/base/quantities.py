"""Kinds of numbers that a scene can state: their units, and the ranges that these leave plausible.

Outside of `least` to `most` a number is absurd, outside of `low` to `high` it is unusual; every end
has its reason. `asperity.io.plausible` holds numbers against them.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

ZERO_CELSIUS = 273.15  # [K]


def temperature_text(kelvin: float, *, celsius: bool) -> str:
    """A temperature as pictures and notes tell it."""
    return f"{kelvin - ZERO_CELSIUS:.4g} °C" if celsius else f"{kelvin:.5g} K"


@dataclass(frozen=True)
class Limit:
    """An end of a range, in the SI unit, and why it lies there."""

    value: float
    reason: str


@dataclass(frozen=True)
class Quantity:
    """What a number of one kind may be. Its sign does not matter, that of a temperature does."""

    units: Mapping[str, tuple[float, float]]  # SI = factor * number + offset; the SI unit first
    likely: tuple[float, float]  # [SI], where a guess must lead; guesses in the order of `units`
    least: Limit
    most: Limit
    low: Limit | None = None
    high: Limit | None = None

    def to_si(self, number: Any, unit: str) -> Any:
        factor, offset = self.units[unit]
        return factor * number + offset

    def of_si(self, number: Any, unit: str) -> Any:
        factor, offset = self.units[unit]
        return (number - offset) / factor

    def size(self, number: Any, unit: str) -> Any:
        """What is held against the limits [SI]."""
        si = self.to_si(number, unit)
        return si if self.units is TEMPERATURE_UNITS else abs(si)


def _factors(**units: float) -> dict[str, tuple[float, float]]:
    return {name.replace("per_", "1/"): (factor, 0.0) for name, factor in units.items()}


LENGTH_UNITS = _factors(m=1.0, um=1e-6, mm=1e-3, nm=1e-9, pm=1e-12)
WAVENUMBER_UNITS = _factors(per_m=1.0, per_mm=1e3, per_um=1e6, per_nm=1e9)
SPEED_UNITS = {"m/s": (1.0, 0.0), "km/h": (1 / 3.6, 0.0), "mm/s": (1e-3, 0.0), "um/s": (1e-6, 0.0)}
PRESSURE_UNITS = _factors(Pa=1.0, MPa=1e6, bar=1e5, kPa=1e3, GPa=1e9)
MODULUS_UNITS = _factors(Pa=1.0, MPa=1e6, GPa=1e9, kPa=1e3)
TEMPERATURE_UNITS = {"K": (1.0, 0.0), "C": (1.0, ZERO_CELSIUS)}
FREQUENCY_UNITS = {"rad/s": (1.0, 0.0), "Hz": (2 * math.pi, 0.0)}
STRAIN_UNITS = {"1": (1.0, 0.0), "%": (0.01, 0.0)}
NUMBER_UNITS = {"": (1.0, 0.0)}

# Amplitudes of road texture: PIARC, XVIIIth World Road Congress 1987, Report of the technical
# committee on surface characteristics: up to 20 mm at wavelengths below 50 mm (macrotexture), up to
# 50 mm below 0.5 m (megatexture).
RMS_HEIGHT = Quantity(
    LENGTH_UNITS,
    likely=(1e-9, 1e-2),
    least=Limit(1e-12, "a hundredth of an atom"),
    low=Limit(1e-10, "the size of an atom"),
    high=Limit(0.1, "the texture of a road has at most centimetres"),
    most=Limit(1.0, "no road or stone is so rough"),
)
HEIGHT = Quantity(
    LENGTH_UNITS,
    likely=(1e-9, 3e-2),
    least=Limit(1e-15, "the size of a nucleus"),
    high=Limit(0.5, "the texture of a road has at most centimetres"),
    most=Limit(5.0, "no road or stone is so rough"),
)
# Sampling distances run from the picometres of tunnelling microscopes to the decimetres of a
# vehicle that measures unevenness (ISO 13473-5 ends megatexture at 0.5 m).
SPACING = Quantity(
    LENGTH_UNITS,
    likely=(1e-10, 1e-2),
    least=Limit(1e-12, "a hundredth of an atom"),
    high=Limit(0.1, "texture that rubber feels is finer; give the true one"),
    most=Limit(1.0, "texture that rubber feels is finer; give the true one"),
)
PARTICLE = Quantity(
    LENGTH_UNITS,
    likely=(1e-8, 1e-3),
    least=Limit(1e-10, "the size of an atom"),
    high=Limit(1e-2, "dust and wear particles are finer"),
    most=Limit(1.0, "no particle is so large"),
)
FIRST_WAVENUMBER = Quantity(
    WAVENUMBER_UNITS,
    likely=(1e1, 1e8),
    least=Limit(1e-3, "a wavelength of 6 km"),
    low=Limit(0.1, "a wavelength of 60 m; texture ends at 0.5 m"),
    most=Limit(1e11, "a wavelength below that of atoms"),
)
LAST_WAVENUMBER = Quantity(
    WAVENUMBER_UNITS,
    likely=(1e4, 1e10),
    least=Limit(10.0, "a wavelength of 0.6 m, longer than any texture"),
    low=Limit(2e3, "a wavelength of 3 mm; rubber feels finer texture"),
    high=Limit(4e10, "a wavelength of 0.16 nm, the distance of atoms"),
    most=Limit(1e11, "a wavelength below that of atoms"),
)
WAVENUMBER = replace(FIRST_WAVENUMBER, likely=(1e1, 1e10), low=None)  # of no certain end
# At an rms slope of 100 a surface stands at 89.4 degrees; measured ones have up to a few.
SLOPE = Quantity(
    NUMBER_UNITS,
    likely=(0, 0),
    least=Limit(1e-5, "a telescope's mirror is as flat; are the heights in another unit"),
    low=Limit(1e-3, "a mirror is as flat"),
    most=Limit(100.0, "the surface would stand upright; are heights or wavenumbers in other units"),
)
# Creep: plates of the Earth drift by 1e-9 m/s, an atom's diameter in an hour is 1e-13 m/s. Racing
# tyres slide at 100 m/s. Sound in gum rubber: 1550 m/s (CRC Handbook of Chemistry and Physics).
VELOCITY = Quantity(
    SPEED_UNITS,
    likely=(1e-9, 110.0),
    least=Limit(1e-13, "an atom's diameter in an hour"),
    low=Limit(1e-11, "a hundredth of the drift of continents"),
    high=Limit(150.0, "540 km/h"),
    most=Limit(1500.0, "the speed of sound in rubber"),
)
# rho g h of rubber, 1000 kg/m^3: 10 um thick 0.1 Pa. Granite breaks at 0.1 to 0.3 GPa (Jaeger, Cook
# and Zimmerman, Fundamentals of Rock Mechanics), hydraulic seals bear up to 0.1 GPa.
PRESSURE = Quantity(
    PRESSURE_UNITS,
    likely=(5e3, 1e6),
    least=Limit(0.1, "the weight of 10 um of rubber"),
    high=Limit(1.5e8, "granite breaks under such pressures"),
    most=Limit(1e9, "any road stone breaks"),
)
# rho g h again, 1 cm: asked of what is no gel.
PRESSURE_ON_RUBBER = replace(PRESSURE, low=Limit(100.0, "the weight of 1 cm of rubber"), high=None)
RUBBER_FROM = 1e5  # [Pa]: the softest silicone rubbers have it, gels are softer
# The largest |E| that a rubber's data reach. 3 k T / xi^3 of a network with meshes of xi = 50 nm is
# 100 Pa (rubber elasticity); polyacrylamide gels begin at 200 Pa (Tse and Engler, Curr. Protoc.
# Cell Biol. 2010). Glassy polymers: 1 to 5 GPa, filled to 20 GPa; window glass: 70 GPa (Ashby,
# Materials Selection in Mechanical Design).
MODULUS = Quantity(
    MODULUS_UNITS,
    likely=(1e5, 2e10),
    least=Limit(100.0, "a network of 50 nm wide meshes, softer than gels"),
    low=Limit(1e4, "the softest rubbers have ten times as much, only gels have less"),
    high=Limit(2e10, "glassy polymers reach 5e9 Pa, filled ones 2e10 Pa"),
    most=Limit(1e11, "stiffer than window glass"),
)
RELAXED_MODULUS = replace(  # 0 for a liquid
    MODULUS,
    likely=(1e5, 1e9),
    least=Limit(0.0, ""),
    low=Limit(10.0, "gels are stiffer; a liquid has 0"),
)
# tau_f of rubber on roads is 1 to 10 MPa, of hydrogels some 10 Pa and more; the ideal shear
# strength of a glassy polymer, G / 10, is 1e8 Pa.
SHEAR_STRESS = Quantity(
    PRESSURE_UNITS,
    likely=(1e4, 5e7),
    least=Limit(0.1, "water drags as much"),
    low=Limit(10.0, "hydrogels have more"),
    high=Limit(2e8, "the ideal shear strength of a glassy polymer"),
    most=Limit(2e9, "the ideal shear strength of steel or stone"),
)
# Liquid nitrogen cools a DMA to -150 C; silicone rubber is glassy below -125 C. Rubber decomposes
# above 350 C in thermogravimetry (Brazier and Nickel, Rubber Chem. Technol. 48, 1975), silicones
# are used up to 250 C.
TEMPERATURE = Quantity(
    TEMPERATURE_UNITS,
    likely=(190.0, 480.0),
    least=Limit(120.0, "-153 C; every rubber is glassy, no DMA cools so far"),
    high=Limit(530.0, "257 C; silicone rubber is used up to 250 C"),
    most=Limit(700.0, "427 C; rubber decomposes"),
)
FREQUENCY = Quantity(  # at which a rubber was measured, before any shift
    FREQUENCY_UNITS,
    likely=(0, 0),
    least=Limit(1e-9, "a period of 200 years"),
    low=Limit(1e-7, "a period of 2 years"),
    high=Limit(1e9, "ultrasound of 160 MHz"),
    most=Limit(1e13, "atoms vibrate so"),
)
STRAIN = Quantity(
    STRAIN_UNITS,
    likely=(1e-5, 3.0),
    least=Limit(1e-9, "rigs resolve no less"),
    high=Limit(3.0, "300 %; most rubbers are torn"),
    most=Limit(30.0, "no rubber stretches so far"),
)
# c1 of WLF: log10 a_T falls by it between the reference and an infinite temperature. Ferry,
# Viscoelastic Properties of Polymers, Table 11-II: 3 to 34.
DECADES = Quantity(
    NUMBER_UNITS,
    likely=(0, 0),
    least=Limit(0.0, ""),
    high=Limit(100.0, "rubbers have 3 to 34 decades between the reference and infinite heat"),
    most=Limit(1e4, "rubbers have 3 to 34 decades between the reference and infinite heat"),
)
