"""How the benchmarks time: one thread, methods by turns, medians."""

import os
import re
import statistics
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from datetime import date
from pathlib import Path
from typing import Any

from asperity.io.table import Table

Call = Callable[[], Any]
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def on_one_thread() -> None:
    """Start the script again where BLAS may use more threads than one: it reads this but once."""
    if any(os.environ.get(name) != "1" for name in THREADS):
        os.environ.update(dict.fromkeys(THREADS, "1"))
        os.execv(sys.executable, [sys.executable, *sys.argv])


def timed(call: Call) -> tuple[float, Any]:
    """Seconds of the processor, as whatever else runs is not the call's; and what it gave."""
    start = time.process_time()
    result = call()
    return time.process_time() - start, result


def seconds(call: Call) -> float:
    return timed(call)[0]


def by_turns(calls: Mapping[str, Call], runs: int, patience: float = 0.3) -> dict[str, list[float]]:
    """Seconds of each call, `runs` times by turns; of those that take longer than `patience`, once.

    A turn calls twice and counts the second: memory is then as the call itself leaves it.
    """
    times = {name: [seconds(call)] for name, call in calls.items()}
    quick = [name for name, result in times.items() if result[0] <= patience]
    for name in quick:
        times[name].clear()
    for _ in range(runs):
        for name in quick:
            calls[name]()
            times[name].append(seconds(calls[name]))
    return times


def median(times: Sequence[float]) -> float:
    return statistics.median(times)


def ratio(yardstick: Sequence[float], times: Sequence[float]) -> float:
    """Median of the yardstick's time over that of the same turn."""
    if len(yardstick) != len(times):
        return median(yardstick) / median(times)
    return statistics.median(y / t for y, t in zip(yardstick, times, strict=True))


def machine() -> str:
    """What it ran on: the kind of processor and its cores, and the day."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="ascii")
        kind = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
        widest = next((f for f in ("avx512f", "avx2", "sse2") if f" {f} " in text), "")
        name = f"{kind[1].strip()}, {widest}" if kind else "a processor without a name"
    except OSError:
        name = "a processor without a name"
    return f"{name}, {os.cpu_count()} cores, {date.today().isoformat()}"


def table(command: str, columns: Mapping[str, Sequence[Any]], **inputs: Any) -> bytes:
    """CSV that says what it ran on."""
    return Table(command, [{"machine": machine(), **inputs}], [], columns).csv().encode()


def markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def number(value: float) -> str:
    """Three digits, without an exponent where there is no need of one."""
    return f"{value:.3g}" if not 999.5 <= value < 1e6 else f"{value:.0f}"
