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
from asperity.article.summary import counted, markdown
from asperity.cli.friction_commands import tell
from asperity.io.files import check_directory, write_files
from asperity.plot.curves import check_plot, picture

# Fig. 4, the sketch of a Hertz contact, is left out.
PAGES = (*(f"fig{n:02d}" for n in (*range(1, 4), *range(5, 16))), "table1")
FILES = (*(f"{page}.{kind}" for page in PAGES for kind in ("csv", "png")), "summary.md")


def article(args: Namespace) -> None:
    """Write all pictures, tables and the summary, and show how many statements hold."""
    directory = Path(args.output)
    check_plot(directory / f"{PAGES[0]}.png")
    check_directory(directory, FILES, force=args.force)
    contents, statements = remake()
    write_files({directory / name: data for name, data in contents.items()})
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
