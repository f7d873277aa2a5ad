"""Writes a `SceneSpec` as a scene file; reading it gives an equal spec."""

from __future__ import annotations

from lxml import etree

from ..schema import NAMESPACE, write
from .reader import ROOT
from .spec import SceneSpec


def write_scene(scene: SceneSpec) -> str:
    """Write a scene as the text of a file; what equals its default is left out.

    It carries no DOCTYPE: one is only needed by the original, which reads what `to_original` gives.
    """
    return _text(write(scene, ROOT))


def to_original(scene: SceneSpec) -> str:
    """Write a scene without its extensions, as the original reads it, DOCTYPE included."""
    root = write(scene, ROOT)
    drop_extensions(root)
    return _text(root, doctype=f'<!DOCTYPE {ROOT} SYSTEM "{ROOT}.dtd">')


def drop_extensions(root: etree._Element) -> None:
    """Take every element and attribute of the namespace ``u`` out of a tree."""
    mark = f"{{{NAMESPACE}}}"
    for node in list(root.iter("*")):
        for name in [name for name in node.attrib if str(name).startswith(mark)]:
            del node.attrib[name]
        parent = node.getparent()
        if str(node.tag).startswith(mark) and parent is not None:
            parent.remove(node)
    etree.cleanup_namespaces(root)


def _text(root: etree._Element, *, doctype: str = "") -> str:
    etree.indent(root)
    head = '<?xml version="1.0"?>\n' + (doctype + "\n" if doctype else "")
    return head + str(etree.tostring(root, encoding="unicode")) + "\n"
