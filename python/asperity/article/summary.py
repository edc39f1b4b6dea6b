"""summary.md: the inputs, both readings side by side, and every statement with its verdict."""

from collections.abc import Iterable, Sequence

from asperity._core import __version__
from asperity.article import compounds
from asperity.article.inputs import (
    PIXELS,
    Q0,
    SIDE,
    SKEWNESS,
    VELOCITY,
    Inputs,
    effective_modulus,
)
from asperity.article.readings import PRINTED
from asperity.article.statement import BY_CONSTRUCTION, VERDICTS, Statement, listed

OPENING = "# The article remade\n\nMade by `asperity "  # by which it is known as this verb's own
_TOPICS = {
    "T": "Multiscale theory (Section 2)",
    "A": "Affine transformation (Section 3)",
    "P": "Local peaks (Sections 3.1, 6.1.1)",
    "E": "Improved Greenwood-Williamson, its equations (Section 3.2)",
    "M": "Rubber (Section 5.1)",
    "S": "Scans and spectra (Section 5.2)",
    "C": "Correction factors and contact area (Section 6.1)",
    "G": "Separation and shift factor (Section 6.1.2)",
    "F": "Friction (Sections 4, 6.2)",
}


def counts(statements: Iterable[Statement]) -> dict[str, int]:
    """How many statements have each verdict."""
    found = [statement.verdict for statement in statements]
    return {verdict: found.count(verdict) for verdict in VERDICTS}


def counted(statements: Sequence[Statement]) -> str:
    """The counts in one line."""
    found = counts(statements)
    trivial = found.pop(BY_CONSTRUCTION)
    parts = ", ".join(f"{count} {verdict}" for verdict, count in found.items())
    return f"{len(statements)} statements: {parts}; {trivial} by construction, set apart"


def markdown(inputs: Inputs, statements: Sequence[Statement]) -> str:
    """The whole summary."""
    parts = [
        f"{OPENING}{__version__} article`. Verdicts follow from the numbers "
        'by the criterion beside them. "Tuned": tuned inputs decide, what is met was put in, not '
        'found; other verdicts are the same with tuned and with untuned inputs. "By construction": '
        "the equations in use, or how the inputs were made, leave no other outcome; a check of the "
        "code, not of the article. Nothing here is compared with exact contact: `asperity "
        "validate` does that.",
        f"{counted(statements)}.",
        "## Inputs",
        _table(("input", "value", "from"), _inputs(inputs)),
        "## The printed p_T in both readings of Eqs 19-20",
        _table(("", *inputs.tuned), _readings(inputs)),
        "With 1 / p_T = (z_max - d~) / (z_max - z_min) the three printed numbers fix three "
        "unknowns. E* may lie anywhere in the range without changing a printed digit.",
        "## Statements",
    ]
    columns = ("id", "place", "statement", "criterion", "found", "verdict", "reason")
    for letter, title in _TOPICS.items():
        rows = [
            (s.name, s.place, s.claim, s.criterion, s.found, s.verdict, s.reason)
            for s in sorted(statements, key=lambda s: int(s.name[1:]))
            if s.name[0] == letter
        ]
        parts += [f"### {title}", _table(columns, rows)]
    return "\n\n".join(parts) + "\n"


def _inputs(inputs: Inputs) -> list[tuple[str, str, str]]:
    published, assumed = "published", "our choice"
    untuned = inputs.untuned["implicit"].correction
    surfaces = {"sandpaper": inputs.sandpaper, "asphalt": inputs.asphalt}
    rows = [
        (
            name,
            f"H {s.hurst:g}, h_rms {1e6 * s.rms_height:g} um, q0 {s.q0:g}/m, q1 {s.q1:g}/m",
            published,
        )
        for name, s in surfaces.items()
    ]
    return [
        *rows,
        ("spectrum", "self-affine, h_rms exact on [q0, q1] (Eq. 12 repaired)", "A4"),
        (
            "scans",
            f"{len(inputs.scans)} of each, {SIDE} x {SIDE} lambda0, {PIXELS} x {PIXELS} pixels; "
            f"sandpaper with skewness {SKEWNESS:g} and 0, asphalt 0",
            "synthetic; skewness our choice, made knowing the printed p_T",
        ),
        ("T_g of A, B", f"{listed(compounds.T_G.values(), 'g')} C", published),
        (
            "moduli",
            f"equilibrium {compounds.EQUILIBRIUM_MODULUS / 1e6:g} MPa, glass "
            f"{compounds.GLASSY_MODULUS / 1e9:g} GPa, filler {compounds.FILLER_MODULUS / 1e6:g} "
            f"MPa a decade; {compounds.TERMS} terms, Poisson ratio {compounds.POISSON_RATIO:g}",
            assumed,
        ),
        (
            "place on the frequency axis",
            f"{compounds.GLASS_TIME:g} s at T_g (Angell 1991), WLF with C1 {compounds.C1:g}, C2 "
            f"{compounds.C2:g} K (Williams, Landel, Ferry 1955), {compounds.ROOM:g} C",
            assumed,
        ),
        ("compound A, tuned", "moved along the frequency axis, see below", "tuned"),
        ("z_max, z_min of the sandpaper in IGW, tuned", "see below", "tuned"),
        ("compound A, untuned", f"the surrogate at {compounds.ROOM:g} C", assumed),
        (
            "z_max, z_min of the sandpaper in IGW, untuned",
            "means of the scans without skewness: "
            f"{1e6 * untuned.z_max:.1f} and {1e6 * untuned.z_min:.1f} um",
            "synthetic",
        ),
        ("z_max, z_min of the asphalt in IGW", "means of its scans", "synthetic"),
        ("adhesion, load on asphalt", "Table 1", published),
    ]


def _readings(inputs: Inputs) -> list[tuple[str, ...]]:
    tuned = inputs.tuned.values()
    bare = effective_modulus(inputs.compound_a)
    share = 1 - compounds.POISSON_RATIO**2
    return [
        ("E* [MPa]", *(f"{t.implied.effective_modulus / 1e6:.4g}" for t in tuned)),
        (
            "E* within the rounding of p_T [MPa]",
            *(f"{t.implied.lowest / 1e6:.3g} to {t.implied.highest / 1e6:.3g}" for t in tuned),
        ),
        (
            f"abs E at q0 v = {Q0 * VELOCITY:g} rad/s [MPa]",
            *(f"{share * t.implied.effective_modulus / 1e6:.4g}" for t in tuned),
        ),
        ("the same of surrogate A, not tuned [MPa]", *(f"{share * bare / 1e6:.4g}" for _ in tuned)),
        ("surrogate A moved by [decades]", *(f"{t.decades:+.3f}" for t in tuned)),
        ("as if it were at [C]", *(f"{t.temperature:.1f}" for t in tuned)),
        ("z_max [um]", *(f"{1e6 * t.implied.z_max:.1f}" for t in tuned)),
        ("z_min [um]", *(f"{1e6 * t.implied.z_min:.1f}" for t in tuned)),
        (
            f"p_T at {listed((p / 1e6 for p in PRINTED), 'g')} MPa",
            *(listed(t.implied.shift_factor, ".4g") for t in tuned),
        ),
        ("p_T printed", *(listed(PRINTED.values()) for _ in tuned)),
    ]


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines: list[Sequence[str]] = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(_cell(c) for c in line) + " |" for line in lines)


def _cell(text: str) -> str:
    """Text that neither ends a cell nor is taken for a tag."""
    for mark, escaped in (("|", "\\|"), ("<", "&lt;"), (">", "&gt;"), ("*", "\\*")):
        text = text.replace(mark, escaped)
    return text
