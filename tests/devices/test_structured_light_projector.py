"""Projectors of a scene: their images are found, they move with their link, they are seen."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.assets.find import find
from uwsim.base.geometry import Pose
from uwsim.devices.structured_light_projector import StructuredLightProjectorSpec
from uwsim.errors import AssetNotFound
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation

NAMES = ("laser_circles", "laser_lines", "laser_square", "laser_stripe", "white")


def scene(image: str, *, laser: bool = True) -> SceneSpec:
    path = find("cirs.xml")
    assert isinstance(path, Path)
    scene = read_scene(path)
    projector = StructuredLightProjectorSpec(
        name="laser", relative_to="part0", fov=40.0, image_name=image, laser=laser,
        position=(-0.2, 0.2, 0.0), look_at="down",
    )  # fmt: skip
    (vehicle,) = scene.vehicles
    return replace(
        scene,
        vehicles=(replace(vehicle, parts=(*vehicle.parts, projector)),),
        ocean_state=replace(scene.ocean_state, water=None),  # its green light is not counted
    )


def n_green(simulation: Simulation) -> int:
    colour = simulation.image("bowtech2").colour
    assert colour is not None
    red, green = colour[..., 0].astype(int), colour[..., 1].astype(int)
    return int(np.count_nonzero(green > 100 + red))


@pytest.mark.parametrize("name", NAMES)
def test_the_images_of_the_original_are_bundled(name: str) -> None:
    assert find(f"data/textures/{name}.png") is not None


def test_a_laser_is_seen_by_cameras_and_moves_with_its_vehicle() -> None:
    with open_scene(scene("data/textures/laser_square.png")) as simulation:
        before = n_green(simulation)
        state = simulation.world.engine
        turned = state.poses.vehicle(0) @ Pose.from_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 0.5))
        state.place_vehicle(0, turned)
        after = n_green(simulation)
    assert before > 100
    assert after == pytest.approx(before, rel=0.3)


def test_an_image_that_is_nowhere_is_named() -> None:
    with pytest.raises(AssetNotFound, match=r"nothing\.png"):
        open_scene(replace(scene("data/textures/nothing.png"), is_original=False))
