"""What the documentation says is so: commands exist, links lead somewhere, pages are fresh."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import pytest
from typer.main import get_command

from scripts.reference import command_line
from tests.support.documented import read_commands
from uwsim.assets.bundled import bundled_files
from uwsim.cli import COMMANDS
from uwsim.cli.app import build_application

ROOT = Path(__file__).parent.parent
PAGES = sorted(
    path
    for path in [*ROOT.glob("*.md"), *ROOT.glob("*/*.md")]
    if not any(part.startswith(".") or part.endswith(".result") for part in path.parts)
)
FILES_OF_THE_USER = ("my-scene.xml", "simpleBenchmark.xml")
INLINE = re.compile(r"`(uwsim [a-z]+ [^`]*)`")
LINK = re.compile(r"(?<!`)\[[^\]]*\]\(([^)#\s]+)(?:#[^)]*)?\)")
ANCHOR = re.compile(r"(?<!`)\[[^\]]*\]\(([^)#\s]*)#([^)\s]+)\)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


def ids(path: Path) -> str:
    return str(path.relative_to(ROOT))


def typed(page: Path) -> list[tuple[str, ...]]:
    """Every command of a page's consoles, without variables (``PYTHONPATH=.``) and ``> FILE``."""
    found = []
    for command in read_commands(page.read_text()):
        words = command.words
        while "=" in words[0]:
            words = words[1:]
        found.append(words[: words.index(">")] if ">" in words else words)
    return found


def test_the_pages_show_calls_and_links_to_test() -> None:
    assert sum(len(typed(page)) for page in PAGES) >= 40
    assert sum(len(LINK.findall(page.read_text())) for page in PAGES) >= 10


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_call_of_uwsim_is_one_that_the_program_takes(page: Path) -> None:
    for words in typed(page):
        if words[0] == "uwsim" and not words[1].startswith("-"):
            command = get_command(build_application(words[1:])).commands[words[1]]
            n = 2 if COMMANDS[words[1]].subcommands and len(words) > 2 else 1
            command = command.commands[words[2]] if n == 2 else command
            command.make_context(words[n], list(words[n + 1 :]))  # raises where it is wrong


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_call_within_a_sentence_names_a_command_that_has_those_options(page: Path) -> None:
    for call in INLINE.findall(page.read_text()):
        words = call.split()
        if words[1] in COMMANDS:
            n = 3 if COMMANDS[words[1]].subcommands else 2
            known = set(OPTION.findall(command_line.section("", *words[1:n], "--help")))
            assert set(OPTION.findall(call)) <= known, call


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_other_command_is_there(page: Path) -> None:
    targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.MULTILINE)
    for first, *rest in typed(page):
        if first in ("python", ".venv/bin/python"):
            assert (ROOT / rest[0]).is_file() or rest[0] == "-m", rest
        elif first == "make":
            assert set(rest) <= set(targets), rest
        elif first.startswith("scripts/"):
            assert (ROOT / first).is_file(), first
        else:
            assert first in ("uwsim", "pip", "source", "git", "cd", "mkdir"), first


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_scenes_and_benchmarks_have_names_that_are_there(page: Path) -> None:
    text = page.read_text()
    names = bundled_files("scenes").keys() | bundled_files("benchmarks").keys()
    for words in typed(page):
        if words[:1] == ("uwsim",) and words[1] in ("bench", "envelope", "info", "render"):
            assert words[2] in names or f"`{words[2]}`" in text or words[2] in FILES_OF_THE_USER


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_link_to_a_file_leads_to_one(page: Path) -> None:
    targets = [link for link in LINK.findall(page.read_text()) if "://" not in link]
    assert [link for link in targets if not (page.parent / link).exists()] == []


def anchors(page: Path) -> set[str]:
    """The anchors of a page's headings: lower case, a hyphen for a blank, no punctuation."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {
        re.sub(r"[^\w\- ]", "", unescape(heading.lower())).replace(" ", "-") for heading in headings
    }


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_link_to_a_heading_leads_to_one(page: Path) -> None:
    targets = [link for link in ANCHOR.findall(page.read_text()) if "://" not in link[0]]
    wrong = [
        f"{name}#{anchor}"
        for name, anchor in targets
        if anchor not in anchors(page.parent / name if name else page)
    ]
    assert wrong == []


def test_the_page_of_the_command_line_is_what_the_program_prints() -> None:
    written = (ROOT / "docs" / "command-line.md").read_text()
    assert written == command_line.page(), "run scripts/docs"


def linked_pages(page: Path) -> set[Path]:
    """The pages of the repository that a page links to."""
    targets = [link for link in LINK.findall(page.read_text()) if link.endswith(".md")]
    return {(page.parent / target).resolve() for target in targets if "://" not in target}


def test_every_page_is_within_three_clicks_of_the_index() -> None:
    reached = {ROOT / "docs" / "index.md"}
    for _ in range(3):
        reached |= {target for page in reached for target in linked_pages(page)}
    folders = [ROOT / name for name in ("docs", "examples", "benchmarks")]
    pages = {page for folder in folders for page in folder.rglob("*.md")}
    assert sorted(map(ids, pages - reached)) == []


def test_every_document_has_its_line_in_a_section_of_the_index() -> None:
    index = (ROOT / "docs" / "index.md").read_text()
    sections = re.split(r"^## ", index, flags=re.MULTILINE)[1:]
    assert [section.split("\n")[0] for section in sections] == [
        "Learn",
        "How-to",
        "Reference",
        "Explanation",
    ]
    linked = [link for section in sections for link in LINK.findall(section)]
    pages = [path.name for path in sorted((ROOT / "docs").glob("*.md"))]
    assert [page for page in pages if linked.count(page) != 1] == ["index.md"]


def test_no_document_of_the_repository_is_left_out_of_the_index() -> None:
    linked = LINK.findall((ROOT / "docs" / "index.md").read_text())
    assert {"../CHANGELOG.md", "../CONTRIBUTING.md", "../benchmarks/README.md"} <= {*linked}


def test_the_readme_is_short_and_shows_at_most_eight_commands_of_use() -> None:
    readme = (ROOT / "README.md").read_text()
    assert len(readme.splitlines()) <= 120
    usage = readme.split("\n## Usage\n")[1].split("\n## ")[0]
    shown = read_commands(usage)
    assert 0 < len(shown) <= 8
    assert all(not command.output for command in shown)
    assert "docs/command-line.md" in usage  # which has all other commands
