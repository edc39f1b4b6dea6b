"""Heat of sliding: what the rubber and its contacts must tell, and the kernel of the heat flow."""

from typing import Any, Literal

from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import broadcast, of_kind, shaped
from asperity.base.parameters import parameter
from asperity.base.quantities import SPACING, WAVENUMBER
from asperity.base.value import CoreValue, value

Residence = Literal["disc", "box"]


@value
class Heating(CoreValue):
    """Thermal constants of a rubber, and the macro-asperity contacts in which sliding heats it.

    Heat flows in depth only, none of it into the road but by `interface_share`. It is spread evenly
    over contacts of one diameter, which hold the share P_m of the surface.

    Parameters
    ----------
    density : float
        rho [kg/m^3], 100 to 1e4.
    heat_capacity : float
        c_v [J/(kg K)], 100 to 1e4.
    conductivity : float
        lambda [W/(m K)], 0.01 to 100.
    contact_diameter : float
        2 R [m], of a macro-asperity contact.
    macro_wavenumber : float, optional
        q_m [1/m] in the spectrum's band, with P_m = P(q_m); by default 2 pi / contact_diameter,
        held to the band. It is one length with the diameter, and what the rise depends on most.
    macro_area : float, optional
        P_m itself, measured, in (0, 1]; not with macro_wavenumber.
    residence : {"disc", "box"}
        How long a spot is heated: "disc" as long as two discs overlap that slide over each other,
        "box" for R / v (B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006)).
    interface_share : float
        chi in [0, 1], the share of the adhesion's heat that enters the rubber; 1 for a road that
        insulates.
    """

    density: float = parameter(unit="kg/m^3")
    heat_capacity: float = parameter(unit="J/(kg K)")
    conductivity: float = parameter(unit="W/(m K)", usual=(0.05, 2))
    contact_diameter: float = parameter(SPACING, usual=(1e-5, 2e-2), shown_unit="mm")
    macro_wavenumber: float | None = parameter(WAVENUMBER, default=None)
    macro_area: float | None = None
    residence: Residence = "disc"
    interface_share: float = 1.0


def heat_kernel(q: ArrayLike, q_prime: ArrayLike, *, velocity: ArrayLike, heating: Heating) -> Any:
    """Return g(q, q') [s], by which heat of one roughness warms another at steady sliding.

    Heat of density f(q') exp(-2 q' z) dq' per rho c_v [K/s], deposited while a spot is in contact,
    raises the temperature that roughness q feels by g f dq'. With x = 2 q l, y = 2 q' l, l =
    sqrt(D t), D = lambda / (rho c_v): g = t x^2 y (N(x) / x - N(y) / y) / (y^2 - x^2), N(x) =
    int_0^1 h(w) erfcx(x sqrt w) dw. For "disc" t = 2 R / v and h is the overlap of two discs, for
    "box" t = R / v and h = 1.

    Parameters
    ----------
    q, q_prime : array_like
        Wavenumbers that feel and that heat [1/m].
    velocity : array_like
        v [m/s]; broadcasts with the wavenumbers.
    heating : Heating

    Returns
    -------
    float or ndarray
        In the broadcast shape of wavenumbers and velocity.

    Examples
    --------
    >>> from asperity import Heating, heat_kernel
    >>> tread = Heating(
    ...     density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
    ... )
    >>> round(heat_kernel(2e3, 2e4, velocity=1.0, heating=tread) * 1e6, 3)
    38.413
    """
    shape, columns = broadcast(q=q, q_prime=q_prime, velocity=velocity)
    core = of_kind(heating, "heating", Heating)._core
    return shaped(_core.heat_kernel(*columns, core), shape)
