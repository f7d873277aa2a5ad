"""Elements of a benchmark file, as tables and messages name them."""

from __future__ import annotations

import re

from lxml import etree

from ..schema import NAMESPACE


def name_of(node: etree._Element) -> str:
    """The name of an element in a table: ``distance``, or ``u:topSpeed`` for an extension."""
    return str(node.tag).replace(f"{{{NAMESPACE}}}", "u:")


def place_of(node: etree._Element, message: str) -> etree._Element:
    """Return the child that a message begins with, as ``<step> ...``; else the element."""
    named = re.match(r"<(\w+)>", message)
    child = None if named is None else node.find(named[1])
    return node if child is None else child
