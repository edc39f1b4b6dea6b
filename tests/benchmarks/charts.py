"""The tables of speed and exactness in docs/notes/speed.md. Takes about two minutes:

    python tests/benchmarks/charts.py

Runs rings, friction and point one after the other and writes what they find to docs/benchmarks,
and the tables between their two marks in that page. Needs ASPERITY_DATA as rings.py for its
measured rows; ASPERITY_LIBRARY as for point.py.
pip install asperity scipy pybind11.
"""

import csv
import io
from pathlib import Path

import measured
import point
import rings
import timing

import friction
from asperity.io.files import write_files

ROOT = Path(__file__).parents[2]
DOCS, PAGE = ROOT / "docs" / "benchmarks", ROOT / "docs" / "notes" / "speed.md"
BEGIN, END = "<!-- written by tests/benchmarks/charts.py -->\n", "<!-- as far as here -->\n"
PARTS = (rings, friction, point)

Rows = list[dict[str, str]]


def rows_of(text: str) -> tuple[Rows, str]:
    """Of a table, with the machine that it names."""
    machine = next(line for line in text.splitlines() if line.startswith("# machine = "))
    lines = io.StringIO("".join(line for line in text.splitlines(True) if line[0] != "#"))
    return list(csv.DictReader(lines)), machine.partition(" = ")[2].strip('"')


def page(tables: dict[str, str]) -> str:
    """The page's tables from the CSV files by their names."""
    rings_header = ["surface", "rubber", "a velocity [us]", "ratio", "once [ms]", "worst error"]
    of_rings = [
        [
            row["surface"],
            row["rubber"],
            timing.number(1e6 * float(row["time_s"]) / rings.VELOCITY.size),
            timing.number(float(row["ratio"])),
            timing.number(1e3 * float(row["once_s"])),
            f"{float(row['error']):.0e}",
        ]
        for row in rows_of(tables["rings.csv"])[0]
    ]
    curve, machine = rows_of(tables["friction.csv"])
    lines = [
        [
            row["method"],
            timing.number(1e6 * float(row["time_s"])),
            f"{float(row['error']):.1e}",
            *(timing.number(float(row[f"{key}_ratio"])) for key in friction.YARDSTICKS),
        ]
        for row in curve
    ]
    header = ["60 velocities by", "time [us]", "worst error"]
    header += [f"{key} NumPy over it" for key in friction.YARDSTICKS]
    points = {row["quantity"]: float(row["time_s"]) for row in rows_of(tables["point.csv"])[0]}
    table = {row["quantity"]: float(row["value"]) for row in rows_of(tables["tabulated.csv"])[0]}
    alone, grid = points["cpp, rtol 1e-06"], points["grid 1000 x 1000"]
    more = [
        [
            "one point: in C++, from Python, an empty call with as many arguments",
            ", ".join(f"{1e6 * points[f'{key}, rtol 1e-06']:.1f} us" for key in point.CALLS),
        ],
        [
            "a grid of 1000 pressures x 1000 velocities",
            f"{1e6 * grid / 1e6:.2g} us a point, {timing.number(grid / alone)} times one in C++",
        ],
        [
            "23 rows of a table for 20 terms, rtol 1e-9",
            f"{table['ratio']:.1f} times as long, {1e3 * table['once_s']:.2g} ms once before",
        ],
    ]
    return (
        f"{machine}, one thread:\n\n{timing.markdown(rings_header, of_rings)}\n"
        f"{timing.markdown(header, lines)}\n"
        f"{timing.markdown(['at rtol 1e-6 unless said', 'found'], more)}"
    )


def with_page(given: str, text: str) -> str:
    """The page with `text` between its marks."""
    before, begin, rest = given.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise SystemExit(f"{PAGE}: must have the lines {BEGIN!r} and {END!r}")
    return before + begin + text + end + after


def main() -> None:
    timing.on_one_thread()
    if measured.folder() is None:
        raise SystemExit("ASPERITY_DATA: must name the folder of the measured scans and rubbers")
    with_page(PAGE.read_text(encoding="utf-8"), "")  # has it the marks?
    files: dict[str, bytes] = {}
    for part in PARTS:
        elapsed, made = timing.timed(part.make)
        files |= made
        print(f"{part.__name__}: {elapsed:.0f} s", flush=True)
    tables = {name: data.decode() for name, data in files.items()}
    text = page(tables)
    print(text)
    contents = {DOCS / name: data for name, data in files.items()}
    written = with_page(PAGE.read_text(encoding="utf-8"), text)
    write_files({**contents, PAGE: written.encode()})


if __name__ == "__main__":
    main()
