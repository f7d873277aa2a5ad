"""CHANGELOG.md is short, states what a user can do, and agrees with the version."""

from __future__ import annotations

import re
from pathlib import Path

import uwsim

CHANGELOG = Path(__file__).parent.parent / "CHANGELOG.md"
THEMES = (
    *("Scenes", "Physics", "Sensors and devices", "Benchmarks", "Results", "Connections"),
    *("Views", "Python"),
)
CHANGES = ("Changed", "Deprecated", "Removed", "Fixed", "Security")
SECTIONS = (*THEMES, *CHANGES)
"""The sections of a release, in order: themes, then what Keep a Changelog calls them."""
RELEASE = re.compile(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d{2}-\d{2})")
ENTRY = re.compile(r"- [A-Z][a-z]+,? .*\.")
MAX_LINES = 60
"""The most lines of a release, blank lines and headings included."""
MAX_LETTERS = 160
"""The most letters of an entry."""
MAX_WORDS = 25
"""The most words of a sentence."""


def errors_of_entry(line: str) -> list[str]:
    """Return everything that is wrong with a line of a section."""
    errors = []
    if not ENTRY.fullmatch(line):
        errors.append("an entry is one line, '- Verb ...', that ends with a full stop")
    if len(line) > MAX_LETTERS:
        errors.append(f"{len(line)} letters, more than {MAX_LETTERS}")
    sentences = re.split(r"[.;:]\s", line.removeprefix("- "))
    if max(len(sentence.split()) for sentence in sentences) > MAX_WORDS:
        errors.append(f"a sentence of more than {MAX_WORDS} words")
    return errors


def errors_of_release(title: str, text: str) -> list[str]:
    """Return everything that is wrong with the text below the heading of a release."""
    errors = []
    if title != "[Unreleased]" and not RELEASE.fullmatch(title):
        errors.append(f"'{title}' is neither [Unreleased] nor [x.y.z] - date")
    n_lines = len(text.strip().splitlines()) + 2  # the heading and a blank line
    if n_lines > MAX_LINES:
        errors.append(f"{title}: {n_lines} lines, more than {MAX_LINES}")
    preface, *sections = re.split(r"^### ", text, flags=re.MULTILINE)
    if preface.strip():
        errors.append(f"{title}: '{preface.strip()}' is outside a section")
    names = [section.splitlines()[0] for section in sections]
    if names != [name for name in SECTIONS if name in names]:
        errors.append(f"{title}: {names} are not sections, each once, in the order {SECTIONS}")
    for name, section in zip(names, sections, strict=True):
        entries = [line for line in section.splitlines()[1:] if line.strip()]
        if not entries:
            errors.append(f"{title}: '{name}' is empty")
        errors += [
            f"{name}: {error}: {line}" for line in entries for error in errors_of_entry(line)
        ]
    return errors


def errors_of_changelog(text: str) -> list[str]:
    """Return everything that is wrong with a changelog."""
    head, *releases = re.split(r"^## ", text, flags=re.MULTILINE)
    parts = [release.partition("\n") for release in releases]
    titles = [title for title, _, _ in parts]
    errors = [error for title, _, rest in parts for error in errors_of_release(title, rest)]
    if not head.startswith("# Changelog\n"):
        errors.append("the first line is not '# Changelog'")
    if titles[:1] != ["[Unreleased]"] or titles.count("[Unreleased]") > 1:
        errors.append("[Unreleased] is not first, or not once")
    matches = [match for title in titles[1:] if (match := RELEASE.fullmatch(title))]
    versions = [number(match[1]) for match in matches]
    dates = [match[2] for match in matches]
    if versions != sorted({*versions}, reverse=True) or dates != sorted(dates, reverse=True):
        errors.append("the releases are not in order, newest first")
    return errors


def number(version: str) -> tuple[int, ...]:
    """Return the parts of a version ``x.y.z``."""
    return tuple(int(part) for part in version.split("."))


def newest_release() -> tuple[str, str]:
    """Return the version and the date of the newest release."""
    return RELEASE.findall(CHANGELOG.read_text())[0]


def is_version_of(version: str, release: str) -> bool:
    """Return whether a version is a release, or in development after it."""
    base, _, suffix = version.partition(".dev")
    return version == release or (suffix == "0" and number(base) > number(release))


def test_the_changelog_keeps_its_form() -> None:
    assert errors_of_changelog(CHANGELOG.read_text()) == []


def test_the_version_is_the_newest_release_or_a_later_one_in_development() -> None:
    assert is_version_of(uwsim.__version__, newest_release()[0])
    assert is_version_of("0.2.1.dev0", "0.2.0")
    assert is_version_of("0.10.0.dev0", "0.9.0")
    assert not is_version_of("0.2.0.dev0", "0.2.0")
    assert not is_version_of("0.2.1", "0.2.0")


def test_the_citation_names_the_newest_release() -> None:
    citation = (CHANGELOG.parent / "CITATION.cff").read_text()
    version, date = newest_release()
    assert re.findall(r"^version: (.+)$", citation, re.MULTILINE) == [version]
    assert re.findall(r"^date-released: (.+)$", citation, re.MULTILINE) == [date]


def test_each_mistake_of_form_is_found() -> None:
    changelog = (
        "# Changelog\n\n## [Unreleased]\n\n## [0.3.0] - 2026-02-01\n\n"
        "### Scenes\n\n- Read a scene.\n\n### Fixed\n\n- Read a mesh.\n\n"
        "## [0.2.0] - 2026-01-01\n\n### Views\n\n- Watch a run.\n"
    )
    assert errors_of_changelog(changelog) == []
    with_entry = changelog.replace("Unreleased]\n", "Unreleased]\n\n### Views\n\n- Watch it.\n")
    assert errors_of_changelog(with_entry) == []
    for text in (
        changelog.replace("# Changelog", "# News"),
        changelog.replace("[Unreleased]", "[Next]"),
        changelog.replace("## [Unreleased]\n", ""),
        changelog.replace("## [0.2.0]", "## [Unreleased]\n\n## [0.2.0]"),
        changelog.replace("Scenes", "Other"),
        changelog.replace("Fixed", "Scenes"),
        changelog.replace("Scenes", "Security"),
        changelog.replace("- Read a scene.\n", ""),
        changelog.replace("scene.", "scene"),
        changelog.replace("- Read a scene", "Read a scene"),
        changelog.replace("- Read a scene", "- `uwsim` reads a scene"),
        changelog.replace("a scene", "a " + "x" * 160),
        changelog.replace("a scene", "a b " * 13),
        changelog.replace("- Read a scene.\n", "- Read a scene.\n" * 60),
        changelog.replace("### Scenes", "Some text.\n\n### Scenes"),
        changelog.replace("2026-01-01", "1.1.2026"),
        changelog.replace("2026-01-01", "2026-03-01"),
        changelog.replace("0.2.0", "0.3.1"),
        changelog.replace("0.2.0", "0.3.0"),
    ):
        assert errors_of_changelog(text) != [], text
