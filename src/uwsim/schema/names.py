"""Texts for names of elements and for values in messages."""

from __future__ import annotations

from lxml import etree

NAMESPACE = "urn:uwsim:1"
"""The namespace of extensions in scene and benchmark files; its prefix is ``u``."""


def prefixed_name(tag: str) -> str:
    """Return a qualified name as a user writes it, with ``u:`` before extensions."""
    return tag.replace(f"{{{NAMESPACE}}}", "u:")


def describe(node: etree._Element) -> str:
    """Return an element as it is written, ``<name>``, shortened if it is long."""
    return format_tag(str(node.tag))


def format_tag(tag: str) -> str:
    """Return a qualified name as an element, with its namespace if that is unknown."""
    if tag.startswith("{"):
        namespace, _, name = tag[1:].partition("}")
        return (
            f"<u:{name[:60]}>"
            if namespace == NAMESPACE
            else f"<{name[:60]}> (in {namespace[:60]!r})"
        )
    return f"<{tag[:60]}>"


NAMESPACE_ADVICE = {
    "http://ros.org/wiki/xacro": "; expand the file with xacro first",
    "http://www.ros.org/wiki/xacro": "; expand the file with xacro first",
    "http://wiki.ros.org/xacro": "; expand the file with xacro first",
    "http://www.w3.org/2001/XInclude": "; nothing is included: write it here",
}
"""The advice about other namespaces that users' files contain, by namespace."""


def advice(tag: str) -> str:
    """Return advice about an element of another namespace; empty if there is none."""
    if not tag.startswith("{"):
        return ""
    namespace = tag[1:].partition("}")[0]
    if namespace.startswith("urn:uwsim") and namespace != NAMESPACE:
        return f"; the namespace of extensions is xmlns:u={NAMESPACE!r}"
    return NAMESPACE_ADVICE.get(namespace, "")


def format_attribute(name: str) -> str:
    """Return a qualified name as an attribute, with its namespace if that is unknown."""
    return format_tag(name).replace("<", "", 1).replace(">", "", 1)


def quote(text: str) -> str:
    """Return a value in quotes, shortened if it is long."""
    return repr(text if len(text) <= 60 else text[:57] + "...")
