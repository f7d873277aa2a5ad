"""The layout of written XML: short elements on one line, as in the bundled files."""

from __future__ import annotations

import itertools

from lxml import etree

from .values import TOKENS

LINE_WIDTH = 100
"""The greatest width of a line that contains several elements [characters]."""
MAX_INLINE_DEPTH = 2
"""The greatest depth of an element that is written on one line, the element itself included."""
_ANGLE_TAGS = frozenset("xyzrp")
_TOKEN_TEXTS = {repr(value): token for token, value in TOKENS.items()}


def lay_out(root: etree._Element) -> str:
    """Return the text of a file: its root element with line breaks and indentation.

    An element whose children have no elements of their own is on one line, if it fits:
    ``<position> <x>1</x> <y>0</y> <z>2</z> </position>``.
    """
    _name_constants(root)
    _indent(root, 0)
    return f'<?xml version="1.0"?>\n{etree.tostring(root, encoding="unicode")}\n'


def _name_constants(root: etree._Element) -> None:
    """Replace multiples of pi in triples by their names, as files have them: ``M_PI_2``."""
    for node in root.iter("*"):
        if node.tag in _ANGLE_TAGS and node.text in _TOKEN_TEXTS:
            node.text = _TOKEN_TEXTS[node.text]


def _indent(node: etree._Element, level: int) -> None:
    """Insert white space between the children of an element."""
    if len(node) == 0:
        return
    is_short = level > 0 and _depth(node) <= MAX_INLINE_DEPTH
    if is_short and 2 * level + _inline_width(node) <= LINE_WIDTH:
        node.text = " "
        for child in node:
            child.tail = " "
        return
    node.text = "\n" + "  " * (level + 1)
    for child in node:
        _indent(child, level + 1)
        child.tail = "\n" + "  " * (level + 1)
    if level == 0:
        for child, next_child in itertools.pairwise(node):
            if "\n" in (child.text or "") or "\n" in (next_child.text or ""):
                child.tail = "\n\n  "
    node[-1].tail = "\n" + "  " * level


def _depth(node: etree._Element) -> int:
    return 1 + max((_depth(child) for child in node), default=0)


def _inline_width(node: etree._Element) -> int:
    """Return the width of an element on one line, with a blank around each child."""
    text = etree.tostring(node, encoding="unicode", with_tail=False)
    return len(text.replace(f' xmlns:u="{node.nsmap.get("u")}"', "")) + len(node) + 1
