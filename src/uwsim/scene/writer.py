"""Writer of a `SceneSpec` as a scene file, from which the reader returns an equal spec."""

from __future__ import annotations

from lxml import etree

from ..schema import write
from .reader import ROOT
from .spec import SceneSpec


def write_scene(scene: SceneSpec) -> str:
    """Return a scene as the text of a scene file, without values that equal their defaults.

    The text has no DOCTYPE, which only the original UWSim needs.
    """
    root = write(scene, ROOT)
    etree.indent(root)
    return f'<?xml version="1.0"?>\n{etree.tostring(root, encoding="unicode")}\n'
