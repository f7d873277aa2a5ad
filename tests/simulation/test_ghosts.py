"""A ghost (``vr``): seen from outside the scene, not by its cameras."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec


def scene_in(folder: Path, *, vr: bool) -> SceneSpec:
    """A camera that looks down at a box 2 m below it, which is a vehicle."""
    robot = write_robot(folder, f'<link name="base_link">{shape(colour="1 0 0 1")}</link>')
    camera = VirtualCameraSpec(name="eye", relative_to="base_link", resw=32, resh=24)
    watcher = VehicleSpec(
        name="watcher", file=str(robot), position=(0.0, 0.0, -1.0), parts=(camera,)
    )
    seen = VehicleSpec(name="seen", file=str(robot), position=(0.0, 0.0, -3.0), vr=vr)
    return replace(scene_of(watcher), vehicles=(watcher, seen))


@pytest.mark.parametrize("vr", [False, True])
def test_cameras_do_not_see_a_ghost_and_viewers_do(tmp_path: Path, vr: bool) -> None:
    with open_scene(scene_in(tmp_path, vr=vr)) as simulation:
        number = next(each.id for each in simulation.world.scenery.parts if each.is_hidden is vr
                      and each.name == "seen/base_link")  # fmt: skip
        by_camera = simulation.image("eye").ids
        camera = simulation.world.sensors.camera("eye")
        from_outside = simulation.world.scenery.render_view(
            camera.world_from_camera, camera.intrinsics, targets={"ids"}
        ).ids
    assert by_camera is not None
    assert from_outside is not None
    assert bool(np.any(by_camera == number)) is not vr
    assert np.any(from_outside == number)
