"""The names of elements of a benchmark file in tables and messages."""

from __future__ import annotations

import re

from lxml import etree

from ..schema import NAMESPACE


def element_name(node: etree._Element) -> str:
    """Return an element's name in a table: ``distance``, or ``u:topSpeed`` for an extension."""
    return str(node.tag).replace(f"{{{NAMESPACE}}}", "u:")


def error_node(node: etree._Element, message: str) -> etree._Element:
    """Return the child whose name begins a message, as ``<step> ...``; else the element."""
    match = re.match(r"<(\w+)>", message)
    child = None if match is None else node.find(match[1])
    return node if child is None else child
