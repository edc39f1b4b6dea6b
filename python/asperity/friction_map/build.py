"""Friction maps for simulators, built to a tolerance and certified."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from asperity import _core
from asperity.adhesion import Adhesion, adhesion_core
from asperity.base.arguments import MOST_THREADS, notes_of, number, of_kind, real_array, whole
from asperity.base.diagnostics import Argument, InvalidInput, Note, refusal, unfit
from asperity.contact import Form, Method, contact_model
from asperity.correction import Correction
from asperity.dma import AnyRubber, rubber_of
from asperity.friction import check_temperature, known_shift
from asperity.friction_map.look_up import NOTE_LINE, FrictionMap
from asperity.heating import Heating
from asperity.rubber import Rubber
from asperity.self_affine_fit import AnySpectrum, spectrum_of
from asperity.shift_factors import TemperatureShift, temperature_shift_core
from asperity.sweeps import StrainFactors


def friction_map(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: tuple[float, float],
    velocity: tuple[float, float],
    rtol: float = 1e-4,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    adhesion: Adhesion | None = None,
    form: Form = "exact",
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    checked: int = 1_000_000,
    text: str = "",
    threads: int | None = None,
    temperature: float | tuple[float, float] | None = None,
    shift: TemperatureShift | None = None,
    heating: Heating | None = None,
    direction: float = 0.0,
    progress: Callable[[float], object] | None = None,
    words: Callable[[tuple[Note, ...]], Iterable[Note]] | None = None,
) -> FrictionMap:
    """Build a map of the friction coefficient for simulators to `rtol`, and certify it.

    Cells are halved until hysteresis and contact area keep rtol / 2 on lattices and on random
    points that nothing was made from; then the finished map is checked against the solver itself on
    more of them (docs/explanation/friction_map.md). Where a Greenwood-Williamson correction changes
    its state (full contact, beyond its range) the map is split along the boundary, where mu has a
    kink.

    With heating the map is of the friction with the heat that it makes, for one temperature of the
    background or a range of them, over which its cells are cubics. Beside it lie the map without
    heat, made to the same rtol, and the distance over which sliding that begins heats up.

    Parameters
    ----------
    spectrum, rubber, poisson_ratio, correction, adhesion, form, method, strain_factors
        As for `friction`.
    pressure, velocity : (lo, hi)
        The map's box [Pa], [m/s].
    rtol : float
        Relative, of hysteresis and area and so of mu, 1e-12 to 0.1. Cells grow in number as
        rtol^(-1/2).
    checked : int
        Random points of the last check, 200 random pressures at each of as many random velocities
        as make them up; a million take a second with a Prony series.
    text : str
        Lines to keep in the file, for whoever reads it; unless given, what stands for the
        arguments.
    threads : int, optional
        At most; by default as many as the machine has. The map is the same for any of them.
    temperature : float or (lo, hi), optional
        T0 of the background [K]. A range needs heating; without it the rubber is shifted to one
        temperature, and a look-up's a_T leads to others.
    shift, heating
        As for `friction`. With heating a point of the solver takes some 0.2 ms, the check of a
        million some minutes. Corrections by Greenwood-Williamson's model are refused, and
        so are GSL's methods. A measured master curve over a range takes minutes where `shift` is a
        law (`WLF`, or of `fit_wlf()` or `fit_arrhenius()`), and far more with shift factors:
        `progress` tells how far it is.
    direction : float
        The axis [rad], from x towards y, from which look-ups count their own direction: the map of
        a spectrum that knows directions is for all of them. With heating it is the one direction of
        the map, as with a ScanContact, which has contacts of its own in each.
    progress : callable, optional
        Called with the share of the work that is done, from 0 to 1, now and then.
    words : callable, optional
        Called with the notes, which the file has as it returns them: in the keys of a scene, say.

    Returns
    -------
    FrictionMap

    Raises
    ------
    InvalidInput
        Also where a part of the box has no contact, or where the heat has several steady states,
        between which mu jumps; the message has the temperature and the velocity.
    OutOfRange
        The box asks for the modulus outside of a measured master curve.
    NotConverged
        rtol is not met, with 100,000 cells or on a point of the last check; the message has what
        was.

    Examples
    --------
    >>> import asperity
    >>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6]
    ... )
    >>> box = {"pressure": (5e4, 5e5), "velocity": (1e-4, 1)}
    >>> fmap = asperity.friction_map(road, rubber, **box, checked=1000)
    >>> round(fmap.mu(81e3, 1e-2), 4)
    0.0205
    """
    if not isinstance(text, str):
        raise refusal("text", text, "a str")
    for name, called in (("progress", progress), ("words", words)):
        if called is not None and not callable(called):
            raise refusal(name, called, "a function, or None")
    surface, solid = spectrum_of(spectrum), rubber_of(rubber)
    parts = surface._core, solid._core
    angle = number(direction, "direction")
    model = contact_model(poisson_ratio, correction, form, 1e-6, method, strain_factors, angle)
    added = adhesion_core(adhesion)
    made_of: dict[str, Any] = {
        "spectrum": spectrum,
        "rubber": rubber,
        "correction": correction,
        "adhesion": adhesion,
    }
    if angle != 0:
        made_of["direction"] = angle
    if strain_factors is not None:
        made_of["strain_factors"] = strain_factors
    heat = None
    if heating is not None or temperature is not None or shift is not None:
        law, sides = _law(solid, temperature, shift, heating)
        made_of |= {"temperature": temperature, "shift": shift, "heating": heating}
        if heating is not None:
            heat = law, of_kind(heating, "heating", Heating)._core, sides
        else:
            [decades], _ = _core.shift_at(law, np.array(sides[:1]))
            parts = surface._core, solid.shifted(10**decades)._core
    lines = text or "".join(f"{name} = {part!r}\n" for name, part in made_of.items())
    noted = solid.notes if words is None else notes_of(words(solid.notes), "words")
    of_rubber = (f"{NOTE_LINE}{note.line}\n" for note in noted)
    lines = "".join(line for line in of_rubber if line not in text) + lines
    content = _core.build_friction_map(
        *parts,
        model,
        added,
        _sides(pressure, "pressure"),
        _sides(velocity, "velocity"),
        number(rtol, "rtol"),
        whole(checked, "checked"),
        lines,
        0 if threads is None else whole(threads, "threads", lowest=1, highest=MOST_THREADS),
        progress,
        heat,
        words,
    )
    return FrictionMap(content=content)


def _law(
    rubber: Rubber, temperature: Any, shift: TemperatureShift | None, heating: Heating | None
) -> tuple[Any, list[float]]:
    law = known_shift(rubber, shift)
    if temperature is None or law is None:
        if heating is not None:
            needs = "needs temperature= and shift=, from which the rubber is heated"
            raise InvalidInput(Argument("heating"), f": {needs}")
        check_temperature(temperature, shift, law)
    sides = _temperatures(temperature)
    if heating is None and sides[0] != sides[1]:
        only = "must be a number where no heating is given; a look-up's a_T leads to others"
        raise unfit("temperature", temperature, only)
    return temperature_shift_core(law), sides


def _temperatures(result: Any) -> list[float]:
    sides = real_array(result, "temperature")
    if sides.shape not in {(), (1,), (2,)}:
        raise refusal("temperature", result, "a number or (lo, hi)")
    return [float(sides.flat[0]), float(sides.flat[-1])]


def _sides(result: Any, name: str) -> list[float]:
    sides = real_array(result, name)
    if sides.shape != (2,):
        raise refusal(name, result, "(lo, hi)")
    return [float(side) for side in sides]
