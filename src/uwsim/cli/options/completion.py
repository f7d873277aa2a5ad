"""Completion by the shell: commands, options, names and files.

``uwsim --install-completion`` tells the shell once; from then on it asks ``uwsim`` itself, with the
words that stand on the line in an environment variable. Where nothing is offered it offers files.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from .descriptions import head_comment

VARIABLE = "_UWSIM_COMPLETE"
"""Set by the shell when it requests completion."""


def words_typed() -> list[str] | None:
    """Return the words after ``uwsim`` on the shell's line; None without a completion request."""
    if VARIABLE not in os.environ:
        return None
    line = os.environ.get("COMP_WORDS") or os.environ.get("_TYPER_COMPLETE_ARGS", "")
    try:
        return shlex.split(line)[1:]
    except ValueError:  # a quote that is still open
        return line.split()[1:]


def scene_names(incomplete: str) -> list[tuple[str, str]]:
    """Bundled scenes, and XML files."""
    return [*_bundled("scenes", incomplete), *_files(incomplete, ".xml")]


def benchmark_names(incomplete: str) -> list[tuple[str, str]]:
    """Bundled benchmarks, and XML files."""
    return [*_bundled("benchmarks", incomplete), *_files(incomplete, ".xml")]


def checked_names(incomplete: str) -> list[tuple[str, str]]:
    """Bundled scenes and benchmarks, XML files and URDFs."""
    return [*copied_names(incomplete), *_files(incomplete, ".xml", ".urdf")]


def copied_names(incomplete: str) -> list[tuple[str, str]]:
    """Bundled scenes and benchmarks."""
    return [*_bundled("scenes", incomplete), *_bundled("benchmarks", incomplete)]


def algorithm_names(incomplete: str) -> list[tuple[str, str]]:
    """Bundled algorithms; the only names that cost an import."""
    from ...algorithms import ALGORITHMS, summary

    return _matching({name: summary(kind) for name, kind in ALGORITHMS.items()}, incomplete)


def one_of(names: Iterable[str]) -> Callable[[str], list[tuple[str, str]]]:
    """Return the completion of a word that is one of a few."""
    known = {name: "" for name in names}
    return lambda incomplete: _matching(known, incomplete)


def _bundled(kind: str, incomplete: str) -> list[tuple[str, str]]:
    from ...assets.bundled import bundled_files

    return _matching({n: head_comment(p) for n, p in bundled_files(kind).items()}, incomplete)


def _matching(names: Mapping[str, str], incomplete: str) -> list[tuple[str, str]]:
    return [(name, message) for name, message in names.items() if name.startswith(incomplete)]


def _files(incomplete: str, *endings: str) -> list[tuple[str, str]]:
    """Files of these endings in this directory; the shell itself offers all others."""
    return [
        (path.name, "")
        for path in sorted(Path().glob("*"))
        if path.name.startswith(incomplete) and path.suffix in endings and path.is_file()
    ]
