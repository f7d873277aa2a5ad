"""Reader of attributes in robot files: names, numbers, positions and colours."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from ...base.geometry import ZERO, Triple
from ...schema import MAX_DISTANCE, MAX_NUMBER, Diagnostics, parse_number, quote
from ..angles import describe_degrees
from .robot import Colour


def origin_of(node: etree._Element, diagnostics: Diagnostics) -> tuple[Triple, Triple]:
    """Return the position [m] and roll, pitch, yaw [rad] of an ``<origin>``; 0 without one."""
    origin = node.find("origin")
    if origin is None:
        return ZERO, ZERO
    rpy = triple_of(origin, "rpy", diagnostics, ZERO)
    if message := describe_degrees(rpy):
        diagnostics.warning(origin, f"rpy of <origin> is {message}")
    return triple_of(origin, "xyz", diagnostics, ZERO), rpy


def colour_of(node: etree._Element, diagnostics: Diagnostics) -> Colour | None:
    """Return the ``rgba`` of a ``<color>``; None without one."""
    colour = node.find("color")
    if colour is None:
        return None
    values = numbers_of(colour, "rgba", 4, diagnostics)
    if values is None:
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in values)
    if [red, green, blue, opacity] != values:
        text = colour.get("rgba", "")
        diagnostics.warning(colour, f"rgba of <color> is {text[:60]!r}; clamped to 0 to 1")
    return red, green, blue, opacity


def triple_of(
    node: etree._Element, attribute: str, diagnostics: Diagnostics, default: Triple | None
) -> Triple:
    """Return three numbers of an attribute; the default when it is absent."""
    if attribute not in node.attrib and default is not None:
        return default
    values = numbers_of(node, attribute, 3, diagnostics)
    if values is not None and not max(map(abs, values)) <= MAX_DISTANCE:
        text = node.get(attribute, "")
        diagnostics.error(
            node,
            f"{attribute} of <{node.tag}> is {text[:60]!r}; "
            f"expected numbers up to {MAX_DISTANCE:g}",
        )
        return ZERO
    return ZERO if values is None else (values[0], values[1], values[2])


def size_of(
    node: etree._Element, attribute: str, diagnostics: Diagnostics, default: float | None
) -> float:
    """Return a length or mass of at least 0; clamp too large numbers and negative masses."""
    value = number_of(node, attribute, diagnostics, default)
    if node.tag == "mass" or MAX_DISTANCE < value <= MAX_NUMBER:
        return clamp_size(node, attribute, value, diagnostics)
    if not 0 <= value <= MAX_DISTANCE:
        text = node.get(attribute, "")
        diagnostics.error(
            node, f"{attribute} of <{node.tag}> is {text[:60]!r}; expected 0 to {MAX_DISTANCE:g}"
        )
        return 0.0
    return value


def clamp_size(
    node: etree._Element, attribute: str, value: float, diagnostics: Diagnostics
) -> float:
    """Clamp a size or mass to the range from 0 to the limit, with a warning."""
    clamped_value = min(max(value, 0.0), MAX_DISTANCE)
    if clamped_value != value:
        diagnostics.warning(
            node,
            f"{attribute} of <{node.tag}> is {value:g}; expected 0 to {MAX_DISTANCE:g}; clamped to "
            f"{clamped_value:g}",
        )
    return clamped_value


def number_of(
    node: etree._Element, attribute: str, diagnostics: Diagnostics, default: float | None
) -> float:
    """Return a number of an attribute; the default when it is absent."""
    if attribute not in node.attrib and default is not None:
        return default
    values = numbers_of(node, attribute, 1, diagnostics)
    return 0.0 if values is None else values[0]


def numbers_of(
    node: etree._Element, attribute: str, count: int, diagnostics: Diagnostics
) -> list[float] | None:
    """Return the numbers of an attribute; report an error and return None if not ``count``."""
    text = node.get(attribute)
    if text is None:
        diagnostics.error(node, f"<{node.tag}> lacks the attribute {attribute}")
        return None
    words = text.split() if len(text) < 1000 else [text]
    values = [parse_number(word) for word in words if not word.lstrip("-").startswith("M_")]
    if len(words) == count and len(values) == count and None not in values:
        return [value for value in values if value is not None]
    hint = "; expand the file with xacro first" if "${" in text else ""
    expected_text = "a number" if count == 1 else f"{count} numbers"
    message = f"{attribute} of <{node.tag}> is {quote(text)}; expected {expected_text}{hint}"
    diagnostics.error(node, message)
    return None


def name_of(node: etree._Element) -> str:
    """Return the attribute ``name``, trimmed."""
    return (node.get("name") or "").strip()


def elements_of(node: etree._Element) -> Iterator[etree._Element]:
    """Return the child elements, without comments."""
    return (child for child in node if isinstance(child.tag, str))
