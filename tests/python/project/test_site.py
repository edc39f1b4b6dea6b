"""The documentation that `sh docs/build.sh` built, opened as files in a browser without a network.

`sh tests/stability/long.sh browser` runs this.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.long
SITE = Path(__file__).parents[3] / "build" / "docs" / "html"
CHROMIUM = Path("/usr/bin/chromium")
WIDTHS = {"desktop": 1366, "phone": 390}
PAGES = ("index", "tutorial", "gallery/index", "glossary", "sliding", "reference/command_line")
EQUATIONS = ("explanation/theory", "explanation/heat")
OVER_ITS_NUMBER = """[...document.querySelectorAll("div.math:has(.eqno)")].filter(one => {
    const drawn = one.querySelector("mjx-math, mjx-container svg").getBoundingClientRect();
    return drawn.right > one.querySelector(".eqno").getBoundingClientRect().left;
}).map(one => one.id)"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    playwright = pytest.importorskip("playwright.sync_api", reason="browser tests need playwright")
    if not CHROMIUM.exists():
        pytest.skip("needs Chromium")
    if not (SITE / "searchindex.js").exists():
        pytest.skip("needs the site: sh docs/build.sh")
    with playwright.sync_playwright() as started:
        opened = started.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.fixture
def page(browser: Any, request: pytest.FixtureRequest) -> Iterator[Any]:
    """A page of a browser that has no network; it may ask for files alone and complain of none."""
    width, scheme = getattr(request, "param", ("desktop", "light"))
    context = browser.new_context(
        offline=True, viewport={"width": WIDTHS[width], "height": 900}, color_scheme=scheme
    )
    shown = context.new_page()
    asked: list[str] = []
    said: list[str] = []
    shown.on("request", lambda one: asked.append(one.url))
    shown.on("pageerror", lambda error: said.append(str(error)))
    shown.on("console", lambda one: said.append(one.text) if one.type == "error" else None)
    yield shown
    context.close()
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
    assert said == []


@pytest.mark.parametrize(
    "page", [(width, scheme) for width in WIDTHS for scheme in ("light", "dark")], indirect=True
)
def test_pages_fit(page: Any) -> None:
    """No page is wider than the window, and all of its pictures are there."""
    for name in PAGES:
        page.goto((SITE / f"{name}.html").as_uri())
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), name
        broken = "[...document.images].filter(one => !one.complete || !one.naturalWidth).length"
        assert page.evaluate(broken) == 0, name


def test_equations_end_before_their_numbers(page: Any) -> None:
    seen = 0
    for name in EQUATIONS:
        page.goto((SITE / f"{name}.html").as_uri())
        page.locator("div.math:has(.eqno) :is(mjx-math, svg)").first.wait_for()
        page.evaluate("MathJax.startup.promise.then(() => null)")
        seen += page.locator("div.math:has(.eqno)").count()
        assert page.evaluate(OVER_ITS_NUMBER) == [], name
    assert seen > 10
