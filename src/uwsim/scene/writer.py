"""Writer of a `SceneSpec` as a scene file, from which the reader returns an equal spec."""

from __future__ import annotations

from ..schema import write
from ..schema.layout import lay_out
from .reader import ROOT
from .spec import SceneSpec


def write_scene(scene: SceneSpec) -> str:
    """Return a scene as the text of a scene file, without values that equal their defaults.

    The text has no DOCTYPE, which only the original UWSim needs.
    """
    return lay_out(write(scene, ROOT))
