"""Read files, commands and their output from a page of the documentation."""

from __future__ import annotations

import math
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

FILE = re.compile(r"^`([\w.-]+)`:\n\n```\w+\n(.*?)^```", re.MULTILINE | re.DOTALL)
CONSOLE = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class DocumentedCommand:
    """A command after ``$``, and the output below it."""

    words: tuple[str, ...]
    """The words of the command, as a shell splits them, without its comment."""
    output: tuple[str, ...]
    """The expected lines of output."""


def write_files(page: str, folder: Path) -> list[str]:
    """Write every file that a page shows below its name; return the names."""
    for name, text in FILE.findall(page):
        (folder / name).write_text(text)
    return [name for name, _ in FILE.findall(page)]


def read_commands(page: str) -> list[DocumentedCommand]:
    """Return all commands of a page, in order."""
    documented_commands = []
    for block in CONSOLE.findall(page):
        text = block.replace("\\\n", " ")
        for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
            line, *output = part.splitlines()
            words = tuple(shlex.split(line, comments=True))
            documented_commands.append(
                DocumentedCommand(
                    words, tuple(printed_line for printed_line in output if printed_line.strip())
                )
            )
    return documented_commands


def is_printed(line: str, output: str, *, tolerance: float) -> bool:
    """Return True if the output has a line, up to blanks and a relative tolerance of numbers."""
    return any(
        _are_similar(line.split(), other.split(), tolerance) for other in output.splitlines()
    )


def _are_similar(words: list[str], other_words: list[str], tolerance: float) -> bool:
    return len(words) == len(other_words) and all(
        word == other or _is_close(word, other, tolerance)
        for word, other in zip(words, other_words, strict=True)
    )


def _is_close(word: str, other: str, tolerance: float) -> bool:
    try:
        return math.isclose(float(word), float(other), rel_tol=tolerance)
    except ValueError:
        return False
