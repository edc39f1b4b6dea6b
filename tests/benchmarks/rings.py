"""Measured spectra and rubbers: 60 velocities, over the closed form. Takes about a minute:

    python tests/benchmarks/rings.py

writes docs/benchmarks/rings.csv and the table between two marks in docs/notes/speed.md.

NayakSFactor, 81 kPa, rtol 1e-6; one thread, by turns, medians, as ratios to the self-affine surface
of Table 1 with a Prony series of 20 terms. The rings of two scans with two rubbers from isotherms,
which ASPERITY_DATA names, come first, as the Prony series fitted to them and as the master curve,
over all velocities at which the modulus was measured. Synthetic rings are those of a scan: equal
steps of q, C = q^-3.6 with a scatter that falls as more modes are averaged; their rubbers are that
series and a master curve of 140 rows of it, smooth and with 1 % of noise, their velocities 1e-6 to
10 m/s.
`once` is what the first call on new objects takes beyond the others: all that depends on the rows
alone. The error is the worst of 20 of the velocities, against GSL's CQUAD at 1e-11, for master
curves at 1e-10.
"""

import csv
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import measured
import numpy as np
import timing

import asperity
from asperity.io.files import write_files

DOCS = Path(__file__).parents[2] / "docs"
TABLE, PAGE = DOCS / "benchmarks" / "rings.csv", DOCS / "notes" / "speed.md"
BEGIN, END = "<!-- written by tests/benchmarks/rings.py -->\n", "<!-- as far as here -->\n"
RUNS = 21
SYNTHETIC = {
    "392 rings": (392, 8),
    "392 rings from one period on": (392, 1),
    "5000 rings": (5000, 8),
}
CLOSED = "closed form"
VELOCITY = np.geomspace(1e-6, 10, 60)
TERMS = "20 Prony terms"
CURVES = {"master curve of 140 rows": 0.0, "master curve of 140 rows, 1 % noise": 0.01}


def rubber() -> asperity.PronySeries:
    return asperity.PronySeries(
        equilibrium_modulus=2e6,
        moduli=3e6 * 10 ** np.linspace(0, 2.3, 20),
        relaxation_times=np.geomspace(1e2, 1e-10, 20),
    )


def tabulated(noise: float) -> dict[str, Any]:
    """Rows of the series from 1e-3 to 1e11 rad/s."""
    frequency = np.geomspace(1e-3, 1e11, 140)
    modulus = rubber().modulus(frequency)
    errors = noise * np.random.default_rng(140).standard_normal((2, frequency.size))
    return {
        "angular_frequency": frequency,
        "storage_modulus": modulus.real * np.exp(errors[0]),
        "loss_modulus": modulus.imag * np.exp(errors[1]),
    }


def rings(rows: int, first: int) -> asperity.TabulatedSpectrum:
    k = np.arange(first, first + rows)
    scatter = np.exp(0.1 * np.random.default_rng(rows).standard_normal(rows) * np.sqrt(first / k))
    density = 1e-13 * (k / first) ** -3.6 * scatter
    return asperity.TabulatedSpectrum(wavenumber=2000 / first * k, density=density)


@dataclass(frozen=True)
class Inputs:
    """Makes a surface and a rubber that no call has seen yet."""

    surface: Callable[[], Any]
    rubber: Callable[[], Any]
    velocity: Any

    def curve(self) -> Callable[..., Any]:
        surface, rubber = self.surface(), self.rubber()
        return partial(friction, surface, rubber, self.velocity)

    def error(self) -> float:
        surface, rubber, few = self.surface(), self.rubber(), self.velocity[::3]
        best = 1e-10 if isinstance(rubber, asperity.MasterCurve) else 1e-11  # I1 and I2 of rows
        truth = friction(surface, rubber, few, rtol=best, method="cquad")
        return float(np.abs(friction(surface, rubber, few) / truth - 1).max())


def friction(surface: Any, rubber: Any, velocity: Any, **options: Any) -> Any:
    options = {"pressure": 81e3, "correction": asperity.NayakSFactor(), "rtol": 1e-6, **options}
    return asperity.friction(surface, rubber, velocity=velocity, **options).mu


