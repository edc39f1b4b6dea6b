"""A report says what the shell says, from the files that it names, in a page that needs nothing."""

import base64
import csv
import itertools
import re
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from xml.etree.ElementTree import Element

import pytest

import asperity
from asperity.cli.main import main
from asperity.demo import input_files
from asperity.report.drawings import Drawings, Figure
from asperity.report.make import report_page
from asperity.scene.model import Progress
from helpers.accessible import violations
from helpers.scenes import ADHESION, RUBBER, SURFACE

pytest.importorskip("matplotlib", reason="reports need asperity[plot]")
html5lib = pytest.importorskip("html5lib", reason="its parser is the judge of pages")

SCAN = """
[surface]
file = "scan.npy"
pixel_size_m = [110e-6, 90e-6]
unit = "m"
detrend = "quadratic"
q0_per_m = 2000.0
slope_cutoff = 1.3
"""
FEW = "[conditions]\npressure_pa = 81e3\nvelocity_m_s = {from = 1e-4, to = 1, points = 4}\n"
NASTY = "</code></pre><script>alert(1)</script>"
PARTIAL = '[correction]\nkind = "partial-contact"\n'


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two scenes and a report of both."""
    folder = tmp_path_factory.mktemp("report")
    (folder / "scan.npy").write_bytes(input_files()["scan.npy"])
    scene = f"# {NASTY}\n{SCAN}{RUBBER}{FEW}{PARTIAL}"
    (folder / "a & <b>.toml").write_text(scene)
    (folder / "sticky.toml").write_text(scene + ADHESION)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        run = ["report", "a & <b>.toml", "sticky.toml", "--output", "both.html"]
        assert main(run) == 0
    return folder


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are seconds each; those of `place` are drawn."""
    monkeypatch.setattr(Drawings, "_figure", lambda *_: Figure("", "", ""))


