"""Numbers, truth values and texts of YAML 1.1, as PyYAML reads them for the xacro of ROS.

Two kinds of numbers that PyYAML reads as texts are numbers here: those with an exponent but
without a point or without the sign of the exponent (``1e-3``, ``1.5e3``), and ``-.5``.
A date is a text.
"""

from __future__ import annotations

import re

from .value import ExpressionError

STANDARD_PREFIX = "tag:yaml.org,2002:"
"""The prefix of the tags of YAML itself."""
MAX_NUMBER = 100
"""The greatest length of a number [characters]; longer ones are texts."""
TRUTH_VALUES = {
    **dict.fromkeys(("yes", "true", "on"), True),
    **dict.fromkeys(("no", "false", "off"), False),
}
DECIMAL = r"[-+]?[0-9][0-9_]*"
PATTERNS = {
    "bool": "|".join(form for word in TRUTH_VALUES for form in (word, word.title(), word.upper())),
    "int": r"[-+]?0b[01_]+|[-+]?0[0-7_]+|[-+]?(0|[1-9][0-9_]*)|[-+]?0x[0-9a-fA-F_]+"
    r"|[-+]?[1-9][0-9_]*(:[0-5]?[0-9])+",
    "float": rf"{DECIMAL}\.[0-9_]*([eE][-+]?[0-9]+)?|[-+]?\.[0-9][0-9_]*([eE][-+]?[0-9]+)?"
    rf"|{DECIMAL}[eE][-+]?[0-9]+|{DECIMAL}(:[0-5]?[0-9])+\.[0-9_]*"
    r"|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)",
    "null": "~|null|Null|NULL|",
    "merge": "<<",
}
"""The pattern of each kind of unquoted scalar; the first match applies."""
COMPILED_PATTERNS = {kind: re.compile(pattern) for kind, pattern in PATTERNS.items()}


def tag_of(text: str) -> str:
    """Return the tag for an unquoted text that has no tag."""
    if len(text) <= MAX_NUMBER:
        for kind, pattern in COMPILED_PATTERNS.items():
            if pattern.fullmatch(text):
                return STANDARD_PREFIX + kind
    return f"{STANDARD_PREFIX}str"


def parse_scalar(tag: str, text: str) -> int | float | bool | str | None:
    """Convert the text of a scalar with a tag to its value.

    Raises:
        ExpressionError: the tag is unknown, or the text is invalid for it.
    """
    kind = tag.removeprefix(STANDARD_PREFIX)
    if kind in ("str", "merge", "value", "timestamp"):
        return text
    if kind == "null":
        return None
    if kind not in ("bool", "int", "float"):
        raise unknown_tag_error(tag)
    word = text.replace("_", "").lower()
    if kind == "bool" and word in TRUTH_VALUES:
        return TRUTH_VALUES[word]
    if kind == "bool" or not word or len(word) > MAX_NUMBER:
        raise ExpressionError(f"{text[:40]!r} is no {kind}")
    return _parse_integer(word) if kind == "int" else _parse_real(word)


def unknown_tag_error(tag: str) -> ExpressionError:
    """Return the error for a tag that is not supported."""
    return ExpressionError(f"not YAML of numbers and texts: the tag {tag[:60]} is unknown")


def _parse_integer(word: str) -> int:
    """Convert an integer: decimal, ``0b1``, ``0x1f``, octal ``017``, or sexagesimal ``1:30``."""
    sign, digits = (-1 if word[0] == "-" else 1), word.lstrip("+-")
    if digits.startswith(("0b", "0x")):
        return sign * int(digits, 0)
    if digits.startswith("0") and digits != "0":
        return sign * int(digits, 8)
    value = 0
    for part in digits.split(":"):
        value = value * 60 + int(part)
    return sign * value


def _parse_real(word: str) -> float:
    """Convert a real number: decimal, ``.inf``, ``.nan``, or sexagesimal ``1:30.5``."""
    sign, digits = (-1.0 if word[0] == "-" else 1.0), word.lstrip("+-")
    if digits in (".inf", ".nan"):
        return sign * float(digits[1:])
    value = 0.0
    for part in digits.split(":"):
        value = value * 60.0 + float(part)
    return sign * value
