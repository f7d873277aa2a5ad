"""Parsing of the text of elements and attributes: numbers, flags and words."""

from __future__ import annotations

import math
import re
from typing import Any

from lxml import etree

from ..errors import did_you_mean
from .diagnostics import Diagnostics
from .grammar import MAX_NUMBER, Field
from .names import quote

TOKENS = {
    "M_PI": math.pi,
    "M_PI_2": math.pi / 2,
    "M_PI_4": math.pi / 4,
    "-M_PI": -math.pi,
    "-M_PI_2": -math.pi / 2,
    "-M_PI_4": -math.pi / 4,
}
"""The constants that are read as numbers."""

MAX_NUMBERS = 200
"""The greatest count of numbers in one element, such as the angles of a measured phase function.
`Limits.max_count` of an element may be greater."""
BLANKS = " \t\n\r"
"""The blank characters of XML, which are removed around a text."""
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_COMMA = re.compile(r"[+-]?\d*,\d+", re.ASCII)
_SEPARATORS = re.compile(r"[\s_-]+")
_LEADING_INT = re.compile(r"[+-]?\d+", re.ASCII)


class NoValue:
    """The type of `NO_VALUE`, which replaces a value that cannot be read."""


NO_VALUE = NoValue()
"""The result of parsing a text that is invalid; an error is reported for it."""


def parse_scalar(
    field: Field, text: str, node: etree._Element, diagnostics: Diagnostics, label: str
) -> Any:
    """Parse a text for a field; add an error and return NO_VALUE if it is invalid.

    Args:
        field: the field.
        text: the text, trimmed.
        node: the element with the text, for the line of messages.
        diagnostics: the object that collects the errors.
        label: the name of the element or attribute in messages.
    """
    value: Any = NO_VALUE
    if field.kind == "numbers":
        return parse_numbers(field, text, node, diagnostics, label)
    if field.kind == "str":
        value = text
    elif field.kind in ("float", "triple"):
        value = parse_number(text)
        original = field.xml.original
        is_lenient = original.allows_trailing_text or diagnostics.allows_trailing_text
        is_lenient = is_lenient and not _COMMA.fullmatch(text)
        if value is None and is_lenient and (prefix := _NUMBER.match(text)):
            value = parse_number(prefix[0])
            if value is not None:
                message = f"{label} is {quote(text)}; read as {value:g}, as the original does"
                diagnostics.warning(node, message)
        value = NO_VALUE if value is None else value
    elif field.kind == "int":
        prefix = _LEADING_INT.match(text)
        if prefix and len(prefix[0]) < 12 and abs(int(prefix[0])) < 2**31:
            value = int(prefix[0])
            if prefix[0] != text:
                diagnostics.warning(
                    node, f"{label} is {quote(text)}; read as {value}, as the original does"
                )
    elif field.kind == "bool":
        value = {"0": False, "1": True}.get(text, NO_VALUE)
        if field.xml.attribute and value is NO_VALUE:
            value = {"false": False, "true": True}.get(text, NO_VALUE)
        if value is NO_VALUE and not field.xml.attribute and not field.xml.namespaced:
            substitute = field.xml.original.invalid_flag_value
            value = field.default if substitute is None else substitute
            message = f"{label} is {quote(text)}; expected 0 or 1; read as {value:d}"
            diagnostics.warning(node, f"{message}, as the original does")
    elif field.kind == "word":
        value = _parse_word(field, text, node, diagnostics, label)
    if field.xml.original.is_clamped and value is not NO_VALUE:
        value = _clamp(field, value, node, diagnostics, label)
    has_limits = value is not NO_VALUE and field.kind in ("float", "int", "triple")
    if has_limits and not field.allows(value):
        value = NO_VALUE
    if field.kind in ("float", "triple") and value is not NO_VALUE and abs(value) > MAX_NUMBER:
        diagnostics.error(node, f"{label} is {quote(text)}; no quantity is beyond {MAX_NUMBER:g}")
        return NO_VALUE
    if value is NO_VALUE:
        is_short = len(text) < 80
        suggestion = did_you_mean(text, field.type) if field.kind == "word" and is_short else ""
        if field.kind in ("float", "triple") and is_short and _COMMA.fullmatch(text):
            suggestion = f" Did you mean {text.replace(',', '.')}?"
        diagnostics.error(
            node, f"{label} is {quote(text)}; expected {field.expected}.{suggestion}".rstrip(".")
        )
    return value


def _parse_word(
    field: Field, text: str, node: etree._Element, diagnostics: Diagnostics, label: str
) -> Any:
    """Parse one of the words of a field.

    In an element of the original, case, blanks, ``-`` and ``_`` are ignored, with a warning.
    """
    if text in field.type:
        return text
    if field.xml.namespaced:
        return NO_VALUE
    words = {_normalize_word(word): word for word in field.type}
    word = words.get(_normalize_word(text))
    if word is None:
        return NO_VALUE
    diagnostics.warning(node, f"{label} is {quote(text)}; read as {word!r}")
    return word


def _normalize_word(word: str) -> str:
    return _SEPARATORS.sub("", word).lower()


def _clamp(
    field: Field, value: float, node: etree._Element, diagnostics: Diagnostics, label: str
) -> float:
    """Clamp a number to the limits of its field, with a warning.

    A size with the wrong sign, and a count that is too small, are errors: they are returned as is.
    """
    minimum = field.xml.limits.get("minimum", -MAX_NUMBER)
    maximum = field.xml.limits.get("maximum", MAX_NUMBER)
    clamped_value = min(max(value, minimum), maximum)
    is_error = value < minimum and (value < 0.0 < minimum or field.kind == "int")
    if clamped_value == value or is_error:
        return value
    is_allowed = field.allows(value)
    reason = f"no quantity is beyond {MAX_NUMBER:g}" if is_allowed else f"expected {field.expected}"
    diagnostics.warning(node, f"{label} is {value:g}; {reason}; clamped to {clamped_value:g}")
    return clamped_value if field.kind != "int" else int(clamped_value)


def parse_numbers(
    field: Field, text: str, node: etree._Element, diagnostics: Diagnostics, label: str
) -> Any:
    """Parse numbers that are separated by blanks or commas."""
    words = text.replace(",", " ").split()
    values = [parse_number(word) for word in words]
    excessive_words = [
        word for word, value in zip(words, values, strict=True) if abs(value or 0) > MAX_NUMBER
    ]
    invalid_words = [
        word for word, value in zip(words, values, strict=True)
        if value is None or not field.allows(value)
    ]  # fmt: skip
    max_count = field.xml.limits.get("max_count", MAX_NUMBERS)
    if len(words) > max_count:
        message = f"has {len(words)} numbers; expected {max_count} at most"
    elif invalid_words or not words:
        message = f"contains {quote((invalid_words or [text])[0])}; expected {field.expected}"
    elif excessive_words:
        message = f"contains {quote(excessive_words[0])}; no quantity is beyond {MAX_NUMBER:g}"
    elif field.type and len(words) != field.type:
        message = f"has {len(words)} numbers; expected {field.type}"
    else:
        return tuple(values)
    diagnostics.error(node, f"{label} {message}")
    return NO_VALUE


def parse_number(text: str) -> float | None:
    """Parse a number or an ``M_PI`` token; return None if it is neither, or not finite."""
    if text in TOKENS:
        return TOKENS[text]
    if len(text) > 400 or not _NUMBER.fullmatch(text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None
