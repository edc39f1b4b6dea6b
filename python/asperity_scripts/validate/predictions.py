"""What the theory with each correction says of a contact that boundary elements have solved."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from asperity.contact import correction_factor
from asperity.correction import (
    AffineShift,
    Correction,
    GreenwoodWilliamson,
    ImplicitSFactor,
    LocalPeaks,
    NayakSFactor,
    PeaksThenGreenwoodWilliamson,
    Reading,
    SFactor,
)
from asperity.friction import friction
from asperity.rubber import PronySeries
from asperity.spectrum import Spectrum, TabulatedSpectrum
from asperity_scripts.validate.contacts import Contact

Quantity = Literal["area", "energy"]


@dataclass(frozen=True)
class Model:
    """A correction by the name that tables and pictures give it, as made for a contact."""

    name: str
    call: str  # how it is made
    correction: Callable[[Contact], Correction | None]


def _peaks(distance: str) -> Callable[[Contact], Correction | None]:
    # only their mean enters Eq. 13
    return lambda c: LocalPeaks([c.peaks[distance]] * 3, z_max=c.z_max)


def _greenwood_williamson(reading: Reading) -> Callable[[Contact], Correction | None]:
    return lambda c: GreenwoodWilliamson(
        z_max=c.z_max, z_min=c.z_min, rms_height=c.rms_height, q0=c.q0, reading=reading
    )


def _both(distance: str) -> Callable[[Contact], Correction | None]:
    return lambda c: PeaksThenGreenwoodWilliamson(
        [c.peaks[distance]] * 3, z_max=c.z_max, z_min=c.z_min, rms_height=c.rms_height, q0=c.q0
    )


_ALONE = (
    Model("none", "None", lambda _: None),
    Model("S in Eq. 22, 0.40", "SFactor(gamma=0.4)", lambda _: SFactor(gamma=0.4)),
    Model("S in Eq. 22, 0.50", "SFactor(gamma=0.5)", lambda _: SFactor(gamma=0.5)),
    Model(
        "S in G, 0.50",
        'SFactor(gamma=0.5, applies_to="area")',
        lambda _: SFactor(gamma=0.5, applies_to="area"),
    ),
    Model(
        "S in G, 5/9",
        'SFactor(gamma=5/9, applies_to="area")',
        lambda _: SFactor(gamma=5 / 9, applies_to="area"),
    ),
    Model("S of A, 0.45", "ImplicitSFactor()", lambda _: ImplicitSFactor()),
    Model("Nayak S", "NayakSFactor()", lambda _: NayakSFactor()),
    Model("shift 1.5", "AffineShift(1.5)", lambda _: AffineShift(1.5)),
    Model("shift 2", "AffineShift(2)", lambda _: AffineShift(2)),
)
_OF_ASPERITIES = (  # which need their wavenumber
    Model("peaks, lambda0", "LocalPeaks(map, min_distance=lambda0)", _peaks("lambda0")),
    Model("peaks, lambda0/2", "LocalPeaks(map, min_distance=lambda0/2)", _peaks("lambda0/2")),
    Model("IGW implicit", "GreenwoodWilliamson(...)", _greenwood_williamson("implicit")),
    Model("IGW added", 'GreenwoodWilliamson(..., reading="added")', _greenwood_williamson("added")),
    Model(
        "peaks, then IGW",
        "PeaksThenGreenwoodWilliamson(map, min_distance=lambda0/2)",
        _both("lambda0/2"),
    ),
)
MODELS = (*_ALONE, *_OF_ASPERITIES)


@dataclass(frozen=True)
class Prediction:
    """By one model for one contact; errors are relative."""

    contact: Contact
    model: Model
    shift: float  # p_T, infinite without contact
    area: float
    energy: float  # [J/m^2]

    @property
    def area_error(self) -> float:
        return self.area / self.contact.area - 1

    @property
    def energy_error(self) -> float:
        return self.energy / self.contact.energy - 1

    def error(self, quantity: Quantity) -> float:
        return self.area_error if quantity == "area" else self.energy_error


def models_for(contacts: Sequence[Contact]) -> tuple[Model, ...]:
    """Those whose input is known of all contacts."""
    known = all(contact.q0 is not None for contact in contacts)
    return MODELS if known else _ALONE


def predict(contact: Contact, model: Model) -> Prediction:
    """Area at q1 and elastic energy of a contact."""
    correction = model.correction(contact)
    result = _of(friction, contact, correction)
    return Prediction(
        contact,
        model,
        shift=float(result.shift_factor),
        area=float(result.contact_area),
        energy=energy(contact, correction),
    )


def _of(theory: Callable[..., Any], contact: Contact, correction: Any, **more: Any) -> Any:
    """What the theory says of a contact, which does not know its velocity; E* is the modulus of
    Poisson's ratio 0."""
    solid = PronySeries(
        equilibrium_modulus=contact.effective_modulus, moduli=[], relaxation_times=[]
    )
    at = {"pressure": contact.pressure, "velocity": 1.0, "poisson_ratio": 0.0}
    return theory(contact.spectrum, solid, **at, correction=correction, **more)


def energy(contact: Contact, correction: Correction | None) -> float:
    """Elastic energy per area, (pi E* / 2) int q^2 C W dq [J/m^2].

    W is the weight of q^3 C in the integrand of Eq. 22, A/A0 times S or over p_T^2: with W = 1 the
    energy of full conformity.
    """
    if isinstance(correction, SFactor) and correction.applies_to == "area":
        correction = None  # which leaves Eq. 22 alone
    q, weight = _nodes(contact.spectrum)
    factor = _of(correction_factor, contact, correction, wavenumber=q)
    total = np.sum(weight * q**2 * contact.spectrum.at(q) * factor)
    return float(math.pi / 2 * contact.effective_modulus * total)


def _nodes(spectrum: Spectrum) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wavenumbers and weights of dq: Gauss points in ln q, in panels that are narrow near q0, where
    the contact breaks up, and end at the rows of a table."""
    length = math.log(spectrum.q1 / spectrum.q0)
    edges = length * np.array([0, 0.005, 0.01, 0.02, 0.04, 0.1, 0.2, 0.4, 0.7, 1]) ** 2
    points = 16
    if isinstance(spectrum, TabulatedSpectrum):
        edges = np.union1d(edges, np.log(spectrum.wavenumber / spectrum.q0).clip(0, length))
        points = 4
    x, w = np.polynomial.legendre.leggauss(points)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    y = (middle[:, None] + half[:, None] * x).ravel()
    q = np.minimum(spectrum.q0 * np.exp(y), spectrum.q1)
    return q, (half[:, None] * w).ravel() * q


def needed_shift(contact: Contact) -> float:
    """The p_T with which Persson's area is the exact one: erf(p_T sqrt(2) p*) = A/A0; NaN where the
    contact is full, which every p_T gives."""
    if contact.area >= 1:
        return math.nan
    erfinv = NormalDist().inv_cdf((1 + contact.area) / 2) / math.sqrt(2)
    return erfinv / (math.sqrt(2) * contact.load)


def needed_shift_for_energy(contact: Contact) -> float:
    """The p_T with which the elastic energy is the exact one; NaN where that is below 1."""
    if energy(contact, None) < contact.energy:
        return math.nan
    low, high = 1.0, 2.0
    while energy(contact, AffineShift(high)) > contact.energy:
        low, high = high, 2 * high
    while high / low > 1 + 1e-4:
        middle = math.sqrt(low * high)
        if energy(contact, AffineShift(middle)) > contact.energy:
            low = middle
        else:
            high = middle
    return math.sqrt(low * high)
