"""Names of elements and values in messages."""

from __future__ import annotations

from lxml import etree

NAMESPACE = "urn:uwsim:1"
"""Where extensions of both dialects live; its prefix is ``u``."""


def local(tag: str) -> str:
    """A qualified name as a user writes it, ``u:`` in front of extensions."""
    return tag.replace(f"{{{NAMESPACE}}}", "u:")


def shown(node: etree._Element) -> str:
    """An element as it is written, ``<name>``, cut when it is long."""
    return shown_tag(str(node.tag))


def shown_tag(tag: str) -> str:
    """A qualified name as an element, with the namespace when it is unknown."""
    if tag.startswith("{"):
        space, _, name = tag[1:].partition("}")
        return f"<u:{name[:60]}>" if space == NAMESPACE else f"<{name[:60]}> (in {space[:60]!r})"
    return f"<{tag[:60]}>"


FOREIGN = {
    "http://ros.org/wiki/xacro": "; expand the file with xacro first",
    "http://www.ros.org/wiki/xacro": "; expand the file with xacro first",
    "http://wiki.ros.org/xacro": "; expand the file with xacro first",
    "http://www.w3.org/2001/XInclude": "; nothing is included: write it here",
}
"""Namespaces that are met in such files, and what is to be done about them."""


def advice(tag: str) -> str:
    """Advice about an element of another namespace; empty when there is none."""
    if not tag.startswith("{"):
        return ""
    space = tag[1:].partition("}")[0]
    if space.startswith("urn:uwsim") and space != NAMESPACE:
        return f"; the namespace of extensions is xmlns:u={NAMESPACE!r}"
    return FOREIGN.get(space, "")


def shown_attribute(name: str) -> str:
    """A qualified name as an attribute, with the namespace when it is unknown."""
    return shown_tag(name).replace("<", "", 1).replace(">", "", 1)


def cut(text: str) -> str:
    """A value in quotes, cut when it is long."""
    return repr(text if len(text) <= 60 else text[:57] + "...")
