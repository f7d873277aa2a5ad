"""Parsing scalars: numbers, flags and words."""

from __future__ import annotations

import math
import re
from typing import Any

from lxml import etree

from ..errors import did_you_mean
from .diagnostics import Diagnostics
from .grammar import MAX_NUMBER, Field
from .names import cut

TOKENS = {
    "M_PI": math.pi,
    "M_PI_2": math.pi / 2,
    "M_PI_4": math.pi / 4,
    "-M_PI": -math.pi,
    "-M_PI_2": -math.pi / 2,
    "-M_PI_4": -math.pi / 4,
}
"""Constants that are read as numbers."""

MAX_NUMBERS = 36
"""In one element: a full matrix of six rows."""
BLANKS = " \t\n\r"
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_COMMA = re.compile(r"[+-]?\d*,\d+", re.ASCII)
_SEPARATORS = re.compile(r"[\s_-]+")
_LEADING_INT = re.compile(r"[+-]?\d+", re.ASCII)


class Bad:
    """What a value that cannot be read is read as."""


BAD = Bad()


def scalar(
    field: Field, text: str, node: etree._Element, diagnostics: Diagnostics, shown: str
) -> Any:
    """A scalar from its text."""
    value: Any = BAD
    if field.kind == "numbers":
        return numbers(field, text, node, diagnostics, shown)
    if field.kind == "str":
        value = text
    elif field.kind in ("float", "triple"):
        value = number(text)
        is_lenient = (field.xml.original.lenient or diagnostics.lenient) and not _COMMA.fullmatch(
            text
        )
        if value is None and is_lenient and (leading := _NUMBER.match(text)):
            value = number(leading[0])
            if value is not None:
                message = f"{shown} is {cut(text)}; read as {value:g}, as the original does"
                diagnostics.warning(node, message)
        value = BAD if value is None else value
    elif field.kind == "int":
        leading = _LEADING_INT.match(text)
        if leading and len(leading[0]) < 12 and abs(int(leading[0])) < 2**31:
            value = int(leading[0])
            if leading[0] != text:
                diagnostics.warning(
                    node, f"{shown} is {cut(text)}; read as {value}, as the original does"
                )
    elif field.kind == "bool":
        value = {"0": False, "1": True}.get(text, BAD)
        if field.xml.attribute and value is BAD:
            value = {"false": False, "true": True}.get(text, BAD)
        if value is BAD and not field.xml.attribute and not field.xml.namespaced:
            value = field.default if (invalid := field.xml.original.invalid) is None else invalid
            diagnostics.warning(
                node,
                f"{shown} is {cut(text)}; expected 0 or 1; read as {value:d}, as the original does",
            )
    elif field.kind == "word":
        value = _word(field, text, node, diagnostics, shown)
    if field.xml.original.clamped and value is not BAD:
        value = _clamped(field, value, node, diagnostics, shown)
    if value is not BAD and field.kind in ("float", "int", "triple") and not field.allows(value):
        value = BAD
    if field.kind in ("float", "triple") and value is not BAD and abs(value) > MAX_NUMBER:
        diagnostics.error(node, f"{shown} is {cut(text)}; no quantity is beyond {MAX_NUMBER:g}")
        return BAD
    if value is BAD:
        near = did_you_mean(text, field.type) if field.kind == "word" and len(text) < 80 else ""
        if field.kind in ("float", "triple") and len(text) < 80 and _COMMA.fullmatch(text):
            near = f" Did you mean {text.replace(',', '.')}?"
        diagnostics.error(
            node, f"{shown} is {cut(text)}; expected {field.expected}.{near}".rstrip(".")
        )
    return value


def _word(
    field: Field, text: str, node: etree._Element, diagnostics: Diagnostics, shown: str
) -> Any:
    """One of a few words; of the original's also in another spelling, as ``CompoundBox``."""
    if text in field.type:
        return text
    if field.xml.namespaced:
        return BAD
    words = {_folded(word): word for word in field.type}
    word = words.get(_folded(text))
    if word is None:
        return BAD
    diagnostics.warning(node, f"{shown} is {cut(text)}; read as {word!r}")
    return word


def _folded(word: str) -> str:
    """A word in small letters, without blanks, hyphens and underscores."""
    return _SEPARATORS.sub("", word).lower()


def _clamped(
    field: Field, value: float, node: etree._Element, diagnostics: Diagnostics, shown: str
) -> float:
    """A number within the limits of its field; not one of the wrong sign, nor no pixels."""
    lowest = field.xml.limits.get("minimum", -MAX_NUMBER)
    highest = field.xml.limits.get("maximum", MAX_NUMBER)
    limited = min(max(value, lowest), highest)
    has_no_size = value < lowest and (value < 0.0 < lowest or field.kind == "int")
    if limited == value or has_no_size:
        return value
    is_allowed = field.allows(value)
    why = f"no quantity is beyond {MAX_NUMBER:g}" if is_allowed else f"expected {field.expected}"
    diagnostics.warning(node, f"{shown} is {value:g}; {why}; clamped to {limited:g}")
    return limited if field.kind != "int" else int(limited)


def numbers(
    field: Field, text: str, node: etree._Element, diagnostics: Diagnostics, shown: str
) -> Any:
    """Several numbers from their text, separated by blanks or commas."""
    words = text.replace(",", " ").split()
    values = [number(word) for word in words]
    beyond = [
        word for word, value in zip(words, values, strict=True) if abs(value or 0) > MAX_NUMBER
    ]
    wrong = [
        word for word, value in zip(words, values, strict=True)
        if value is None or not field.allows(value)
    ]  # fmt: skip
    if len(words) > MAX_NUMBERS:
        message = f"holds {len(words)} numbers; expected {MAX_NUMBERS} at most"
    elif wrong or not words:
        message = f"holds {cut(wrong[0] if wrong else text)}; expected {field.expected}"
    elif beyond:
        message = f"holds {cut(beyond[0])}; no quantity is beyond {MAX_NUMBER:g}"
    elif field.type and len(words) != field.type:
        message = f"has {len(words)} numbers; expected {field.type}"
    else:
        return tuple(values)
    diagnostics.error(node, f"{shown} {message}")
    return BAD


def number(text: str) -> float | None:
    """A number or an ``M_PI`` token; None when it is neither, or not finite."""
    if text in TOKENS:
        return TOKENS[text]
    if len(text) > 400 or not _NUMBER.fullmatch(text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None
