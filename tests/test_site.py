"""The documentation site is built, has its pages, formulas and images, and opens from disk."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from lxml import html

ROOT = Path(__file__).parent.parent
SITE = ROOT / "scripts" / "site"
sys.path.insert(0, str(SITE))

NOT_THERE = "the site's tools are not installed: scripts/setup docs"
pytest.importorskip("latex2mathml", reason=NOT_THERE)

from formulas import with_mathml  # noqa: E402
from links import broken_links, network_sources  # noqa: E402


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("zensical", reason=NOT_THERE)
    out = tmp_path_factory.mktemp("docs") / "site"
    command = [sys.executable, str(SITE / "build.py"), str(out)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return out


@pytest.mark.slow
def test_every_page_of_docs_is_a_page_of_the_site(site: Path) -> None:
    written = {path.stem for path in (ROOT / "docs").glob("*.md")}
    built = {path.stem for path in site.glob("*.html")}
    assert written <= built
    assert {"CHANGELOG", "CONTRIBUTING", "scenes"} <= built


@pytest.mark.slow
def test_every_page_is_reached_from_the_first(site: Path) -> None:
    links = html.parse(site / "index.html").getroot().xpath("//nav//a/@href")
    linked = {link.split("#")[0].removeprefix("./") for link in links}
    pages = {path.relative_to(site).as_posix() for path in site.rglob("*.html")}
    assert pages - linked <= {"404.html", "index.html"}


@pytest.mark.slow
def test_the_reference_says_what_docstrings_say(site: Path) -> None:
    text = html.parse(site / "reference" / "uwsim.statistics.html").getroot().text_content()
    assert "Return the mean" in text or "A mean and where it lies" in text
    assert "mean_interval" in text


def test_a_formula_becomes_mathml() -> None:
    page = with_mathml(r'<p><span class="arithmatex">\(a^2 &lt; b\)</span></p>')
    assert "<msup>" in page
    assert "arithmatex" not in page
    assert with_mathml("<p>none</p>") == "<p>none</p>"


def test_a_broken_link_an_anchor_and_a_script_of_the_network_are_found(tmp_path: Path) -> None:
    (tmp_path / "b.html").write_text('<html><body id="top">b</body></html>')
    (tmp_path / "a.html").write_text(
        '<html><head><script src="https://example.org/x.js"></script></head><body>'
        '<a href="b.html#top">good</a><a href="b.html#no">bad</a>'
        '<a href="c.html">bad</a></body></html>'
    )
    assert broken_links(tmp_path) == [
        "a.html: b.html#no has no such anchor",
        "a.html: c.html does not exist",
    ]
    assert network_sources(tmp_path) == [
        "a.html: https://example.org/x.js is loaded from the network"
    ]
