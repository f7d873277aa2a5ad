"""Messages on standard error, without control characters and of limited length."""

from __future__ import annotations

import re
import sys
import warnings
from collections.abc import Iterable

from ..errors import Diagnostic

MAX_QUOTE_LENGTH = 300
"""The greatest number of characters of a word or of a quoted text."""
MAX_LINE_LENGTH = 4000
"""The greatest number of characters of a line."""


def warn(message: str) -> None:
    """Print a warning; the command continues."""
    print(clean_text(f"uwsim: warning: {message}"), file=sys.stderr)


def report(message: str) -> None:
    """Print what a command waits for, or has connected to."""
    print(clean_text(f"uwsim: {message}"), file=sys.stderr, flush=True)


def print_warnings(diagnostics: Iterable[Diagnostic]) -> None:
    """Print warnings about files; the command continues."""
    for warning in diagnostics:
        print(clean_text(str(warning)), file=sys.stderr)


def suppress_cast_warnings() -> None:
    """Suppress numpy's warnings of casts of numbers that are too large for the new type.

    Such numbers become infinite, which is checked elsewhere. The setting is for all threads of the
    process; each command calls this function.
    """
    pattern = "(overflow|invalid value) encountered in cast"
    warnings.filterwarnings("ignore", pattern, RuntimeWarning)


def clean_text(text: str) -> str:
    """Return a text of an untrusted file without control characters and of readable length."""
    return "\n".join(_clean_line(line) for line in text.split("\n"))


def _clean_line(line: str) -> str:
    text = LONG_WORD.sub(_shorten, line[: 10 * MAX_LINE_LENGTH])
    if len(text) > MAX_LINE_LENGTH or len(line) > 10 * MAX_LINE_LENGTH:
        text = f"{text[:MAX_LINE_LENGTH]}…"
    return escape_control_characters(text)


def escape_control_characters(text: str) -> str:
    """Escape all control characters except line ends."""
    return "".join(
        letter if letter.isprintable() or letter == "\n" else f"\\x{ord(letter):02x}"
        for letter in text
    )


def escape_to_one_line(text: str) -> str:
    """Escape all control characters, line ends too."""
    return escape_control_characters(text).replace("\n", "\\n")


LONG_WORD = re.compile(
    rf"""(?<!\w)'[^']*'(?!\w)|(?<!\w)"[^"]*"(?!\w)|\S{{{MAX_QUOTE_LENGTH + 1},}}"""
)
"""The pattern of a quoted text or of a long word."""


def _shorten(match: re.Match[str]) -> str:
    text = match[0]
    if len(text) <= MAX_QUOTE_LENGTH:
        return text
    end = text[-1] if text[0] in "'\"" else ""
    n_left_out = len(text) - MAX_QUOTE_LENGTH - len(end)
    return f"{text[:MAX_QUOTE_LENGTH]}… ({n_left_out} more letters){end}"
