"""What a page of the documentation shows: files to be written, commands to be typed, output."""

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
    """A line after ``$``, and what stands below it."""

    words: tuple[str, ...]
    """The command as a shell takes it apart; its comment is left out."""
    output: tuple[str, ...]
    """Lines that it should print."""


def write_files(page: str, folder: Path) -> list[str]:
    """Write every file that a page shows below its name; return the names."""
    for name, text in FILE.findall(page):
        (folder / name).write_text(text)
    return [name for name, _ in FILE.findall(page)]


def commands(page: str) -> list[DocumentedCommand]:
    """Every command of a page's consoles, in order."""
    found = []
    for block in CONSOLE.findall(page):
        joined = block.replace("\\\n", " ")
        for part in re.split(r"^\$ ", joined, flags=re.MULTILINE)[1:]:
            line, *output = part.splitlines()
            words = tuple(shlex.split(line, comments=True))
            found.append(DocumentedCommand(words, tuple(each for each in output if each.strip())))
    return found


def is_said(line: str, printed: str, *, within: float) -> bool:
    """Whether a line was printed, up to blanks, with numbers that are equal within a share."""
    return any(_alike(line.split(), other.split(), within) for other in printed.splitlines())


def _alike(words: list[str], others: list[str], within: float) -> bool:
    return len(words) == len(others) and all(
        word == other or _close(word, other, within)
        for word, other in zip(words, others, strict=True)
    )


def _close(word: str, other: str, within: float) -> bool:
    try:
        return math.isclose(float(word), float(other), rel_tol=within)
    except ValueError:
        return False
