"""How elements and values are called in messages."""

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
    """A qualified name as an element, with the namespace when it is none of ours."""
    if tag.startswith("{"):
        space, _, name = tag[1:].partition("}")
        return f"<u:{name[:60]}>" if space == NAMESPACE else f"<{name[:60]}> (in {space[:60]!r})"
    return f"<{tag[:60]}>"


def cut(text: str) -> str:
    """A value in quotes, cut when it is long."""
    return repr(text if len(text) <= 60 else text[:57] + "...")
