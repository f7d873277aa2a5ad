"""Reading of JSON text from files and peers, with a limit on the length of its integers."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

MAX_DIGITS = 4000
"""The greatest number of digits of an integer. Python's own limit is higher, 4300, and its message
is about Python."""
_LONG_INTEGER = re.compile(rf"\d{{{MAX_DIGITS + 1},}}", re.ASCII)


class _LongInteger(Exception):
    """An integer of more than `MAX_DIGITS` digits."""


def read_json(text: str | bytes, *, parse_constant: Callable[[str], object] | None = None) -> Any:
    """Read JSON.

    Args:
        text: the text.
        parse_constant: receives ``NaN``, ``Infinity`` and ``-Infinity``, as in `json.loads`.

    Raises:
        JSONDecodeError: (a ValueError) the text is not JSON, is nested too deeply, or has an
            integer of more than `MAX_DIGITS` digits.
        ValueError: bytes are not text.
    """
    try:
        return json.loads(text, parse_int=_read_integer, parse_constant=parse_constant)
    except RecursionError:
        position, message = 0, "it is nested too deeply"
    except _LongInteger as error:
        position, message = -1, str(error)
    document = text if isinstance(text, str) else text.decode("utf-8", errors="replace")
    if position < 0:
        match = _LONG_INTEGER.search(document)
        position = 0 if match is None else match.start()
    raise json.JSONDecodeError(message, document, position)


def _read_integer(digits: str) -> int:
    n_digits = len(digits.removeprefix("-"))
    if n_digits > MAX_DIGITS:
        raise _LongInteger(f"an integer has {n_digits} digits; expected at most {MAX_DIGITS}")
    return int(digits)
