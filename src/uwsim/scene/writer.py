"""Writer of a `SceneSpec` as a scene file; reading it gives an equal spec."""

from __future__ import annotations

from lxml import etree

from ..schema import write
from .reader import ROOT
from .spec import SceneSpec


def write_scene(scene: SceneSpec) -> str:
    """Write a scene as the text of a file; omit what equals its default.

    It has no DOCTYPE: only the original needs one.
    """
    root = write(scene, ROOT)
    etree.indent(root)
    return f'<?xml version="1.0"?>\n{etree.tostring(root, encoding="unicode")}\n'
