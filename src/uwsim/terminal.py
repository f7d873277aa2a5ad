"""What the user is told on standard error, as lines that can be printed."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable

from .errors import Diagnostic

MAX_QUOTE_LENGTH = 300
"""Letters of what a file said that are shown: a word, or what stands between quotes."""


MAX_LINE_LENGTH = 4000
"""Letters of a line, whatever is in it."""


def warn(message: str) -> None:
    """Tell the user what the command goes on in spite of."""
    print(printable(f"uwsim: warning: {message}"), file=sys.stderr)


def print_warnings(warnings: Iterable[Diagnostic]) -> None:
    """Tell the user what of a file seems not to be meant; the command goes on."""
    for warning in warnings:
        print(printable(f"{warning} (warning)"), file=sys.stderr)


def printable(text: str) -> str:
    """Show what a hostile file may hold: no control characters, and not more than can be read."""
    return "\n".join(_legible(line) for line in text.split("\n"))


def _legible(line: str) -> str:
    shown = LONG.sub(_shortened, line[: 10 * MAX_LINE_LENGTH])
    if len(shown) > MAX_LINE_LENGTH or len(line) > 10 * MAX_LINE_LENGTH:
        shown = f"{shown[:MAX_LINE_LENGTH]}…"
    return legible(shown)


def legible(text: str) -> str:
    """Show control characters but ends of lines instead of letting a terminal obey them."""
    return "".join(
        letter if letter.isprintable() or letter == "\n" else f"\\x{ord(letter):02x}"
        for letter in text
    )


LONG = re.compile(rf"""(?<!\w)'[^']*'(?!\w)|(?<!\w)"[^"]*"(?!\w)|\S{{{MAX_QUOTE_LENGTH + 1},}}""")
"""What a file said: what stands between quotes, and what is long and has no gap."""


def _shortened(found: re.Match[str]) -> str:
    text = found[0]
    if len(text) <= MAX_QUOTE_LENGTH:
        return text
    end = text[-1] if text[0] in "'\"" else ""
    left_out = len(text) - MAX_QUOTE_LENGTH - len(end)
    return f"{text[:MAX_QUOTE_LENGTH]}… ({left_out} more letters){end}"
