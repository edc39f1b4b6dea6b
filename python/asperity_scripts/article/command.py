"""The verb `article`: the article's figures, its table and its statements, remade."""

from argparse import Namespace
from collections.abc import Callable

from asperity.base.arguments import FilePath
from asperity.cli.streams import print_stdout
from asperity.draw.figure import check_plot
from asperity.draw.style import drawn_in
from asperity.io.files import check_directory, write_files
from asperity_scripts.article import (
    asperities,
    factors,
    peaks,
    separation,
    sliding,
    surfaces,
    theory,
    tuning,
)
from asperity_scripts.article.inputs import Inputs, prepare
from asperity_scripts.article.statement import judge
from asperity_scripts.article.summary import Rows, counted, markdown

# Fig. 4, the sketch of a Hertz contact, is left out.
PAGES = (*(f"fig{n:02d}" for n in (*range(1, 4), *range(5, 16))), "table1")
FILES = (*(f"{page}.{kind}" for page in PAGES for kind in ("csv", "png")), "summary.md")
_TOPICS = (theory, peaks, asperities, surfaces, factors, tuning, separation, sliding)
_FIGURES: tuple[Callable[[Inputs], dict[str, bytes]], ...] = (
    theory.fig01,
    surfaces.fig02,
    surfaces.fig03,
    tuning.fig05,
    surfaces.fig06,
    surfaces.fig07,
    factors.fig08,
    factors.fig09,
    factors.fig10,
    factors.fig11,
    factors.fig12,
    separation.fig13,
    separation.fig14,
    sliding.fig15,
    sliding.table1,
)


def article(args: Namespace) -> None:
    directory = FilePath(args.output)
    check_plot(directory / f"{PAGES[0]}.png")
    check_directory(directory, FILES, force=args.force)
    with drawn_in(args.style):
        contents, statements = remake()
    write_files({directory / name: data for name, data in contents.items()})
    print_stdout(f"{counted(statements)}\nsummary: {directory / 'summary.md'}\n")


def remake() -> tuple[dict[str, bytes], Rows]:
    inputs = prepare()
    findings = {
        name: finding for topic in _TOPICS for name, finding in topic.findings(inputs).items()
    }
    statements = judge(findings)
    contents = {"summary.md": markdown(inputs, findings, statements).encode()}
    for draw in _FIGURES:
        contents |= draw(inputs)
    return contents, statements
