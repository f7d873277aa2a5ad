"""The names of XML elements in tables and error messages."""

from __future__ import annotations

import re

from lxml import etree

from ..schema import NAMESPACE


def element_name(node: etree._Element) -> str:
    """Return the name of an element, ``distance``, or ``u:topSpeed`` in the uwsim namespace."""
    return str(node.tag).replace(f"{{{NAMESPACE}}}", "u:")


def error_node(node: etree._Element, message: str) -> etree._Element:
    """Return the child that a message begins with (``<step> ...``), or else the element itself."""
    match = re.match(r"<(\w+)>", message)
    child = None if match is None else node.find(match[1])
    return node if child is None else child
