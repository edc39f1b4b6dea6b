"""summary.md: the inputs, both readings side by side, and every statement with its verdict."""

from collections.abc import Mapping, Sequence
from importlib.resources import files

from asperity._core import __version__
from asperity_scripts.article import compounds, inputs
from asperity_scripts.article.flash import TREAD
from asperity_scripts.article.inputs import Inputs
from asperity_scripts.article.readings import PRINTED
from asperity_scripts.article.statement import VERDICTS, Findings, fill

Rows = Sequence[Mapping[str, str]]
OPENING = "# The article remade\n\nMade by `asperity "  # by which it is known as this verb's own
_TOPICS = {
    "T": "Multiscale theory (Section 2)",
    "A": "Affine transformation (Section 3)",
    "P": "Local peaks (Sections 3.1, 6.1.1)",
    "E": "Improved Greenwood-Williamson, its equations (Section 3.2)",
    "S": "Scans and spectra (Section 5.2)",
    "C": "Correction factors and contact area (Section 6.1)",
    "G": "Separation and shift factor (Section 6.1.2)",
    "F": "Friction (Sections 4, 6.2)",
}


def counted(statements: Rows) -> str:
    verdicts = [row["verdict"] for row in statements]
    parts = [f"{verdicts.count(verdict)} {verdict}" for verdict in VERDICTS]
    return f"{len(verdicts)} statements: {', '.join(parts[:-1])}; {parts[-1]}, set apart"


def markdown(setup: Inputs, findings: Findings, statements: Rows) -> str:
    """The whole summary: its text with the numbers, then the tables."""
    text = (files("asperity_scripts.article") / "summary.md").read_text(encoding="utf-8")
    heights = setup.untuned["implicit"].correction
    micrometres = {"z_max": heights.z_max, "z_min": heights.z_min}
    micrometres |= {n: getattr(setup, n).rms_height for n in ("sandpaper", "asphalt")}
    numbers = {n: {**findings["G1"][n].numbers, **findings["G2"][n].numbers} for n in setup.tuned}
    opening = fill(
        text,
        **numbers,
        sandpaper=setup.sandpaper,
        asphalt=setup.asphalt,
        scans=len(setup.scans),
        counted=counted(statements),
        um={name: 1e6 * height for name, height in micrometres.items()},
        bare=findings["G2"][""].numbers["bare"],
        printed=PRINTED.values(),
        inputs=inputs,
        compounds=compounds,
        flash=TREAD,
        diameter=1e3 * TREAD.contact_diameter,
        share=100 * TREAD.interface_share,
    )
    parts = [f"{OPENING}{__version__} article`. {opening.strip()}"]
    tested = [row for row in statements if row["criterion"]]
    for letter, title in _TOPICS.items():
        rows = [row for row in tested if row["id"][0] == letter]
        parts += [f"### {title}", _table(("criterion", "found"), rows)]
    parts += [
        "### What no number here decides",
        '"By construction": the equations in use, or how the inputs were made, leave no other '
        'outcome. "Cannot be checked": what it takes is not published, or not at hand.',
        _table((), [row for row in statements if not row["criterion"]]),
    ]
    return "\n\n".join(parts) + "\n"


def _table(numbers: Sequence[str], rows: Rows) -> str:
    heads = ("id", "place", "statement", *numbers, "verdict", "reason")
    lines = [heads, ["---"] * len(heads), *([_cell(row[head]) for head in heads] for row in rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _cell(text: str) -> str:
    """Text that neither ends a cell nor is taken for a tag."""
    for mark, escaped in (("|", "\\|"), ("<", "&lt;"), (">", "&gt;"), ("*", "\\*")):
        text = text.replace(mark, escaped)
    return text
