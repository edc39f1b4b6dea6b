"""Notes of a result on heat: how much is left out, and laws of the shift used beyond their fit."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from asperity.base.diagnostics import Error, Note, kelvin
from asperity.heating import Heating
from asperity.shift_factors import ArrheniusFit, WlfFit

_LITTLE = 0.02  # of mu, less than any model error


def _tread(adhesive: bool) -> Heating:
    """Return a filled tread compound in contacts of 1 mm. Of the heat of adhesion it takes the
    share that rubber takes beside granite, by effusivities of 675 and 2400 W s^0.5 / (m^2 K)."""
    return Heating(
        density=1200,
        heat_capacity=1650,
        conductivity=0.23,
        contact_diameter=1e-3,
        interface_share=0.22 if adhesive else 1,
    )


def with_size_of_heat(
    notes: Sequence[Note],
    velocity: ArrayLike,
    adhesive: bool,
    heated_at: Callable[[int, Heating], Any],
) -> tuple[Note, ...]:
    """Return notes of which the one on heat that is left out says its size.

    `heated_at` gives the friction of one of the points with the heat of a typical tread compound:
    it is asked for the fastest, and only where there is such a note. The note stays as it is where
    heat cannot be computed.
    """
    remarks = list(notes)
    for i, note in enumerate(remarks):
        if note.code != "heat-left-out":
            continue
        fastest = int(np.argmax(np.ravel(velocity)))
        try:
            hot = heated_at(fastest, _tread(adhesive))
        except Error:
            continue
        rise = hot.temperature - hot.cold.temperature
        small = abs(hot.mu - hot.cold.mu) < _LITTLE * hot.cold.mu
        size = "changes little here, though it" if small else "matters, which"
        remarks[i] = Note(
            f"above 0.01 m/s flash heating {size} is not modelled without heating: at "
            f"{hot.velocity:.3g} m/s it would warm the rubber by {rise:.2g} K from ",
            *kelvin(hot.cold.temperature),
            f" and take mu from {hot.cold.mu:.3g} to {hot.mu:.3g}, with the constants of a tread "
            "compound in contacts of 1 mm (Persson 2006, J. Phys.: Condens. Matter 18, 7789)",
            code="little-heat-left-out" if small else note.code,
            next_step=note.next_step_phrases,
            effect=float(abs(hot.mu - hot.cold.mu) / max(hot.cold.mu, 1e-300)),
        )
    return tuple(remarks)


def law_notes(shift: Any, temperature: ArrayLike) -> tuple[Note, ...]:
    """Return a note where a fitted law of the shift was asked beyond the temperatures of it."""
    if not isinstance(shift, WlfFit | ArrheniusFit):
        return ()
    lowest, highest = float(np.min(temperature)), float(np.max(temperature))
    fitted = shift.lowest_temperature, shift.highest_temperature
    if fitted[0] is None or fitted[1] is None:
        return ()
    if fitted[0] <= lowest and highest <= fitted[1]:
        return ()
    name = "WLF law" if isinstance(shift, WlfFit) else "Arrhenius law"
    asked = (*kelvin(lowest), " to ", *kelvin(highest))
    about = f"the {name} is used from ", *asked, ", it was fitted on "
    sentence = (*about, *kelvin(fitted[0]), " to ", *kelvin(fitted[1]))
    step = ("measure the modulus from ", *asked)
    return (Note(*sentence, code="law-beyond-fit", next_step=step),)
