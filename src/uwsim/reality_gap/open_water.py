"""The water of a scene without its floor, walls and other objects."""

from __future__ import annotations

from dataclasses import replace

from ..scene.spec import SceneSpec


def remove_objects(scene: SceneSpec) -> SceneSpec:
    """Return a scene without its objects, so that a log may have any origin.

    A simulated vehicle then passes through no ground and hits no wall. Sensors that need a floor,
    such as a DVL or an altimeter, measure nothing. Depth still counts from the water's surface.
    """
    return replace(scene, objects=())
