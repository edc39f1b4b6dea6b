"""A Prony series as tables, and as finite-element programs take it."""

from typing import Literal

from asperity.base.arguments import choice
from asperity.base.arguments import number as real
from asperity.base.diagnostics import refusal
from asperity.rubber import PronySeries

Program = Literal["abaqus", "ansys"]


def prony_input(
    series: PronySeries,
    program: Program,
    *,
    poisson_ratio: float = 0.5,
) -> str:
    """Return the lines by which a finite-element program takes a Prony series.

    Moduli are relative to the instantaneous one, E_0 = E_inf + sum E_k, which stands beside them in
    Pa; times are in s. Poisson's ratio is constant, as in this library, so that bulk and shear
    modulus relax alike; at 0.5 there is no bulk modulus to relax.

    Parameters
    ----------
    series : PronySeries
        With one term or more, and an equilibrium modulus: the programs take no liquid.
    program : {"abaqus", "ansys"}
        Abaqus: ``*Elastic, moduli=INSTANTANEOUS`` and ``*Viscoelastic, time=PRONY``. Ansys:
        ``MP,EX`` and ``TB,PRONY`` of material 1.
    poisson_ratio : float
        nu [-], in [0, 0.5]; below 0.5 for Ansys.

    Returns
    -------
    str

    Examples
    --------
    >>> from asperity import PronySeries, prony_input
    >>> rubber = PronySeries(equilibrium_modulus=1e6, moduli=[3e6], relaxation_times=[1e-3])
    >>> print(prony_input(rubber, "ansys", poisson_ratio=0.49))
    ! instantaneous modulus in Pa, times in s
    MP,EX,1,4000000
    MP,NUXY,1,0.49
    TB,PRONY,1,1,1,SHEAR
    TBDATA,1,0.75,0.001
    TB,PRONY,1,1,1,BULK
    TBDATA,1,0.75,0.001
    """
    if not isinstance(series, PronySeries):
        raise refusal("series", series, "a PronySeries")
    ansys = choice(program, "program", Program) == 1
    ratio = real(poisson_ratio, "poisson_ratio")
    if not 0 <= ratio <= 0.5 or (ansys and ratio == 0.5):
        allowed = "0 or more and below 0.5, for Ansys" if ansys else "in [0, 0.5]"
        raise refusal("poisson_ratio", ratio, allowed, text=f"{ratio!r}")
    if not series.moduli.size or series.equilibrium_modulus == 0:
        terms = f"{series.moduli.size} terms and E_inf = {series.equilibrium_modulus:g}"
        raise refusal("series", series, "with terms and an equilibrium modulus", text=terms)
    whole = float(series.equilibrium_modulus + series.moduli.sum())
    pairs = [(e / whole, t) for e, t in zip(series.moduli, series.relaxation_times, strict=True)]
    return "\n".join((_ansys if ansys else _abaqus)(whole, ratio, pairs))


def _abaqus(whole: float, ratio: float, pairs: list[tuple[float, float]]) -> list[str]:
    bulk = 0 if ratio == 0.5 else 1
    rows = [f"{g:.12g}, {bulk * g:.12g}, {tau:.12g}" for g, tau in pairs]
    head = ["** instantaneous modulus in Pa, times in s", "*Material, name=RUBBER"]
    elastic = ["*Elastic, moduli=INSTANTANEOUS", f"{whole:.12g}, {ratio:.12g}"]
    return [*head, *elastic, "*Viscoelastic, time=PRONY", *rows]


def _ansys(whole: float, ratio: float, pairs: list[tuple[float, float]]) -> list[str]:
    lines = ["! instantaneous modulus in Pa, times in s"]
    lines += [f"MP,EX,1,{whole:.12g}", f"MP,NUXY,1,{ratio:.12g}"]
    numbers = [f"{one:.12g}" for pair in pairs for one in pair]
    for kind in ("SHEAR", "BULK"):
        lines.append(f"TB,PRONY,1,1,{len(pairs)},{kind}")
        for at in range(0, len(numbers), 6):  # a line of TBDATA takes six
            lines.append(f"TBDATA,{at + 1},{','.join(numbers[at : at + 6])}")
    return lines
