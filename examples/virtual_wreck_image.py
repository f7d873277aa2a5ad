"""Draw the figure of docs/virtual-sensors.md: a wreck and turbid water in an image of a pool.

    python examples/virtual_wreck_image.py docs/images/virtual-wreck.jpg

The image of the pool stands for that of a real camera; uwsim renders it, too.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

from uwsim.assets.bundled import scene_file
from uwsim.devices.lamp import LampSpec
from uwsim.physics.compile_scene import compile_scene
from uwsim.scene.object import ObjectSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.simulation import Simulation
from uwsim.virtual_sensors import ComposedCamera, ImageComposition

Pixels = npt.NDArray[np.uint8]
WIDTH, HEIGHT, GAP = 560, 420, 8
"""The size of a panel and the gap between panels [px]."""
JPEG_QUALITY = 88
WRECK = ObjectSpec(
    name="wreck",
    file="objects/wreck.glb",
    position=(0.2, 0.3, 4.05),
    orientation=(math.pi, 0.03, 0.85),
    scale_factor=(0.24, 0.24, 0.24),
)
WATERS = (None, "jerlov-1C")
"""The water that is added over the image of the pool; None: none."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw a virtual wreck in a pool.")
    parser.add_argument("image", type=Path)
    real_image = take_image(make_scene())
    panels = [real_image, *(compose(real_image, water) for water in WATERS)]
    Image.fromarray(join_panels(panels)).save(
        parser.parse_args().image, quality=JPEG_QUALITY, subsampling=0
    )


def make_scene(*objects: ObjectSpec, water: str | None = None) -> SceneSpec:
    """Return the scene of the pool with virtual objects, and another water."""
    scene = read_scene(scene_file("bluerov2-scene"))
    vehicle, ocean = scene.vehicles[0], scene.ocean_state
    parts = [part for part in vehicle.parts if not isinstance(part, LampSpec)]
    large_parts = [
        replace(part, resw=WIDTH, resh=HEIGHT, fovy=65.0, std=0.0, quality="polished")
        if isinstance(part, VirtualCameraSpec)
        else part
        for part in parts
    ]
    vehicle = replace(
        vehicle,
        position=(-5.2, -2.3, 2.1),
        orientation=(0.0, -0.16, 0.30),
        parts=tuple(large_parts),
    )
    if water is not None and ocean.water is not None:
        ocean = replace(ocean, water=replace(ocean.water, type=water))
    return replace(
        scene, vehicles=(vehicle,), objects=(*scene.objects, *objects), ocean_state=ocean
    )


def take_image(scene: SceneSpec) -> Pixels:
    with Simulation(compile_scene(scene)) as simulation:
        simulation.advance(0.0)
        image = simulation.world.sensors.camera("camera").capture()
    return np.asarray(image, dtype=np.uint8)


def compose(real_image: Pixels, water: str | None) -> Pixels:
    """Return the image with the wreck, through another water."""
    composition = ImageComposition(
        camera="camera", topic="/camera", adds_water=water is not None, has_shadows=True
    )
    with Simulation(compile_scene(make_scene(WRECK, water=water))) as simulation:
        simulation.advance(0.0)
        return ComposedCamera(simulation, composition, "bluerov2").compose(real_image)


def join_panels(panels: list[Pixels]) -> Pixels:
    """Return the panels side by side on white, (h, w, 3)."""
    gap = np.full((HEIGHT, GAP, 3), 255, np.uint8)
    columns = [part for panel in panels for part in (panel, gap)]
    return np.hstack(columns[:-1])


if __name__ == "__main__":
    main()
