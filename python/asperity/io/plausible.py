"""The ranges that stated units leave plausible, with their reasons, and what is said outside them.

Scenes, readers and the command line state their units, so a number that no rubber, road or test
rig has was most likely given in another one. Outside of `least` to `most` a number is absurd,
outside of `low` to `high` it is unusual. Scenes and the command line refuse what is absurd and note
what is unusual; a reader that Python calls notes both, in one line of the logger "asperity", which
goes to stderr where nobody has configured logging. Each message guesses a unit in which the number
would be likely. Nothing is converted. The functions that compute take any consistent units and
never ask here.

These cannot be seen, since the wrong number is as plausible as the right one: hertz given as rad/s
(a factor of 6.3), wavenumbers without their 2 pi, 50 km/h given as 50 m/s, 68 F given as 68 C, some
hundred kPa given as Pa, nanometres given where micrometres are meant. Relaxation times and the
frequencies of a master curve have no range: time-temperature shifts move them over any number of
decades.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity._core import InvalidInput, NotConverged, OutOfRange
from asperity.base.celsius import ZERO_CELSIUS
from asperity.io.typed import as_typed


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


def _factors(**units: float) -> dict[str, tuple[float, float]]:
    return {name.replace("per_", "1/"): (factor, 0.0) for name, factor in units.items()}


_LENGTH = _factors(m=1.0, um=1e-6, mm=1e-3, nm=1e-9, pm=1e-12)
_WAVENUMBER = _factors(per_m=1.0, per_mm=1e3, per_um=1e6, per_nm=1e9)
_SPEED = {"m/s": (1.0, 0.0), "km/h": (1 / 3.6, 0.0), "mm/s": (1e-3, 0.0), "um/s": (1e-6, 0.0)}
_PRESSURE = _factors(Pa=1.0, MPa=1e6, bar=1e5, kPa=1e3, GPa=1e9)
_MODULUS = _factors(Pa=1.0, MPa=1e6, GPa=1e9, kPa=1e3)
_TEMPERATURE = {"K": (1.0, 0.0), "C": (1.0, ZERO_CELSIUS)}
_FREQUENCY = {"rad/s": (1.0, 0.0), "Hz": (2 * math.pi, 0.0)}
_STRAIN = {"1": (1.0, 0.0), "%": (0.01, 0.0)}
_NUMBER = {"": (1.0, 0.0)}

# Amplitudes of road texture: PIARC, XVIIIth World Road Congress 1987, Report of the technical
# committee on surface characteristics: up to 20 mm at wavelengths below 50 mm (macrotexture), up to
# 50 mm below 0.5 m (megatexture).
RMS_HEIGHT = Quantity(
    _LENGTH,
    likely=(1e-9, 1e-2),
    least=Limit(1e-12, "a hundredth of an atom"),
    low=Limit(1e-11, "cleaved mica has more"),
    high=Limit(0.1, "the texture of a road has at most centimetres"),
    most=Limit(1.0, "no road or stone is so rough"),
)
HEIGHT = Quantity(
    _LENGTH,
    likely=(1e-9, 3e-2),
    least=Limit(1e-15, "the size of a nucleus"),
    high=Limit(0.5, "the texture of a road has at most centimetres"),
    most=Limit(5.0, "no road or stone is so rough"),
)
# Sampling distances run from the picometres of tunnelling microscopes to the decimetres of a
# vehicle that measures unevenness (ISO 13473-5 ends megatexture at 0.5 m).
SPACING = Quantity(
    _LENGTH,
    likely=(1e-10, 1e-2),
    least=Limit(1e-12, "a hundredth of an atom"),
    most=Limit(1.0, "texture that rubber feels is finer"),
)
PARTICLE = Quantity(
    _LENGTH,
    likely=(1e-8, 1e-3),
    least=Limit(1e-10, "the size of an atom"),
    high=Limit(1e-2, "dust and wear particles are finer"),
    most=Limit(1.0, "no particle is so large"),
)
FIRST_WAVENUMBER = Quantity(
    _WAVENUMBER,
    likely=(1e1, 1e8),
    least=Limit(1e-3, "a wavelength of 6 km"),
    low=Limit(0.1, "a wavelength of 60 m; texture ends at 0.5 m"),
    most=Limit(1e11, "a wavelength below that of atoms"),
)
LAST_WAVENUMBER = Quantity(
    _WAVENUMBER,
    likely=(1e4, 1e10),
    least=Limit(10.0, "a wavelength of 0.6 m, longer than any texture"),
    low=Limit(2e3, "a wavelength of 3 mm; rubber feels finer texture"),
    high=Limit(4e10, "a wavelength of 0.16 nm, the distance of atoms"),
    most=Limit(1e11, "a wavelength below that of atoms"),
)
WAVENUMBER = Quantity(  # of no certain end
    _WAVENUMBER,
    likely=(1e1, 1e10),
    least=Limit(1e-3, "a wavelength of 6 km"),
    most=Limit(1e11, "a wavelength below that of atoms"),
)
# At an rms slope of 100 a surface stands at 89.4 degrees; measured ones have up to a few.
SLOPE = Quantity(
    _NUMBER,
    likely=(0, 0),
    least=Limit(0.0, ""),
    most=Limit(100.0, "the surface would stand upright; are heights or wavenumbers in other units"),
)
# Creep: plates of the Earth drift by 1e-9 m/s, an atom's diameter in an hour is 1e-13 m/s. Racing
# tyres slide at 100 m/s. Sound in gum rubber: 1550 m/s (CRC Handbook of Chemistry and Physics).
VELOCITY = Quantity(
    _SPEED,
    likely=(1e-9, 110.0),
    least=Limit(1e-13, "an atom's diameter in an hour"),
    low=Limit(1e-11, "a hundredth of the drift of continents"),
    high=Limit(150.0, "540 km/h"),
    most=Limit(1500.0, "the speed of sound in rubber"),
)
# rho g h of rubber, 1000 kg/m^3: 10 um thick 0.1 Pa. Granite breaks at 0.1 to 0.3 GPa (Jaeger, Cook
# and Zimmerman, Fundamentals of Rock Mechanics), hydraulic seals bear up to 0.1 GPa.
PRESSURE = Quantity(
    _PRESSURE,
    likely=(5e3, 1e6),
    least=Limit(0.1, "the weight of 10 um of rubber"),
    high=Limit(1.5e8, "granite breaks under such pressures"),
    most=Limit(1e9, "any road stone breaks"),
)
# rho g h again, 1 cm: asked of what is no gel.
PRESSURE_ON_RUBBER = Quantity(
    _PRESSURE,
    likely=(5e3, 1e6),
    least=Limit(0.1, "the weight of 10 um of rubber"),
    low=Limit(100.0, "the weight of 1 cm of rubber"),
    most=Limit(1e9, "any road stone breaks"),
)
RUBBER_FROM = 1e5  # [Pa]: the softest silicone rubbers have it, gels are softer
# The largest |E| that a rubber's data reach. 3 k T / xi^3 of a network with meshes of xi = 50 nm is
# 100 Pa (rubber elasticity); polyacrylamide gels begin at 200 Pa (Tse and Engler, Curr. Protoc.
# Cell Biol. 2010). Glassy polymers: 1 to 5 GPa, filled to 20 GPa; window glass: 70 GPa (Ashby,
# Materials Selection in Mechanical Design).
MODULUS = Quantity(
    _MODULUS,
    likely=(1e5, 2e10),
    least=Limit(100.0, "a network of 50 nm wide meshes, softer than gels"),
    low=Limit(500.0, "all but the softest gels are stiffer"),
    high=Limit(2e10, "glassy polymers reach 5e9 Pa, filled ones 2e10 Pa"),
    most=Limit(1e11, "stiffer than window glass"),
)
RELAXED_MODULUS = Quantity(  # 0 for a liquid
    _MODULUS,
    likely=(1e5, 1e9),
    least=Limit(0.0, ""),
    low=Limit(10.0, "gels are stiffer; a liquid has 0"),
    high=Limit(2e10, "glassy polymers reach 5e9 Pa, filled ones 2e10 Pa"),
    most=Limit(1e11, "stiffer than window glass"),
)
# tau_f of rubber on roads is 1 to 10 MPa, of hydrogels some 10 Pa and more; the ideal shear
# strength of a glassy polymer, G / 10, is 1e8 Pa.
SHEAR_STRESS = Quantity(
    _PRESSURE,
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
    _TEMPERATURE,
    likely=(190.0, 480.0),
    least=Limit(120.0, "-153 C; every rubber is glassy, no DMA cools so far"),
    high=Limit(530.0, "257 C; silicone rubber is used up to 250 C"),
    most=Limit(700.0, "427 C; rubber decomposes"),
)
FREQUENCY = Quantity(  # at which a rubber was measured, before any shift
    _FREQUENCY,
    likely=(0, 0),
    least=Limit(1e-9, "a period of 200 years"),
    low=Limit(1e-7, "a period of 2 years"),
    high=Limit(1e9, "ultrasound of 160 MHz"),
    most=Limit(1e13, "atoms vibrate so"),
)
STRAIN = Quantity(
    _STRAIN,
    likely=(1e-5, 3.0),
    least=Limit(1e-9, "rigs resolve no less"),
    high=Limit(3.0, "300 %; most rubbers are torn"),
    most=Limit(30.0, "no rubber stretches so far"),
)
# c1 of WLF: log10 a_T falls by it between the reference and an infinite temperature. Ferry,
# Viscoelastic Properties of Polymers, Table 11-II: 3 to 34.
DECADES = Quantity(
    _NUMBER,
    likely=(0, 0),
    least=Limit(0.0, ""),
    high=Limit(100.0, "rubbers have 3 to 34 decades between the reference and infinite heat"),
    most=Limit(1e4, "rubbers have 3 to 34 decades between the reference and infinite heat"),
)

_notes: ContextVar[list[str] | None] = ContextVar("notes", default=None)


@contextmanager
def collected(given: Mapping[str, Any] | None = None) -> Iterator[list[str]]:
    """Refuse absurd numbers, and collect the notes on unusual ones in a list.

    An error of the package that follows on a note may well be due to it, and repeats it. Both have
    the numbers of `given` as they were typed (`as_typed`).
    """
    notes: list[str] = []
    token = _notes.set(notes)
    try:
        yield notes
    except (InvalidInput, OutOfRange, NotConverged) as error:
        message = "; note: ".join([str(error), *notes])
        told = as_typed(message, given or {})
        if told == str(error):
            raise
        raise type(error)(told) from error
    finally:
        _notes.reset(token)
        notes[:] = [as_typed(note, given or {}) for note in notes]


def tell_again(notes: Sequence[str]) -> None:
    """Note what was noted when something was built that is now taken from a cache."""
    for note in notes:
        _note(note)


def check(where: str, values: ArrayLike, quantity: Quantity, unit: str = "") -> None:
    """Refuse numbers that are absurd, note those that are unusual; note both for Python's callers.

    Parameters
    ----------
    where : str
        What a message begins with: file, key or option.
    values : array-like
        Zeros, infinite ones and NaN are left to whoever computes with them.
    unit : str
        One of `quantity.units`, the SI unit if empty.

    Raises
    ------
    InvalidInput
        Inside of `collected`. In one line: the value, what is allowed and why, and the unit that it
        may be in.
    """
    unit = unit or next(iter(quantity.units))
    given = np.ravel(np.asarray(values, dtype=np.float64))
    given = given[np.isfinite(given)]
    if quantity.units is not _TEMPERATURE:
        given = given[given != 0]
    if given.size == 0:
        return
    size = _in_si(given, quantity, unit)
    lowest, highest = int(size.argmin()), int(size.argmax())
    for at, side, words, limit in (
        (lowest, -1, "must be at least", quantity.least),
        (highest, 1, "must be at most", quantity.most),
    ):
        if _beyond(size[at], side, limit):
            _refuse(_message(where, float(given[at]), quantity, unit, words, limit))
            return
    for at, side, words, unusual in (
        (lowest, -1, "unusual, below", quantity.low),
        (highest, 1, "unusual, above", quantity.high),
    ):
        if unusual is not None and _beyond(size[at], side, unusual):
            _note(_message(where, float(given[at]), quantity, unit, words, unusual))


def check_scan(where: str, heights: NDArray[Any], spacing: ArrayLike, unit: str) -> None:
    """Refuse a scan that stands higher than it is long, as heights in a wrong unit make it.

    Measured surfaces have rms heights, tilt included, of 1e-5 to 0.1 of their longest side; a
    scan tilted by 45 degrees has 0.29.
    """
    check(f"{where}: pixel_size", spacing, SPACING)
    step = max(1, heights.size // 50_000)  # an order of magnitude is enough
    with np.errstate(invalid="ignore"):  # a signalling NaN is a drop-out like others
        sample = np.asarray(heights.ravel(order="K")[::step], dtype=np.float64)
    sample = sample[np.isfinite(sample)]
    length = float(np.max(np.array(heights.shape) * np.asarray(spacing)))
    if sample.size < 2 or not 0 < length < math.inf:
        return
    with np.errstate(all="ignore"):  # heights of 1e300 are not refused here
        rms = float(np.std(sample))
    if not 0 < rms < math.inf:
        return
    if 5e-10 <= rms / length <= 0.5:
        return
    shown = f"rms height {rms:.4g} m on a length of {length:.4g} m"
    factor = _LENGTH[unit][0]
    number = rms / factor
    guesses = [
        other
        for other, (scale, _) in _LENGTH.items()
        if other != unit and 3e-5 <= number * scale / length <= 0.1
    ]
    guess = f"; heights in {guesses[0]}? {number:.4g} {guesses[0]} would do" if guesses else ""
    if rms / length > 10:
        allowed = "must be at most 10 times the length (no surface stands so high)"
        _refuse(f"{where}: unit = {unit!r}: {shown}: {allowed}{guess}")
        return
    known = "above half the length" if rms > length else "outside 5e-10 to 0.5 of the length"
    _note(f"{where}: unit = {unit!r}: {shown}: unusual, {known}{guess}")


def check_load(where: str, pressure: ArrayLike, stiffest: float) -> None:
    """Hold pressures against the largest |E| [Pa] of the rubber that they press.

    Rubber under its own modulus is squeezed flat, and linear theory has nothing to say of ten
    times that; a pressure below the weight of a centimetre of rubber is unusual where the rubber
    is no gel.
    """
    highest = float(np.max(pressure))
    if stiffest > RUBBER_FROM:
        check(where, pressure, PRESSURE_ON_RUBBER)
    if not 0 < stiffest < highest:
        return
    found = f"{where} = {highest:.6g}: {highest / stiffest:.3g} times the rubber's largest modulus"
    guess = "; moduli in MPa?" if 1e5 <= stiffest * 1e6 <= 2e10 else ""
    if highest > 10 * stiffest:
        _refuse(
            f"{found} ({stiffest:.4g} Pa): must be at most 10 times (it would be squashed){guess}"
        )
        return
    _note(f"{found} ({stiffest:.4g} Pa), which squashes it{guess}")


def _refuse(message: str) -> None:
    if _notes.get() is not None:
        raise InvalidInput(message)
    _note(message)


def _note(message: str) -> None:
    notes = _notes.get()
    if notes is None:
        import logging  # here: `import asperity` is to be quick

        logging.getLogger("asperity").warning("%s", message)
    elif message not in notes:
        notes.append(message)


def _in_si(given: NDArray[np.float64], quantity: Quantity, unit: str) -> NDArray[np.float64]:
    factor, offset = quantity.units[unit]
    si = factor * given + offset
    return si if quantity.units is _TEMPERATURE else np.abs(si)


def _beyond(size: float, side: int, limit: Limit) -> bool:
    return side * (size - limit.value) > 1e-9 * abs(limit.value)  # sweeps end on rounded numbers


def _message(
    where: str, value: float, quantity: Quantity, unit: str, words: str, limit: Limit
) -> str:
    factor, offset = quantity.units[unit]
    bound = f"{(limit.value - offset) / factor:.6g} {unit}".strip()
    guess = _guess(value, quantity, unit)
    return f"{where} = {value:.6g}: {words} {bound} ({limit.reason}){guess}"


def _guess(value: float, quantity: Quantity, unit: str) -> str:
    """The first other unit in which the number would be likely."""
    factor, offset = quantity.units[unit]
    for other, (scale, shift) in quantity.units.items():
        si = scale * value + shift
        size = si if quantity.units is _TEMPERATURE else abs(si)
        if other != unit and quantity.likely[0] <= size <= quantity.likely[1]:
            here = (si - offset) / factor
            return f"; in {other}? {value:.6g} {other} is {here:.6g} {unit}"
    return ""
