"""Vehicles and objects of one name are each where they are, in replays, live views and films."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.base.geometry import Intrinsics, Pose, rotation_from_quaternion
from uwsim.rendering.rendered_image import PixelBox, RenderedImage
from uwsim.scene.object import ObjectSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation.tracked_state import TrackedState
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob

FILE = "objects/blackbox_uib_trimesh.osg"


def twins(folder: Path) -> SceneSpec:
    """Two vehicles and two objects of one name, and an object called as a link."""
    robot = write_robot(folder, f'<link name="base_link">{shape(size=(0.2, 0.1, 0.1))}</link>')
    rovs = [VehicleSpec(name="rov", file=str(robot), position=(0.0, float(y), 2.0)) for y in (0, 3)]
    names = ("box", "box", "rov/base_link")
    boxes = [
        ObjectSpec(name=n, file=FILE, position=(2.0, 1.0 * k, 0.0)) for k, n in enumerate(names)
    ]
    boxes[1] = replace(boxes[1], buried=0.5)
    boxes[0] = replace(boxes[0], buried=0.5)
    scene = scene_of(rovs[0], objects=tuple(boxes))
    return replace(scene, vehicles=tuple(rovs))


def test_of_things_of_one_name_each_is_drawn_where_it_is(tmp_path: Path) -> None:
    with open_scene(twins(tmp_path), is_blind=True) as simulation:
        world = simulation.world
        head, state = scene_head(simulation, "twins", Blob()), TrackedState(world)
        names = [body["name"] for body in head["bodies"]]
        assert len(set(names)) == len(names)
        assert len(set(state.bodies)) == len(state.bodies)
        assert set(state.bodies) <= set(names)
        assert len({signal.name for signal in state.signals}) == len(state.signals)
        assert [vehicle["name"] for vehicle in head["vehicles"]] == ["rov", "rov#2"]
        assert [heap["body"] for heap in head["sand"]] == ["sand/box", "sand/box#2"]
        world.vehicles[1].place(Pose(np.array([5.0, -4.0, 3.0]), np.eye(3)))
        rows = state.row()[: 7 * len(state.bodies)].reshape(-1, 7)
        found = {body["name"]: body["pose"] for body in head["bodies"]}
        found |= dict(zip(state.bodies, rows.tolist(), strict=True))
        drawn = [
            (Pose(np.array(pose[:3]), rotation_from_quaternion(np.array(pose[3:]))), visual)
            for body in head["bodies"]
            for pose in [found[body["name"]]]
            for visual in body["visuals"]
        ]
        parts = {
            visual["part"]: pose.matrix @ np.reshape(visual["matrix"], (4, 4))
            for pose, visual in drawn
        }
        for number, part in enumerate(world.scenery.parts, start=1):
            wanted = world.scenery.world_from_mesh(part)
            np.testing.assert_allclose(parts[number], wanted, atol=1e-5, err_msg=part.name)


def test_things_of_one_name_have_boxes_and_ids_of_their_own(tmp_path: Path) -> None:
    scene = twins(tmp_path)
    with open_scene(scene, is_blind=True) as simulation:
        names, boxes = simulation.world.scenery.part_names, simulation.boxes()
        links = [name for name in names.values() if not name.startswith("sand/")]
        assert links == ["rov/base_link", "rov#2/base_link", "box", "box#2", "rov/base_link#2"]
        assert set(links) == set(boxes)
        for name, thing in zip(links, (*scene.vehicles, *scene.objects), strict=True):
            assert np.linalg.norm(boxes[name].pose.position - thing.position) < 0.3
            assert boxes[name].size.max() < 1.0


def test_each_thing_of_one_name_has_a_box_in_the_image() -> None:
    ids = np.zeros((10, 20), np.uint16)
    ids[2:4, 1:3], ids[5:9, 12:15] = 1, 2
    lens = Intrinsics(width=20, height=10, fx=10.0, fy=10.0, cx=10.0, cy=5.0)
    image = RenderedImage(intrinsics=lens, ids=ids, names={1: "pipe", 2: "pipe#2"})
    assert image.boxes == {"pipe": PixelBox(1, 2, 3, 4), "pipe#2": PixelBox(12, 5, 15, 9)}
