"""Completion by the shell: commands, options, names and files.

``uwsim --install-completion`` configures the shell once. Then the shell runs ``uwsim`` with the
words of the line in an environment variable. Without a completion it offers files.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from .descriptions import head_comment

COMPLETION_VARIABLE = "_UWSIM_COMPLETE"
"""The environment variable that the shell sets when it requests completion."""


def typed_words() -> list[str] | None:
    """Return the words after ``uwsim`` on the shell's line; None without a completion request."""
    if COMPLETION_VARIABLE not in os.environ:
        return None
    line = os.environ.get("COMP_WORDS") or os.environ.get("_TYPER_COMPLETE_ARGS", "")
    try:
        return shlex.split(line)[1:]
    except ValueError:  # a quote that is still open
        return line.split()[1:]


def scene_names(prefix: str) -> list[tuple[str, str]]:
    """Return bundled scenes, and XML files in this directory."""
    return [*_bundled_names("scenes", prefix), *_match_files(prefix, ".xml")]


def benchmark_names(prefix: str) -> list[tuple[str, str]]:
    """Return bundled benchmarks, and XML files in this directory."""
    return [*_bundled_names("benchmarks", prefix), *_match_files(prefix, ".xml")]


def suite_names(prefix: str) -> list[tuple[str, str]]:
    """Return bundled suites, and XML files in this directory."""
    return [*_bundled_names("suites", prefix), *_match_files(prefix, ".xml")]


def checked_names(prefix: str) -> list[tuple[str, str]]:
    """Return bundled scenes and benchmarks, and XML and URDF files in this directory."""
    return [*copied_names(prefix), *_match_files(prefix, ".xml", ".urdf")]


def copied_names(prefix: str) -> list[tuple[str, str]]:
    """Return bundled scenes and benchmarks."""
    return [*_bundled_names("scenes", prefix), *_bundled_names("benchmarks", prefix)]


def algorithm_names(prefix: str) -> list[tuple[str, str]]:
    """Return bundled algorithms."""
    from ...algorithms import ALGORITHMS, summary

    return _match_names({name: summary(kind) for name, kind in ALGORITHMS.items()}, prefix)


def complete_names(names: Iterable[str]) -> Callable[[str], list[tuple[str, str]]]:
    """Return a function that completes a word to one of some names."""
    descriptions = {name: "" for name in names}

    def complete(prefix: str) -> list[tuple[str, str]]:
        return _match_names(descriptions, prefix)

    return complete


def _bundled_names(kind: str, prefix: str) -> list[tuple[str, str]]:
    from ...assets.bundled import bundled_files

    return _match_names({n: head_comment(p) for n, p in bundled_files(kind).items()}, prefix)


def _match_names(names: Mapping[str, str], prefix: str) -> list[tuple[str, str]]:
    return [(name, message) for name, message in names.items() if name.startswith(prefix)]


def _match_files(prefix: str, *suffixes: str) -> list[tuple[str, str]]:
    """Return files with these suffixes in this directory; the shell offers other files."""
    return [
        (path.name, "")
        for path in sorted(Path().glob("*"))
        if path.name.startswith(prefix) and path.suffix in suffixes and path.is_file()
    ]
