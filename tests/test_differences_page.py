"""docs/differences.md has every quirk of the original, once, in the only table of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from uwsim.base.compatibility import COMPATIBILITY

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "differences.md"
SWITCH = re.compile(r"\| `([a-z0-9-]+)` \|$", re.M)


def test_every_quirk_stands_in_the_table_and_only_once() -> None:
    assert sorted(SWITCH.findall(PAGE.read_text())) == sorted(COMPATIBILITY)


@pytest.mark.parametrize("page", sorted(DOCS.glob("*.md")), ids=lambda page: page.stem)
def test_there_is_one_table_of_differences(page: Path) -> None:
    heads = re.findall(r"^\|.*\| the original \|", page.read_text(), re.M)
    assert len(heads) == (1 if page == PAGE else 0)


def test_every_row_says_what_the_original_does_and_what_we_do() -> None:
    rows = [line for line in PAGE.read_text().split("\n") if line.startswith("| ")][2:]
    assert len(rows) > 40
    for row in rows:
        cells = [cell.strip() for cell in row.strip("|").split(" | ")]
        assert len(cells) in (3, 4), row
        assert all(cells[:3]), row
