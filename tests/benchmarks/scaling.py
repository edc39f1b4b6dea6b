"""Cost over the number of Prony terms and of points, both linear, and of rings, which is not.

    python tests/benchmarks/scaling.py [--output DIR]

Table 1's surface and conditions at rtol 1e-6: 60 velocities of series of 1 to 200 terms over the
same range of relaxation times, and 1 to 1e6 points of 20 terms, each with a velocity of its own or
as a grid of as many pressures as velocities. Last 60 velocities on 30 to 10,000 rings of a scan,
with the series and with a noisy master curve of 140 rows, after a first call that prepares them.
"""

from pathlib import Path
from typing import Any

import numpy as np
import timing
from curves import Curve, curves, measured_curves
from rings import rings

import asperity
from asperity.draw.figure import new_figure, picture
from asperity.draw.style import COLOURS

TERMS = (1, 2, 5, 10, 20, 50, 100, 200)
POINTS = tuple(10**k for k in range(7))
ROWS = (30, 100, 300, 1000, 3000, 10000)
SMALL = 100  # below this part of the largest count the call costs more than what is counted


def series(curve: Curve, terms: int) -> asperity.PronySeries:
    """With the curve's moduli at `terms` times, and their sum."""
    log_times = np.log(curve.inputs["relaxation_times"])
    at = np.linspace(log_times[0], log_times[-1], terms) if terms > 1 else log_times[[10]]
    moduli = np.exp(np.interp(at, log_times, np.log(curve.inputs["moduli"])))
    return asperity.PronySeries(
        equilibrium_modulus=curve.inputs["equilibrium_modulus"],
        moduli=moduli * curve.inputs["moduli"].sum() / moduli.sum(),
        relaxation_times=np.exp(at),
    )


def seconds(curve: Curve, rubber: Any, pressure: Any, velocity: Any, road: Any = None) -> float:
    inputs = (curve.road if road is None else road, rubber)
    conditions = {"pressure": pressure, "velocity": velocity, "correction": curve.correction}
    asperity.friction(*inputs, **conditions)  # prepares what is kept with them
    return timing.typical(lambda: asperity.friction(*inputs, **conditions), 9)


def measure() -> dict[str, dict[int, float]]:
    """Seconds by the number of terms, by that of points, and by that of rings."""
    curve = curves()["Table 1"]
    load = curve.inputs["pressure"]
    result: dict[str, dict[int, float]] = {
        "terms": {n: seconds(curve, series(curve, n), load, curve.velocity) for n in TERMS},
        "velocities": {},
        "grid": {},
    }
    for n in POINTS:
        velocity, side = np.geomspace(1e-6, 10, n), round(n**0.5)
        result["velocities"][n] = seconds(curve, curve.rubber, load, velocity)
        pressure = np.geomspace(1e4, 1e6, side)[:, None]
        result["grid"][side**2] = seconds(
            curve, curve.rubber, pressure, np.geomspace(1e-6, 10, side)
        )
    table = measured_curves()["392 rings, master curve"].rubber
    for name, rubber in (("rings", curve.rubber), ("rings, master curve", table)):
        result[name] = {
            n: seconds(curve, rubber, load, np.geomspace(1e-5, 1, 60), rings(n, 8)) for n in ROWS
        }
    return result


def exponent(result: dict[int, float]) -> float:
    """Of the power law through the larger counts."""
    x, y = np.log([(n, t) for n, t in result.items() if n >= max(result) / SMALL]).T
    return float(np.polyfit(x, y, 1)[0])


def straight(result: dict[int, float]) -> tuple[float, float]:
    """Seconds of none, and of each one more, by least squares of the relative error."""
    n, t = np.array(list(result.items())).T
    slope, start = np.polyfit(n, t, 1, w=1 / t)
    return float(start), float(slope)


def draw(result: dict[str, dict[int, float]], path: Path) -> bytes:
    figure, (left, right, last) = new_figure(3)
    start, slope = straight(result["terms"])
    n = np.array([0, max(TERMS)])
    left.plot(n, 1e3 * (start + slope * n), "--", color="0.5", linewidth=1, label="straight line")
    terms, times = np.array(list(result["terms"].items())).T
    left.plot(terms, 1e3 * times, "o", color=COLOURS[0], label="60 velocities")
    left.set_ylim(bottom=0)
    left.set_xlabel("Prony terms [-]")
    left.set_ylabel("Time [ms]")
    left.legend(loc="upper left", fontsize="small", frameon=False)
    for name, label, colour in (
        ("velocities", "each its own velocity", COLOURS[0]),
        ("grid", "a grid, $\\sqrt{n}$ pressures x $\\sqrt{n}$ velocities", COLOURS[1]),
    ):
        right.plot(*zip(*result[name].items(), strict=True), "o-", color=colour, label=label)
    most, longest = max(result["velocities"].items())
    n = np.array([1, most])
    right.plot(n, longest * n / most, "--", color="0.5", linewidth=1, label="slope 1", zorder=0)
    right.set_xlabel("Points $n$ [-]")
    right.set_ylabel("Time [s]")
    right.set_xscale("log")
    right.set_yscale("log")
    right.legend(loc="upper left", fontsize="small", frameon=False)
    for name, label, colour in (
        ("rings", "20 Prony terms", COLOURS[0]),
        ("rings, master curve", "master curve of 140 rows, 1 % noise", COLOURS[1]),
    ):
        n, times = np.array(list(result[name].items())).T
        last.plot(n, 1e6 * times / 60, "o-", color=colour, label=label)
    closed = 1e6 * result["terms"][20] / 60
    last.axhline(closed, color="0.5", linestyle="--", linewidth=1, label="closed form, 20 terms")
    last.set_ylim(bottom=0)
    last.set_xlabel("Rings of the scan [-]")
    last.set_ylabel("Time a velocity [µs]")
    last.set_xscale("log")
    last.legend(loc="upper left", fontsize="small", frameon=False)
    return picture(figure, path)


def make() -> timing.Report:
    result = measure()
    rows = [(name, n, t) for name, times in result.items() for n, t in sorted(times.items())]
    columns = dict(zip(("sweep", "count", "time_s"), zip(*rows, strict=True), strict=True))
    text = timing.markdown(
        ["sweep", "count", "time [us]", "of one [us]"],
        [[name, str(n), timing.number(1e6 * t), f"{1e6 * t / n:.3g}"] for name, n, t in rows],
    )
    start, slope = straight(result["terms"])
    text += (
        f"\n60 velocities take {1e6 * start:.0f} us and {1e6 * slope:.2f} us a term; time over the "
        f"last two decades goes with velocities^{exponent(result['velocities']):.2f} and with the "
        f"points of a grid^{exponent(result['grid']):.2f}.\n"
    )
    pictures = {f"scaling{end}": draw(result, Path(f"scaling{end}")) for end in (".png", ".svg")}
    files = {"scaling.csv": timing.table("benchmark scaling", columns), **pictures}
    return timing.Report(f"Scaling:\n\n{text}", files)


if __name__ == "__main__":
    timing.run(make, __doc__)
