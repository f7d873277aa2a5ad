"""Finds the wrong line of an OBJ file that could not be read."""

from __future__ import annotations

import math

SHOWN = 60
"""Number of characters of a line that are shown."""
MAX_LINES = 2_000_000
"""Number of lines that are checked."""
COUNTED = {"v": 3, "vt": 1, "vn": 3}
"""What is numbered -> the fewest numbers it has."""


def wrong_line(data: bytes) -> str:
    """Return the first line that is wrong, as ``4: 'f 1 2 9': ...``; empty if none is found."""
    counts = dict.fromkeys(COUNTED, 0)
    later = []  # faces may come before their vertices
    for number, line in enumerate(
        data.decode("utf-8", "replace").splitlines()[:MAX_LINES], start=1
    ):
        kind, *words = line.partition("#")[0].split() or [""]
        why = ""
        if kind in COUNTED:
            counts[kind] += 1
            why = _wrong_numbers(words, COUNTED[kind])
        elif kind == "f":
            why = _wrong_corners(words)
            later.append((number, line, words, dict(counts)))
        if why:
            return f"{number}: {line[:SHOWN]!r}: {why}"
    for number, line, words, so_far in later:
        for word in words:
            for kind, text in zip(("v", "vt", "vn"), word.split("/"), strict=False):
                if text and not _is_there(int(text), so_far[kind], counts[kind]):
                    has = f"there are {counts[kind]} {kind}"
                    return f"{number}: {line[:SHOWN]!r}: there is no {kind} {text}; {has}"
    return ""


def _wrong_numbers(words: list[str], fewest: int) -> str:
    if len(words) < fewest:
        return f"has {len(words)} of the {fewest} numbers expected"
    for word in words:
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            return f"{word[:SHOWN]!r}; expected a number"
    return ""


def _wrong_corners(words: list[str]) -> str:
    if len(words) < 3:
        return f"has {len(words)} of at least 3 corners expected"
    for word in words:
        parts = word.split("/")
        if len(parts) > 3 or not parts[0] or not all(_is_index(part) for part in parts if part):
            return f"{word[:SHOWN]!r}; expected numbers of vertex, texture and normal, as 1/2/3"
    return ""


def _is_index(text: str) -> bool:
    digits = text.removeprefix("-")
    return digits.isascii() and digits.isdigit() and len(digits) < 20


def _is_there(index: int, so_far: int, in_all: int) -> bool:
    """Whether an index, from 1 or negative and relative, is valid."""
    return 1 <= index <= in_all if index >= 0 else -index <= so_far
