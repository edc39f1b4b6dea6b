"""The verb `article`: the article's figures, its table and its statements, remade."""

from argparse import Namespace
from pathlib import Path

from asperity.article import (
    affine,
    asperities,
    draw_factors,
    draw_friction,
    draw_igw,
    draw_scales,
    draw_surfaces,
    factors,
    friction,
    igw,
    matches,
    peaks,
    persson,
    printed,
    shifts,
    sliding,
    surfaces,
)
from asperity.article.inputs import prepare
from asperity.article.page import Page
from asperity.article.statement import Statement
from asperity.article.summary import OPENING, counted, markdown
from asperity.cli.friction_commands import tell
from asperity.io.directory import Mark, begins, check_own_directory, table_of
from asperity.io.table import write_directory
from asperity.plot.curves import check_plot, picture

# Fig. 4, the sketch of a Hertz contact, is left out.
PAGES = (*(f"fig{n:02d}" for n in (*range(1, 4), *range(5, 16))), "table1")
MARKS: dict[str, list[Mark]] = {
    **{f"{page}.csv": [table_of(f"article {page}")] for page in PAGES},
    **{f"{page}.png": [f"{page}.csv"] for page in PAGES},
    "summary.md": [begins(OPENING)],
}


def article(args: Namespace) -> None:
    """Write all pictures, tables and the summary, and show how many statements hold."""
    directory = Path(args.output)
    check_plot(directory / f"{PAGES[0]}.png")
    check_own_directory(directory, "the article", MARKS)
    contents, statements = remake()
    write_directory(directory, contents)
    tell(f"{counted(statements)}\nsummary: {directory / 'summary.md'}\n")


def remake() -> tuple[dict[str, bytes], list[Statement]]:
    """All files by their names, and the statements."""
    inputs = prepare()
    spectra, all_curves = surfaces.compute(inputs), factors.compute(inputs)
    curves = all_curves["implicit"]
    readings, slid = shifts.compute(inputs), sliding.compute(inputs)
    statements = [
        *persson.statements(inputs),
        *affine.statements(inputs),
        *peaks.statements(inputs, peaks.compute(inputs)),
        *asperities.statements(inputs),
        *surfaces.statements(inputs, spectra),
        *factors.statements(inputs, all_curves),
        *matches.statements(inputs, all_curves),
        *printed.statements(inputs),
        *igw.statements(inputs, readings),
        *friction.statements(inputs, slid),
    ]
    pages = [
        draw_scales.fig01(inputs),
        draw_surfaces.fig02(inputs),
        draw_surfaces.fig03(inputs),
        draw_friction.fig05(inputs),
        draw_surfaces.fig06(inputs),
        draw_surfaces.fig07(inputs, spectra),
        draw_factors.fig08(inputs, curves),
        draw_factors.fig09(inputs, curves),
        draw_factors.fig10(inputs, curves),
        draw_factors.fig11(inputs, curves),
        draw_factors.fig12(inputs, curves),
        draw_igw.fig13(inputs, readings),
        draw_igw.fig14(inputs, readings),
        draw_friction.fig15(inputs, slid),
        draw_friction.table1(inputs, slid),
    ]
    contents = {name: data for page in pages for name, data in _files(page).items()}
    contents["summary.md"] = markdown(inputs, statements).encode()
    return contents, statements


def _files(page: Page) -> dict[str, bytes]:
    drawn = f"{page.name}.png"
    return {
        drawn: picture(page.figure, Path(drawn)),
        f"{page.name}.csv": page.table.csv().encode(),
    }
