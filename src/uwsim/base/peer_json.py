"""Reading of JSON from peers (other programs, browsers) with limits on its content."""

from __future__ import annotations

import json
import re
from itertools import accumulate
from typing import Any

from .files.json_text import read_json

MAX_DEPTH = 64
"""The greatest depth of nested lists and objects."""
ESCAPED_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")
"""The JSON escape of a surrogate: half of a character beyond 16 bits."""
BRACKET = re.compile(r'[\[\]{}]|"[^"\\]*(?:\\.[^"\\]*)*(?:"|\\?\Z)', re.S)
"""A bracket, or a string, whose brackets are not counted. A string without an end extends to the
end of the text; otherwise the time of a search would grow with the square of the text's quotes."""
DEPTH_STEPS = {"[": 1, "{": 1, "]": -1, "}": -1}


def read_peer_json(text: str) -> Any:
    """Read JSON that a peer has sent.

    Raises:
        ValueError: the text is not JSON, is nested more deeply than `MAX_DEPTH`, has an integer
            that is too long, or half of a surrogate pair, which is no character.
    """
    if text.count("[") + text.count("{") > MAX_DEPTH and _depth(text) > MAX_DEPTH:
        raise ValueError(f"it is nested more than {MAX_DEPTH} deep")
    value = read_json(text)
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
