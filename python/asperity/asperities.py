"""Single-scale asperity contact: Hertz and Greenwood-Williamson (Eqs 14, 16-20)."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import broadcast, choice, number, number_or_none, shaped, vector
from asperity.base.diagnostics import must_be
from asperity.base.parameters import column
from asperity.base.table import Table
from asperity.base.value import value
from asperity.correction import Reading

# in the order of the core's enumeration
STATES = np.array(["no contact", "partial", "full"])


def hertz_penetration(*, force: float, effective_modulus: float, radius: float) -> float:
    """Return the penetration of a sphere, delta = (9 F^2 / (16 E*^2 R))^(1/3) [m].

    Hertz; the article's Eq. 14 with the square of F that it lost in print.

    Parameters
    ----------
    force : float
        F [N], not negative.
    effective_modulus : float
        E* [Pa], positive.
    radius : float
        R [m], positive.
    """
    given = {"force": force, "effective_modulus": effective_modulus, "radius": radius}
    return float(_core.hertz_penetration(*(number(one, name) for name, one in given.items())))


@value
class Separation(Table):
    """What `separation` returns; scalars for scalar arguments.

    Attributes
    ----------
    effective : float or ndarray
        d~ [m], the effective separation above the mean plane.
    rigid : float or ndarray
        d [m].
    state : str, ndarray of str or None
        "no contact" (d~ >= z_max), "partial" or "full" (d~ <= z_min); None where z_max, z_min were
        not given.
    """

    effective: Any = column("m", "effective separation")
    rigid: Any = column("m", "rigid separation")
    state: Any = column("", "state of the contact", default=None)

    def _draw(self, axes: Any) -> None:
        for name in ("effective", "rigid"):
            axes.plot(np.ravel(getattr(self, name)), "o-", label=name)
        axes.set(xlabel="point", ylabel="separation [m]")
        axes.legend()


def separation(
    *,
    pressure: ArrayLike,
    effective_modulus: ArrayLike,
    rms_height: float,
    q0: float,
    peaks: ArrayLike | None = None,
    reading: Reading = "implicit",
    z_max: float | None = None,
    z_min: float | None = None,
) -> Separation:
    """Return the separation of the mean planes in the Greenwood-Williamson model (Eqs 16-20).

    sigma0 = (4/3) E* sqrt(R) n_a <(z - d)^1.5> over macro-asperities of
    n_a = q0^2 / (2 pi^2 sqrt 3) a unit area and radius R = 1 / (q0^2 sqrt 2 h_rms).

    Parameters
    ----------
    pressure, effective_modulus : array_like
        sigma0 and E* [Pa]; they broadcast.
    rms_height, q0 : float
        h_rms [m] and wavenumber [1/m] of the macro-asperities.
    peaks : array_like, shape (n,), optional
        Their heights [m] above the mean plane instead of a Gaussian, n >= 3.
    reading : {"implicit", "added"}
        Of Eqs 19-20. "implicit": Eq. 20 is solved for d~, so the interaction cancels, and
        d = d~ - sigma0 sqrt(A_a) / E*. "added": d is the plain Greenwood-Williamson separation,
        d~ = d + sigma0 sqrt(A_a) / E*; it turns upward again at high load on soft rubber and is
        unphysical there. sqrt(A_a) = 2 pi / q0.
    z_max, z_min : float, optional
        Highest and lowest point of the profile [m]; they set `state`.

    Returns
    -------
    Separation

    Notes
    -----
    d~ is no gap: it falls to -5 h_rms where the true gap is still positive. Beyond 3 h_rms the
    theory has left its range.
    """
    if (z_max is None) != (z_min is None):
        missing = "z_min" if z_min is None else "z_max"
        raise must_be(missing, "given with the other of z_max, z_min")
    shape, (p, modulus) = broadcast(pressure=pressure, effective_modulus=effective_modulus)
    heights = np.empty(0) if peaks is None else vector(peaks, "peaks")
    if peaks is not None and not heights.size:
        raise must_be("peaks", "3 or more", " has 0 entries")
    effective, rigid, state = _core.separation(
        p,
        modulus,
        number(rms_height, "rms_height"),
        number(q0, "q0"),
        heights,
        choice(reading, "reading", Reading),
        number_or_none(z_max, "z_max"),
        number_or_none(z_min, "z_min"),
    )
    return Separation(
        effective=shaped(effective, shape),
        rigid=shaped(rigid, shape),
        state=None if z_max is None else shaped(STATES[state], shape),
    )
