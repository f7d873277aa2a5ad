"""Search for the invalid line of an OBJ file that could not be read."""

from __future__ import annotations

import math

MAX_LINE_LENGTH = 60
"""The number of characters of a line that a message shows."""
MAX_LINES = 2_000_000
"""The number of lines that are checked."""
MIN_NUMBERS = {"v": 3, "vt": 1, "vn": 3}
"""The smallest number of values on a line, by its first word."""


def find_invalid_line(data: bytes) -> str:
    """Return the first invalid line, as ``4: 'f 1 2 9': ...``; empty if none is found."""
    counts = dict.fromkeys(MIN_NUMBERS, 0)
    face_lines = []  # faces may come before their vertices
    for number, line in enumerate(
        data.decode("utf-8", "replace").splitlines()[:MAX_LINES], start=1
    ):
        kind, *words = line.partition("#")[0].split() or [""]
        error = ""
        if kind in MIN_NUMBERS:
            counts[kind] += 1
            error = _number_error(words, MIN_NUMBERS[kind])
        elif kind == "f":
            error = _corner_error(words)
            face_lines.append((number, line, words, dict(counts)))
        if error:
            return f"{number}: {line[:MAX_LINE_LENGTH]!r}: {error}"
    for number, line, words, counts_before in face_lines:
        for word in words:
            for kind, text in zip(("v", "vt", "vn"), word.split("/"), strict=False):
                if text and not _is_valid_index(int(text), counts_before[kind], counts[kind]):
                    error = f"there is no {kind} {text}; there are {counts[kind]} {kind}"
                    return f"{number}: {line[:MAX_LINE_LENGTH]!r}: {error}"
    return ""


def _number_error(words: list[str], min_numbers: int) -> str:
    if len(words) < min_numbers:
        return f"has {len(words)} of the {min_numbers} numbers expected"
    for word in words:
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            return f"{word[:MAX_LINE_LENGTH]!r}; expected a number"
    return ""


def _corner_error(words: list[str]) -> str:
    if len(words) < 3:
        return f"has {len(words)} of at least 3 corners expected"
    for word in words:
        parts = word.split("/")
        if len(parts) > 3 or not parts[0] or not all(_is_index(part) for part in parts if part):
            corner = repr(word[:MAX_LINE_LENGTH])
            return f"{corner}; expected numbers of vertex, texture and normal, as 1/2/3"
    return ""


def _is_index(text: str) -> bool:
    digits = text.removeprefix("-")
    return digits.isascii() and digits.isdigit() and len(digits) < 20


def _is_valid_index(index: int, count_before: int, total: int) -> bool:
    """Return whether an index is valid: from 1 on, or negative and relative to the last vertex."""
    return 1 <= index <= total if index >= 0 else -index <= count_before
