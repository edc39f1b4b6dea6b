"""The app in a browser: from two dropped files to a report, wrong files, tabs, keys, no outside."""

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from asperity.cli.main import main
from helpers.accessible import violations
from helpers.dropped import dma_bytes, scan_bytes
from helpers.served import served

pytest.importorskip("nicegui", reason="the app needs asperity[app]")
pytest.importorskip("matplotlib", reason="the app needs asperity[app]")
playwright = pytest.importorskip("playwright.sync_api", reason="browser tests need playwright")
CHROMIUM = Path("/usr/bin/chromium")
if not CHROMIUM.exists():
    pytest.skip("needs Chromium", allow_module_level=True)

SLOW = 60_000  # ms: for machines that do other things too


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    playwright.expect.set_options(timeout=SLOW)
    with playwright.sync_playwright() as started:
        opened = started.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served() as (line, _):
        yield line


class Tab:
    """A page of the app, and everything that it asked for and complained of."""

    def __init__(self, browser: Any, address: str, width: int = 1280, **options: Any) -> None:
        self.context = browser.new_context(viewport={"width": width, "height": 900}, **options)
        self.page = self.context.new_page()
        self.page.set_default_timeout(SLOW)
        self.asked: list[str] = []
        self.said: list[str] = []
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("console", self._hear)
        self.page.goto(address)
        self.settled()

    def _hear(self, one: Any) -> None:
        if one.type == "error":
            self.said.append(one.text)

    def settled(self) -> None:
        """Wait until nothing is to follow."""
        self.page.locator("section[aria-busy=false]").wait_for()
        playwright.expect(self.status).to_have_text(re.compile(r"^largest mu [\d.]+ at \S+ m/s$"))

    @property
    def status(self) -> Any:
        return self.page.get_by_role("status")

    @property
    def curve(self) -> Any:
        return self.page.get_by_role("img", name="Friction coefficient mu over").first

    @property
    def chart(self) -> str:
        return str(self.curve.get_attribute("aria-label"))

    def problem(self, part: str) -> Any:
        return self.page.get_by_role("region", name=part).get_by_role("alert")

    def drop(self, part: str, *files: dict[str, Any]) -> None:
        inside = self.page.get_by_role("region", name=part).locator("input[type=file]")
        inside.set_input_files(list(files))

    def download(self, name: str, folder: Path) -> Path:
        with self.page.expect_download(timeout=4 * SLOW) as waited:
            self.page.get_by_role("button", name=name, exact=True).click()
        path = folder / waited.value.suggested_filename
        waited.value.save_as(path)
        return path


@pytest.fixture
def tab(browser: Any, address: str) -> Iterator[Tab]:
    one = Tab(browser, address)
    yield one
    origin = address.partition("?")[0].partition("//")[2]
    inside = re.compile(rf"(https?|ws)://{re.escape(origin)}|data:|blob:")
    assert [url for url in one.asked if not inside.match(url)] == []
    assert one.said == []
    one.context.close()


def file_of(name: str, content: bytes) -> dict[str, Any]:
    return {"name": name, "mimeType": "application/octet-stream", "buffer": content}


