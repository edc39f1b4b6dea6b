"""How soon the app shows a change in a browser: by the wall clock, so it wants a quiet machine.

    python tests/benchmarks/app.py [--output DIR] [--changes 50]

A key moves the slider of the pressure, then that of the temperature, by turns. Inside of the page a
clock runs from the slider's event `input` until the line of mu has another shape, and on to the
next frame that is painted; further until nothing is to follow: the hot curve and the band. Half of
the changes wait for all of the one before, the others come while its band is still computed. With
ASPERITY_DATA the scan opd-1 with the master curve of epdm_70's sweeps comes first, dropped as a
user drops them; then the demo. What server and page spend is processor time, all that follows
included. Then the time from the command to the first curve, the browser being open. Needs Chromium
and Playwright, as the tests in a browser.
"""

import os
import signal
import subprocess
import sys
import time
from argparse import ArgumentParser
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import measured
import timing
from playwright.sync_api import Page, sync_playwright

from asperity.io.files import write_files

CHROMIUM = "/usr/bin/chromium"
SLOW = 120_000  # ms
PAUSE = 150  # ms, after which heat and band are being computed
SLIDERS = ("Pressure [MPa]", "Temperature [°C]")

# mu is the widest line of the chart of friction; what it was at the event is what is replaced
_WATCH = """() => {
  const result = document.querySelector('section[aria-labelledby=result-title]');
  const shape = () => result.querySelector('svg path[stroke-width="3"]')?.getAttribute('d');
  window.changes = [];
  let now = null;
  addEventListener('input', (event) => {
    if (event.target.type !== 'range') return;
    now = { start: performance.now(), shape: shape() };
    window.changes.push(now);
  }, true);
  new MutationObserver(() => {
    if (!now) return;
    if (!now.curve && shape() !== now.shape) {
      now.curve = performance.now() - now.start;
      const mine = now;
      requestAnimationFrame(() => setTimeout(() => {
        mine.painted = performance.now() - mine.start;
      }));
    }
    if (now.curve && !now.all && result.ariaBusy === 'false')
      now.all = performance.now() - now.start;
  }).observe(result, { subtree: true, childList: true, attributes: true, characterData: true });
}"""


@contextmanager
def app() -> Iterator[tuple[str, int, float]]:
    """Its address, its process and when it was started."""
    started = time.perf_counter()
    run = [sys.executable, "-m", "asperity", "app", "--no-browser"]
    with subprocess.Popen(run, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            yield process.stdout.readline().strip(), process.pid, started
        finally:
            process.send_signal(signal.SIGTERM)


def settle(page: Page) -> None:
    """Wait until nothing is to follow."""
    time.sleep(1)  # until the change before has begun
    page.locator("section[aria-busy=false]").wait_for(timeout=SLOW)


def drop_measured(page: Page, data: Path) -> None:
    """opd-1 and the sweeps of epdm_70 as its master curve, at velocities that it covers."""
    inside = page.get_by_role("region", name="Surface").locator("input[type=file]")
    inside.set_input_files(data / "topography" / "opd-1.opd")
    page.get_by_role("img", name="Map of the heights").wait_for(timeout=SLOW)
    settle(page)
    inside = page.get_by_role("region", name="Rubber").locator("input[type=file]")
    inside.set_input_files(data / "dma" / "epdm_70" / "tf_015p.csv")
    page.get_by_role("checkbox", name="Fit a Prony series").click(timeout=SLOW)
    page.get_by_label("Fastest velocity [m/s]", exact=True).fill("0.05")
    page.get_by_role("button", name="Make the master curve").click()
    page.get_by_text("isotherms that overlap").wait_for(timeout=SLOW)
    settle(page)


def used(process: int) -> float:
    """Seconds of the processor that it has used."""
    cells = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(cells[11]) + int(cells[12])) / os.sysconf("SC_CLK_TCK")


