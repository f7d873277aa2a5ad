"""A report in a browser: light and dark as the reader's system is, and words in one piece."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from tests.support.synthetic_results import visibility_result
from uwsim.analysis.report import write_report
from uwsim.results.result_file import save

pytestmark = pytest.mark.slow
NAMES = {"corners": "cornersOfTheTargetOverTime", "centroid": "a.measure.with_parts"}
BROKEN = """() => [...document.querySelectorAll("h1, h2, h3, th")].flatMap((heading) => {
    const texts = document.createTreeWalker(heading, NodeFilter.SHOW_TEXT), broken = []
    for (let node = texts.nextNode(); node; node = texts.nextNode())
        for (const word of node.data.matchAll(/[^\\s·-]+/g)) {
            const range = document.createRange()
            range.setStart(node, word.index)
            range.setEnd(node, word.index + word[0].length)
            const tops = new Set([...range.getClientRects()].map((box) => box.top))
            if (tops.size > 1) broken.push(word[0])
        }
    return broken
})"""
"""Words of headings that are on more than one line."""
CONTRAST = """() => {
    const light = (text) => {
        const [r, g, b] = text.match(/[\\d.]+/g).map((v) => (v / 255) ** 2.2)
        return 0.2126 * r + 0.7152 * g + 0.0722 * b
    }
    const sheet = light(getComputedStyle(document.querySelector("main")).backgroundColor)
    const inks = ["h1", ".lead", ".card .value", ".status", "figcaption", "td.reason", "summary"]
        .map((one) => document.querySelector(one)).filter(Boolean)
        .map((one) => light(getComputedStyle(one).color))
    const contrast = (ink) => (Math.max(ink, sheet) + 0.05) / (Math.min(ink, sheet) + 0.05)
    return [sheet, ...inks.map(contrast)]
}"""
"""Lightness of the sheet, and contrast of what is written on it (WCAG 2)."""


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A report whose measures have long names."""
    base = visibility_result()
    columns = tuple(replace(c, name=NAMES.get(c.name, c.name)) for c in base.columns)
    missing = tuple(replace(m, column=NAMES.get(m.column, m.column)) for m in base.missing_values)
    folder = tmp_path_factory.mktemp("report")
    save(replace(base, columns=columns, missing_values=missing), folder)
    return write_report(folder).as_uri()


@pytest.mark.parametrize("width", [390, 800, 1280])
def test_no_word_of_a_heading_is_broken(tab: Any, report: str, width: int) -> None:
    tab.set_viewport_size({"width": width, "height": 800})
    tab.goto(report)
    assert tab.locator("th").count() > 10
    assert tab.evaluate(BROKEN) == []
    assert tab.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_report_is_light_or_dark_as_the_reader_has_it_and_dark_on_white_in_print(
    tab: Any, report: str, scheme: str
) -> None:
    tab.emulate_media(color_scheme=scheme)
    tab.goto(report)
    sheet, *contrasts = tab.evaluate(CONTRAST)
    assert (sheet < 0.1) is (scheme == "dark")
    assert len(contrasts) > 4
    assert min(contrasts) >= 4.5
    plot = "getComputedStyle(document.querySelector('.plots img')).filter"
    assert (tab.evaluate(plot) != "none") is (scheme == "dark")
    tab.emulate_media(color_scheme=scheme, media="print")
    assert tab.evaluate(CONTRAST)[0] == pytest.approx(1.0)
    assert tab.evaluate(plot) == "none"
