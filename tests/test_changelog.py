"""CHANGELOG.md keeps the form of Keep a Changelog."""

from __future__ import annotations

import re
from importlib import metadata
from pathlib import Path

CHANGELOG = Path(__file__).parent.parent / "CHANGELOG.md"
SECTIONS = {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}
RELEASE = re.compile(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d{2}-\d{2})")


def errors(text: str) -> list[str]:
    """Return everything that is wrong with a changelog."""
    found: list[str] = []
    releases: list[str] = []
    dates: list[str] = []
    section = ""
    entries = 1
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("#") and not line.startswith("# ") and section and not entries:
            found.append(f"{number}: '{section}' above is empty")
        if line.startswith("## "):
            title, section, entries = line[3:], "", 1
            match = RELEASE.fullmatch(title)
            if match:
                dates.append(match[2])
            elif title != "[Unreleased]":
                found.append(f"{number}: '{title}' is neither [Unreleased] nor [x.y.z] - date")
            releases.append(match[1] if match else title)
        elif line.startswith("### "):
            section, entries = line[4:], 0
            if section not in SECTIONS:
                found.append(f"{number}: '{section}' is not one of {sorted(SECTIONS)}")
        elif line.startswith("- "):
            entries += 1
            if not line.endswith("."):
                found.append(f"{number}: an entry is one line that ends with a full stop")
        elif line.strip() and releases and not line.startswith("["):
            found.append(f"{number}: an entry is one line that begins with '- '")
    if section and not entries:
        found.append(f"'{section}' at the end is empty")
    if not text.startswith("# Changelog\n"):
        found.append("the first line is not '# Changelog'")
    if releases[:1] != ["[Unreleased]"] or releases.count("[Unreleased]") > 1:
        found.append("[Unreleased] does not stand first, or not once")
    if len(set(releases)) != len(releases) or dates != sorted(dates, reverse=True):
        found.append("releases are not in order, newest first")
    return found


def test_the_changelog_keeps_its_form() -> None:
    assert errors(CHANGELOG.read_text()) == []


def test_the_newest_release_is_this_version() -> None:
    releases = [version for version, _ in RELEASE.findall(CHANGELOG.read_text())]
    assert releases[:1] in ([], [metadata.version("uwsim")])


def test_each_mistake_of_form_is_found() -> None:
    good = "# Changelog\n\n## [Unreleased]\n\n### Added\n\n- A thing.\n\n"
    assert errors(good) == []
    for bad in (
        good.replace("# Changelog", "# News"),
        good.replace("[Unreleased]", "[Next]"),
        good.replace("Added", "New"),
        good.replace("- A thing.\n", ""),
        good.replace("thing.", "thing"),
        good.replace("- A", "A"),
        good + "## [0.2.0] - 21.11.2026\n",
        good + "## [0.1.0] - 2026-01-01\n\n## [0.2.0] - 2026-02-01\n",
        good + "### Fixed\n\n### Changed\n\n- It.\n",
    ):
        assert len(errors(bad)) >= 1, bad
