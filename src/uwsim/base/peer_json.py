"""JSON of peers: read within bounds, so that it can be compared, shown and sent on."""

from __future__ import annotations

import json
import re
from itertools import accumulate
from typing import Any

MAX_DEPTH = 64
"""The greatest depth of lists and objects in each other."""
ESCAPED_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")
"""Half of a character beyond the 16-bit ones, as JSON escapes it."""
BRACKET = re.compile(r'[\[\]{}]|"[^"\\]*(?:\\.[^"\\]*)*(?:"|\\?\Z)', re.S)
"""A bracket, or a string, whose brackets do not count. One without an end goes on to the end of the
text: otherwise each of its quotes would be tried, in a time that grows with the square."""
DEPTH_STEPS = {"[": 1, "{": 1, "]": -1, "}": -1}


def read_peer_json(text: str) -> Any:
    """Read JSON that a peer has sent.

    Raises:
        ValueError: it is none, is nested more deeply than `MAX_DEPTH`, or has half of a surrogate
            pair, which is no character.
    """
    if text.count("[") + text.count("{") > MAX_DEPTH and _depth(text) > MAX_DEPTH:
        raise ValueError(f"it is nested more than {MAX_DEPTH} deep")
    value = json.loads(text)
    if ESCAPED_SURROGATE.search(text):
        try:
            json.dumps(value, ensure_ascii=False).encode()
        except UnicodeEncodeError:
            raise ValueError("it has half of a surrogate pair, which is no character") from None
    return value


def _depth(text: str) -> int:
    """Return how deep the brackets of a text are nested."""
    steps = (DEPTH_STEPS.get(bracket[0], 0) for bracket in BRACKET.finditer(text))
    return max(accumulate(steps), default=0)