def changed(page: Page, process: int, changes: int) -> dict[str, list[float]]:
    """Milliseconds of so many changes, and of as many while something still follows."""
    page.evaluate(_WATCH)
    clock = page.context.new_cdp_session(page)
    clock.send("Performance.enable", {"timeDomain": "threadTicks"})
    server, drawn = used(process), _busy(clock)
    times: dict[str, list[float]] = {}
    for i in range(2 * changes):
        slider = page.get_by_role("slider", name=f"{SLIDERS[i % 2]}, slider")
        slider.focus()
        page.keyboard.press("ArrowRight" if i // 2 % 2 == 0 else "ArrowLeft")
        last = "all" if i < changes else "painted"
        page.wait_for_function(f"() => window.changes[{i}]?.{last}", timeout=SLOW)
        if i == changes - 1:
            times["server"] = [1e3 * (used(process) - server) / changes]
            times["page"] = [1e3 * (_busy(clock) - drawn) / changes]
        if i >= changes:
            page.wait_for_timeout(PAUSE)
    found = page.evaluate("() => window.changes")
    assert len(found) == 2 * changes
    for name in ("curve", "painted", "all"):
        times[name] = [one[name] for one in found[:changes]]
    times["during"] = [one["curve"] for one in found[changes:]]
    return times


def _busy(clock: Any) -> float:
    """Seconds that the page's thread was busy."""
    found = clock.send("Performance.getMetrics")["metrics"]
    return float(next(one["value"] for one in found if one["name"] == "TaskDuration"))


def scene_of(page: Page, name: str) -> None:
    """Let the page show one of the scenes that are measured."""
    if "heat" in name:
        page.get_by_role("switch", name="Heat of sliding").click()
    settle(page)


def table(found: dict[str, dict[str, list[float]]]) -> str:
    rows = []
    for name, times in found.items():
        spans = [times[key] for key in ("curve", "during", "painted", "all")]
        cells = [f"{timing.median(one):.0f}, {max(one):.0f}" for one in spans]
        rows.append([name, *cells, *(f"{times[key][0]:.0f}" for key in ("server", "page"))])
    head = ["ms: median, worst", "curve", "during a band", "painted", "heat and band"]
    return timing.markdown([*head, "server, processor", "page, processor"], rows)


def measure(changes: int) -> tuple[str, dict[str, bytes]]:
    data = measured.folder()
    found: dict[str, dict[str, list[float]]] = {}
    starts: list[tuple[float, float]] = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        names = (["opd-1, epdm_70"] if data is not None else []) + ["demo"]
        for name in [one + heat for one in names for heat in ("", ", heat")]:
            page = browser.new_page(viewport={"width": 1280, "height": 900})
            with app() as (address, process, started):
                addressed = time.perf_counter() - started
                page.goto(address)
                page.locator('svg path[stroke-width="3"]').first.wait_for(
                    state="attached", timeout=SLOW
                )
                starts.append((addressed, time.perf_counter() - started))
                settle(page)
                if name.startswith("opd-1") and data is not None:
                    drop_measured(page, data)
                scene_of(page, name)
                found[name] = changed(page, process, changes)
            page.close()
        browser.close()
    addressed, first = (timing.median(one) for one in zip(*starts, strict=True))
    text = table(found) + (
        f"\nFrom the command to its address {addressed:.1f} s, to the first curve {first:.1f} s.\n"
        f"{changes} changes; {timing.machine()}; load {os.getloadavg()[0]:.1f}.\n"
    )
    return text, {"app.csv": _csv(found, changes)}


def _csv(found: dict[str, dict[str, list[float]]], changes: int) -> bytes:
    columns: dict[str, Sequence[Any]] = {"scene": list(found)}
    for key in ("curve", "during", "painted", "all"):
        columns[f"{key}_ms"] = [round(timing.median(one[key]), 1) for one in found.values()]
        columns[f"worst_{key}_ms"] = [round(max(one[key]), 1) for one in found.values()]
    load = round(os.getloadavg()[0], 1)
    return timing.table("tests/benchmarks/app.py", columns, changes=changes, load=load)


if __name__ == "__main__":
    parser = ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--output", type=Path, help="folder for app.csv; else it is not written")
    parser.add_argument("--changes", type=int, default=50)
    given = parser.parse_args()
    text, files = measure(given.changes)
    print(text, end="")
    if given.output is not None:
        write_files({given.output / name: data for name, data in files.items()})