@pytest.fixture(scope="module")
def page(place: Path) -> str:
    return (place / "both.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tree(page: str) -> Element:
    """The page as a strict parser reads it: any error of syntax raises."""
    result: Element = html5lib.HTMLParser(
        strict=True, tree=html5lib.getTreeBuilder("etree"), namespaceHTMLElements=False
    ).parse(page)
    return result


def every(tree: Element, name: str) -> Iterator[Element]:
    return (one for one in tree.iter() if one.tag == name or str(one.tag).endswith(f"}}{name}"))


def said(element: Element) -> str:
    return " ".join("".join(element.itertext()).split())


def test_a_strict_parser_reads_it_and_no_id_is_there_twice(tree: Element) -> None:
    ids = Counter(one.get("id") for one in tree.iter() if one.get("id"))
    assert max(ids.values()) == 1
    assert len(ids) > 50
    for one in tree.iter():  # and what is referred to is there
        for value in one.attrib.values():
            for name in re.findall(r"^#(.+)$|url\(#([^)]+)\)", value):
                assert "".join(name) in ids, value


def test_it_loads_nothing_and_runs_nothing(page: str, tree: Element) -> None:
    assert not list(every(tree, "script"))
    addresses = []
    for one in tree.iter():
        for key, value in one.attrib.items():
            assert not str(key).startswith("on"), key
            if str(key).split("}")[-1] in ("href", "src", "action", "poster", "data", "srcset"):
                addresses.append(value)
    assert len(addresses) > 20
    assert {re.match(r"#|data:\w+/\w+;base64,", one) is not None for one in addresses} == {True}
    style = said(next(every(tree, "style")))
    assert "@import" not in style
    assert "url(" not in style


def test_who_does_not_see_it_can_read_it(tree: Element) -> None:
    assert tree.get("lang") == "en"
    assert said(next(every(tree, "title"))) == "Friction of a & <b>.toml, sticky.toml"
    levels = [int(one.tag[1]) for one in tree.iter() if re.fullmatch("h[1-6]", str(one.tag))]
    assert (levels[0], levels.count(1)) == (1, 1)
    assert all(b - a <= 1 for a, b in itertools.pairwise(levels))
    for one in every(tree, "svg"):
        assert one.get("role") == "img"
        assert len(one.get("aria-label", "")) > 40
    for table in every(tree, "table"):
        assert said(table.find("caption"))
        assert all(head.get("scope") == "col" for head in every(table, "th"))


def test_its_digits_are_those_of_the_shell(
    place: Path, tree: Element, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(place)
    assert main(["friction", "a & <b>.toml", "sticky.toml", "--output", "mu.csv"]) == 0
    (link,) = (one for one in every(tree, "a") if one.get("download") == "friction.csv")
    saved = base64.b64decode(link.get("href", "").partition(",")[2]).decode()
    assert saved == (place / "mu.csv").read_text()
    lines = [line for line in saved.splitlines() if not line.startswith("#")]
    rows = [row for row in csv.DictReader(lines) if row["scene"] == "sticky.toml"]
    tables = [one for one in every(tree, "table") if said(one.find("caption")).startswith("mu and")]
    cells = [[said(cell) for cell in every(row, "td")] for row in every(tables[1], "tr")][1:]
    shown = [(row[1], row[2]) for row in cells]
    assert shown == [(f"{float(r['velocity_m_s']):.4g}", f"{float(r['mu']):.4g}") for r in rows]


def test_the_scene_can_be_copied_out(place: Path, tree: Element) -> None:
    texts = ["".join(one.itertext()) for one in every(tree, "pre")]
    assert texts == [(place / name).read_text() for name in ("a & <b>.toml", "sticky.toml")]
    links = [
        one.get("href", "") for one in every(tree, "a") if one.get("download") == "sticky.toml"
    ]
    assert base64.b64decode(links[0].partition(",")[2]).decode() == texts[1]


def test_all_three_errors_are_told(page: str, tree: Element) -> None:
    tables = [one for one in every(tree, "table") if "may be off" in said(one.find("caption"))]
    assert len(tables) == 2
    rows = {said(row[0]): said(row[1]) for row in every(tables[0], "tr") if len(row) == 3}
    assert re.fullmatch(r"at most \S+ of mu", rows["the numbers"])
    assert re.fullmatch(r"mu is down to \S+ % lower and up to \S+ % higher", rows["the inputs"])
    assert re.match(r"[\d.]+ (to [\d.]+ )?% of the hysteresis", rows["the model"])


def test_the_comparison_tells_inputs_and_differences(tree: Element) -> None:
    (table,) = (one for one in every(tree, "table") if "not the same" in said(one.find("caption")))
    rows = [[said(cell) for cell in every(row, "td")] for row in every(table, "tr")][1:]
    assert ["[adhesion] shear_stress_pa", "not given", "8300000.0"] in rows
    assert all(row[0].startswith("[adhesion]") for row in rows)
    lines = [said(one) for one in every(tree, "li")]
    assert any(re.match(r"\d of 4 points differ by more than all errors", one) for one in lines)


def test_python_writes_the_same_bytes(
    undrawn: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    Path("law.toml").write_text(SURFACE + RUBBER + FEW)
    asperity.report("law.toml", "one.html")
    asperity.report([Path("law.toml")], Path("two.html"))
    one = Path("one.html").read_bytes()
    assert one == Path("two.html").read_bytes()
    assert b"on 1970-01-02" in one
    assert b"<td>the inputs</td><td>not known</td>" in one  # of a law in numbers
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(asperity.InvalidInput, match="SOURCE_DATE_EPOCH = 'yesterday': must be"):
        asperity.report("law.toml", "one.html")
    assert Path("one.html").read_bytes() == one


def test_the_day_is_that_of_the_last_whole_second_and_each_picture_a_step(
    undrawn: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps: Counter[str] = Counter()

    def bar(title: str) -> Progress:
        def progress(chunks: Sequence[slice]) -> AbstractContextManager[Iterable[slice]]:
            steps[title] += len(chunks)
            return nullcontext(chunks)

        return progress

    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    monkeypatch.setattr(time, "time", lambda: 86399.7)
    for name in ("one.toml", "two.toml"):
        (tmp_path / name).write_text(SURFACE + RUBBER + FEW)
    page = report_page([tmp_path / "one.toml", tmp_path / "two.toml"], bar=bar)
    assert "on 1970-01-01" in page
    assert steps["pictures"] == 7  # the overview, three of each file


def test_a_number_without_a_digit_of_its_own_is_told(undrawn: None, tmp_path: Path) -> None:
    """Friction without loss: mu is zero, and no ratio to it is written."""
    (tmp_path / "elastic.toml").write_text(
        SURFACE
        + "[rubber]\nequilibrium_modulus_pa = 2e6\nmoduli_pa = []\nrelaxation_times_s = []\n"
        + FEW
    )
    asperity.report(tmp_path / "elastic.toml", tmp_path / "elastic.html")
    page = (tmp_path / "elastic.html").read_text()
    assert "at most 0 of mu" in page
    assert not re.search(r">\s*(nan|inf|-?nan %)\s*<", page)


@pytest.mark.parametrize(("width", "scheme"), [(390, "dark"), (1280, "light")])
def test_a_browser_shows_it(place: Path, width: int, scheme: str) -> None:
    """It fits the width, asks for nothing else, and prints to a few pages."""
    playwright = pytest.importorskip("playwright.sync_api", reason="browser tests need playwright")
    chromium = Path("/usr/bin/chromium")
    if not chromium.exists():
        pytest.skip("needs Chromium")
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=str(chromium), args=["--no-sandbox"])
        opened = browser.new_page(viewport={"width": width, "height": 800}, color_scheme=scheme)
        asked: list[str] = []
        opened.on("request", lambda request: asked.append(request.url))
        opened.on("console", lambda message: asked.append(message.text))
        opened.goto((place / "both.html").as_uri())
        assert len(asked) - sum(one.startswith("data:") for one in asked) == 1
        assert opened.evaluate("document.documentElement.scrollWidth") <= width
        assert opened.locator("svg.wide").first.is_visible() == (width > 640)
        assert opened.locator("svg.narrow").first.is_visible() == (width <= 640)
        assert violations(opened) == []
        pages = len(re.findall(rb"/Type\s*/Page\b", opened.pdf(prefer_css_page_size=True)))
        assert 4 <= pages <= 16
        browser.close()
