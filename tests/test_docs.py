"""What the documentation says is so: commands exist, links lead somewhere, pages are fresh."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from uwsim.cli import COMMANDS, reference

ROOT = Path(__file__).parent.parent
PAGES = sorted(
    path
    for path in [*ROOT.glob("*.md"), *ROOT.glob("*/*.md")]
    if not any(part.startswith(".") or part.endswith(".result") for part in path.parts)
)
CALL = re.compile(r"^\$ (?:\.venv/bin/)?(uwsim .*?)(?:\s+#.*)?$", re.MULTILINE)
LINK = re.compile(r"(?<!`)\[[^\]]*\]\(([^)#\s]+)(?:#[^)]*)?\)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


def ids(path: Path) -> str:
    return str(path.relative_to(ROOT))


def calls(path: Path) -> list[list[str]]:
    return [shlex.split(line) for line in CALL.findall(path.read_text())]


def test_the_pages_show_calls_and_links_to_test() -> None:
    assert sum(len(calls(page)) for page in PAGES) >= 5
    assert sum(len(LINK.findall(page.read_text())) for page in PAGES) >= 10


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_call_in_a_page_names_a_command_that_has_those_options(page: Path) -> None:
    for words in calls(page):
        if words[1].startswith("-"):
            continue
        assert words[1] in COMMANDS, words
        known = set(OPTION.findall(reference.section("", words[1], "--help")))
        assert {word.split("=")[0] for word in words if word.startswith("--")} <= known, words


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_link_to_a_file_leads_to_one(page: Path) -> None:
    targets = [link for link in LINK.findall(page.read_text()) if "://" not in link]
    assert [link for link in targets if not (page.parent / link).exists()] == []


def test_the_page_of_the_command_line_is_what_the_program_prints() -> None:
    written = (ROOT / "docs" / "command-line.md").read_text()
    assert written == reference.page(), "run scripts/docs"


def test_every_document_is_reached_from_the_index() -> None:
    linked = LINK.findall((ROOT / "docs" / "index.md").read_text())
    pages = [path.name for path in sorted((ROOT / "docs").glob("*.md"))]
    assert [page for page in pages if page not in [*linked, "index.md"]] == []