def scenes() -> dict[tuple[str, str], Inputs]:
    closed = partial(asperity.SelfAffineSpectrum, rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
    result = {(CLOSED, TERMS): Inputs(closed, rubber, VELOCITY)}
    builds = measured.rubbers()
    fitted = {name: asperity.fit_prony(build) for name, build in builds.items()}
    for scan, spectrum in measured.spectra().items():
        surface = partial(asperity.TabulatedSpectrum, **rows(spectrum, "wavenumber", "density"))
        for name, build in builds.items():
            curve = build.master_curve
            velocity = np.geomspace(*measured.velocities(spectrum, curve), 60)
            title = f"{scan.split('.')[0]}, {spectrum.wavenumber.size} rings"
            series = partial(
                asperity.PronySeries,
                **rows(fitted[name], "equilibrium_modulus", "moduli", "relaxation_times"),
            )
            terms = f"{name}, {fitted[name].moduli.size} Prony terms"
            result[title, terms] = Inputs(surface, series, velocity)
            names = ("angular_frequency", "storage_modulus", "loss_modulus")
            table = partial(asperity.MasterCurve, **rows(curve, *names))
            terms = f"{name}, master curve of {curve.angular_frequency.size} rows"
            result[title, terms] = Inputs(surface, table, velocity)
    for name, shape in SYNTHETIC.items():
        surface = partial(rings, *shape)
        result[name, TERMS] = Inputs(surface, rubber, VELOCITY)
        for terms, noise in CURVES.items():
            result[name, terms] = Inputs(
                surface, partial(asperity.MasterCurve, **tabulated(noise)), VELOCITY
            )
    return result


def rows(given: Any, *names: str) -> dict[str, Any]:
    return {name: getattr(given, name) for name in names}


def measure() -> bytes:
    """The table as CSV."""
    cases = scenes()
    first = {
        case: [timing.seconds(inputs.curve()) for _ in range(RUNS)]
        for case, inputs in cases.items()
    }
    times = timing.by_turns({case: inputs.curve() for case, inputs in cases.items()}, RUNS)
    columns: dict[str, list[object]] = {
        "surface": [surface for surface, _ in times],
        "rubber": [terms for _, terms in times],
        "time_s": [timing.median(result) for result in times.values()],
        "ratio": [timing.ratio(result, times[CLOSED, TERMS]) for result in times.values()],
        "once_s": [
            max(0.0, timing.median(first[case]) - timing.median(result))
            for case, result in times.items()
        ],
        "error": [inputs.error() for inputs in cases.values()],
    }
    return timing.table("benchmark rings", columns)


def markdown(table: str) -> str:
    """The page's table from the CSV."""
    machine = next(line for line in table.splitlines() if line.startswith("# machine = "))
    lines = csv.DictReader(line for line in table.splitlines() if not line.startswith("#"))
    header = ["surface", "rubber", "a velocity [us]", "ratio", "once [ms]", "worst error"]
    cells = [
        [
            row["surface"],
            row["rubber"],
            timing.number(1e6 * float(row["time_s"]) / VELOCITY.size),
            timing.number(float(row["ratio"])),
            timing.number(1e3 * float(row["once_s"])),
            f"{float(row['error']):.0e}",
        ]
        for row in lines
    ]
    name = machine.partition(" = ")[2].strip('"')
    return f"{name}, one thread:\n\n{timing.markdown(header, cells)}"


def with_table(page: str, text: str) -> str:
    """The page with `text` between its marks."""
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise SystemExit(f"{PAGE}: must have the lines {BEGIN!r} and {END!r}")
    return before + begin + text + end + after


def main() -> None:
    timing.on_one_thread()
    if measured.folder() is None:
        raise SystemExit("ASPERITY_DATA: must name the folder of the measured scans and rubbers")
    page = PAGE.read_text(encoding="utf-8")
    with_table(page, "")  # has it the marks?
    table = measure()
    print(text := markdown(table.decode()))
    write_files({TABLE: table, PAGE: with_table(page, text).encode()})


if __name__ == "__main__":
    main()
