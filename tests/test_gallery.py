"""The gallery's pictures are there, small enough, and each has its command."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parent.parent / "docs"
FOLDER = DOCS / "images" / "gallery"
PAGE = (DOCS / "gallery.md").read_text()
NAMES = re.findall(r"images/gallery/([\w-]+)\.jpg", PAGE)
MAX_FILE_SIZE = 200_000
"""The largest size of a picture [byte]."""


@pytest.mark.parametrize("name", NAMES)
def test_each_picture_of_the_page_is_a_small_file(name: str) -> None:
    assert 10_000 < (FOLDER / f"{name}.jpg").stat().st_size <= MAX_FILE_SIZE


def test_the_page_shows_all_pictures_and_states_a_command_for_each() -> None:
    commands = set(re.findall(r"^\$ uwsim render .* -o ([\w-]+)\.png", PAGE, re.MULTILINE))
    assert {path.stem for path in FOLDER.iterdir()} == set(NAMES) == commands | {"sand"}