def test_from_two_files_to_a_report(
    tab: Tab, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened = tab.chart
    page = tab.page
    page.get_by_label("Name of this curve").fill("demo")
    page.get_by_role("button", name="Keep for comparison").click()
    page.get_by_role("button", name="Remove demo from the comparison").wait_for()

    tab.drop("Surface", file_of("my scan.npy", scan_bytes()))
    playwright.expect(tab.problem("Surface")).to_contain_text("my scan.npy")
    playwright.expect(tab.problem("Surface")).to_contain_text("missing")
    page.get_by_role("button", name="How the scan is read").click()
    page.get_by_label("Pixel size").fill("5")
    page.get_by_label("Unit of the heights").click()
    page.get_by_role("option", name="µm").click()
    playwright.expect(tab.problem("Surface")).to_have_text("")
    tab.settled()
    page.get_by_role("img", name="Map of the heights; 0.64 by 0.64 mm").wait_for()

    tab.drop("Rubber", file_of("dma.csv", dma_bytes()))
    for label, value in (
        ("Frequency is column", "Freq"),
        ("Storage is column", "G'"),
        ("Loss is column", 'G"'),
        ("Temp. is column", "Temperature"),
        ("Frequency in", "Hz"),
        ("Moduli in", "MPa"),
        ("Temperature in", "°C"),
        ("The moduli are", "G, shear"),
    ):
        playwright.expect(page.get_by_label(label, exact=True)).to_have_value(value)
    page.get_by_role("button", name="Make the master curve").click()
    page.get_by_text("of 7 isotherms that overlap").wait_for()
    page.get_by_role("img", name="Shift factors").wait_for()
    # the sweeps know fewer velocities than the surrogate did
    page.get_by_role("button", name="which are known").click()
    tab.settled()
    assert tab.chart != opened

    page.get_by_role("switch", name="Heat of sliding").click()
    page.get_by_label("Contact diameter [mm]", exact=True).wait_for()
    tab.curve.get_by_text("without heat").wait_for()  # the cold curve, which heat follows
    tab.settled()

    report = tab.download("Report", tmp_path).read_text()
    assert "against scene.toml" in report
    assert "was dropped as my scan.npy" in report
    assert "heating.contact_diameter_m" in report
    table = tab.download("CSV", tmp_path)
    assert tab.download("Picture", tmp_path).read_bytes().startswith(b"<?xml")
    with zipfile.ZipFile(tab.download("Scene", tmp_path)) as archive:
        archive.extractall(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == 0
    assert (tmp_path / "mu.csv").read_bytes() == table.read_bytes()


def test_a_scan_of_100_mb_becomes_the_surface(tab: Tab, tmp_path: Path) -> None:
    path = tmp_path / "large.npy"
    heights = np.random.default_rng(1).standard_normal((5000, 5000), dtype=np.float32)
    np.save(path, heights.cumsum(0).cumsum(1) * 1e-3)
    assert path.stat().st_size > 100e6
    before = tab.chart
    tab.page.get_by_role("button", name="How the scan is read").click()
    tab.page.get_by_label("Pixel size").fill("10")
    tab.page.get_by_label("Unit of the heights").click()
    tab.page.get_by_role("option", name="µm").click()
    inside = tab.page.get_by_role("region", name="Surface").locator("input[type=file]")
    inside.set_input_files(str(path))
    tab.page.get_by_role("img", name="Map of the heights; 50 by 50 mm").wait_for()
    playwright.expect(tab.page.get_by_role("img", name=before)).to_have_count(0)
    tab.settled()


def test_files_that_do_not_arrive_say_so_and_others_arrive_after(tab: Tab) -> None:
    before = tab.chart
    tab.page.route("**/upload/*", lambda route: route.abort())
    tab.drop("Surface", file_of("scan.npy", scan_bytes()))
    playwright.expect(tab.problem("Surface")).to_contain_text("scan.npy did not arrive: ")
    tab.drop("Rubber", file_of("dma.csv", dma_bytes()), file_of("more.csv", dma_bytes()))
    playwright.expect(tab.problem("Rubber")).to_contain_text("dma.csv, more.csv did not arrive: ")
    tab.page.unroute("**/upload/*")
    assert [one for one in tab.said if "net::ERR_FAILED" not in one] == []
    tab.said.clear()
    long = "x" * 3000 + ".npy"
    tab.drop("Surface", file_of(long, scan_bytes()))
    playwright.expect(tab.problem("Surface")).to_contain_text("missing")
    tab.drop("Rubber", file_of("dma.csv", dma_bytes()))
    tab.page.get_by_role("button", name="Make the master curve").wait_for()
    playwright.expect(tab.problem("Rubber")).to_have_text("")
    for name in ("Drop a scan here, or choose a file", "Drop DMA sweeps"):
        playwright.expect(tab.page.get_by_role("button", name=name)).to_be_visible()
    assert tab.chart == before


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(browser: Any, address: str, scheme: str) -> None:
    """As it opens, with everything open, and with menus and problems of dropped files."""
    tab = Tab(browser, address, color_scheme=scheme)
    assert violations(tab.page) == []
    for name in ("Open a scene", "How the scan is read", "Numbers", "The scene file"):
        tab.page.get_by_role("button", name=name).click()
    tab.page.get_by_role("button", name="Which roughness makes the friction").click()
    tab.page.get_by_role("switch", name="Heat of sliding").click()
    tab.drop("Surface", file_of("paper.pdf", b"%PDF-1.7 no scan"))
    playwright.expect(tab.problem("Surface")).to_contain_text("paper.pdf")
    tab.drop("Rubber", file_of("dma.csv", dma_bytes()))
    tab.page.get_by_role("button", name="Make the master curve").wait_for()
    tab.page.get_by_role("img", name="Contributions to the hysteresis").wait_for()
    tab.settled()
    tab.page.get_by_role("button", name="Keep for comparison").click()
    tab.page.get_by_role("button", name="from the comparison").wait_for()
    assert violations(tab.page) == []
    tab.context.close()


def test_keys_alone_lead_everywhere_and_everything_has_a_name(tab: Tab) -> None:
    seen = tab.page.locator("body").aria_snapshot()
    nameless = re.findall(
        r"- (?:button|textbox|slider|combobox|switch|checkbox|region)(?! \")[^\n]*", seen
    )
    assert nameless == []
    reached = set()
    for _ in range(60):
        tab.page.keyboard.press("Tab")
        reached.add(
            tab.page.evaluate(
                "() => { const e = document.activeElement;"
                " return e.getAttribute('aria-label') || e.innerText || e.id }"
            )
        )
    for name in ("Pressure [MPa], slider", "Surface", "Rubber", "Keep for comparison"):
        assert any(name in one for one in reached), (name, reached)
    before = tab.chart
    tab.page.get_by_role("slider", name="Temperature [°C], slider").focus()
    for _ in range(5):
        tab.page.keyboard.press("ArrowRight")
    field = tab.page.get_by_label("Temperature [°C]", exact=True)
    playwright.expect(field).to_have_value("25")
    playwright.expect(tab.curve).not_to_have_attribute("aria-label", before)
    tab.settled()


def test_tabs_are_sessions_of_their_own_and_a_reload_finds_its(browser: Any, address: str) -> None:
    first, second = Tab(browser, address), Tab(browser, address)
    opened = first.chart
    first.page.get_by_label("Pressure [MPa]", exact=True).fill("1")
    playwright.expect(first.page.get_by_role("img", name=opened)).to_have_count(0)
    first.settled()
    changed = first.chart
    second.page.get_by_role("switch", name="Adhesion").click()
    playwright.expect(second.page.get_by_role("img", name=opened)).to_have_count(0)
    assert first.chart == changed
    assert "token" not in first.page.url
    first.page.reload()
    first.settled()
    assert first.chart == changed
    assert first.page.get_by_label("Pressure [MPa]", exact=True).input_value() == "1"
    for one in (first, second):
        one.context.close()


@pytest.mark.parametrize("width", [390, 1280])
def test_it_fits_the_width(browser: Any, address: str, width: int) -> None:
    tab = Tab(browser, address, width)
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= width
    result = tab.page.get_by_role("region", name="Result").bounding_box()
    surface = tab.page.get_by_role("region", name="Surface").bounding_box()
    assert (result["x"] > surface["x"]) == (width > 900)
    tab.context.close()
