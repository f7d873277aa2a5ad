"""The names of the segments that forces place, such as those of tethers."""

from __future__ import annotations

from collections.abc import Iterator

from ..scene.spec import SceneSpec
from .body_names import segment_body


def segment_names(scene: SceneSpec) -> Iterator[tuple[str, str]]:
    """Yield the name in the engine's model and the name in the scene, ``tether/0``, of segments."""
    for index, force in enumerate(scene.forces):
        segments = force.drawn_segments
        for segment in range(0 if segments is None else segments.n):
            yield segment_body(index, segment), f"{force.name}/{segment}"
