"""Virtual sensors and virtual objects for a real vehicle: from a log, or while it moves.

A simulated vehicle follows the poses of the real one. The sensors of its scene observe from there,
and virtual objects and water are drawn into the images of the real camera.

.. code-block:: python

    scene = make_followed_scene(read_scene("wreck.xml"), "bluerov2")
    with Simulation(compile_scene(scene)) as simulation:
        follow_log(simulation, "bluerov2", make_track(read_log("dive.mcap"), FollowSettings()))
"""

from __future__ import annotations

from .composed_camera import ComposedCamera, ImageComposition
from .composition import Layers, compose_image
from .followed_log import (
    FollowSettings,
    choose_vehicle,
    describe_track,
    follow_log,
    make_followed_scene,
    make_track,
    replace_motion,
)

__all__ = [
    "ComposedCamera",
    "FollowSettings",
    "ImageComposition",
    "Layers",
    "choose_vehicle",
    "compose_image",
    "describe_track",
    "follow_log",
    "make_followed_scene",
    "make_track",
    "replace_motion",
]
