"""Bounding boxes of bodies: as large as what they bound."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE
from tests.simulation.small_robots import joint, scene_of, write_robot
from tests.support.opened import open_scene
from uwsim.base.compatibility import COMPATIBILITY, compatibility
from uwsim.base.geometry import rotation_x, rotation_z
from uwsim.errors import UnknownName
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation.bodies import scaled_box
from uwsim.world import Box

BOX = Box((-1.0, -2.0, 0.0), (1.0, 2.0, 3.0))


def test_a_box_that_is_not_scaled_stays_as_it_is() -> None:
    assert scaled_box(BOX, rotation_x(0.3), (1.0, 1.0, 1.0)) is BOX


def test_a_scale_acts_along_the_axes_of_the_object_not_of_the_mesh() -> None:
    doubled = scaled_box(BOX, np.eye(3), (2.0, 1.0, 0.5))
    assert (doubled.lower, doubled.upper) == ((-2.0, -2.0, 0.0), (2.0, 2.0, 1.5))
    turned = scaled_box(BOX, rotation_z(np.pi / 2), (2.0, 1.0, 0.5))  # its y is the object's -x
    assert turned.lower == pytest.approx((-1.0, -4.0, 0.0))
    assert turned.upper == pytest.approx((1.0, 4.0, 1.5))


def test_an_even_scale_does_not_care_how_the_mesh_is_turned() -> None:
    tripled = scaled_box(BOX, rotation_x(0.7) @ rotation_z(0.2), (3.0, 3.0, 3.0))
    assert tripled.lower == pytest.approx((-3.0, -6.0, 0.0))
    assert tripled.upper == pytest.approx((3.0, 6.0, 9.0))


def test_a_mesh_that_is_sheared_lies_within_its_box() -> None:
    turn, scale = rotation_x(0.7), (1.0, 2.0, 0.5)
    sheared = scaled_box(BOX, turn, scale)
    corners = BOX.corners() @ (turn.T @ np.diag(scale) @ turn).T
    assert (corners >= np.array(sheared.lower) - 1e-12).all()
    assert (corners <= np.array(sheared.upper) + 1e-12).all()


def test_the_box_of_a_scaled_object_is_scaled_except_in_the_original() -> None:
    scene = read_scene(SCENE).nominal_scene
    black_box = next(thing for thing in scene.objects if thing.name == "blackbox")
    sizes = []
    for scale, quirks in (
        ((1.0, 1.0, 1.0), frozenset[str]()),
        ((2.0, 3.0, 0.5), frozenset[str]()),
        ((2.0, 3.0, 0.5), frozenset({"box-scale"})),
    ):
        thing = replace(black_box, scale_factor=scale, offsetr=(0.0, 0.0, 0.0))
        simulation = open_scene(
            replace(scene, vehicles=(), objects=(thing,), ros_interfaces=()),
            compatibility=quirks,
        )
        box = simulation.world.bodies.find("blackbox").box
        simulation.close()
        assert box is not None
        sizes.append(np.subtract(box.upper, box.lower))
    as_it_is, scaled, original = sizes
    assert scaled == pytest.approx(as_it_is * [2.0, 3.0, 0.5])
    assert original == pytest.approx(as_it_is)


def test_what_an_object_that_never_moves_hands_out_is_a_copy() -> None:
    body = open_scene(read_scene(SCENE).nominal_scene).world.bodies.find("blackbox")
    place, turn = body.world_from_body.position, body.world_from_body.rotation
    body.world_from_body.position[:] = np.nan
    body.world_from_body.rotation[:] = np.nan
    assert (body.world_from_body.position == place).all()
    assert (body.world_from_body.rotation == turn).all()


def test_all_quirks_of_the_original_leave_a_camera_where_scenes_since_2014_put_it() -> None:
    assert compatibility(["uwsim"]) == COMPATIBILITY.keys() - {"visual-frames"}
    scene = read_scene(SCENE).nominal_scene
    looks = {}
    for name in ("", "uwsim", "visual-frames"):
        asked = compatibility([name] if name else [])
        camera = open_scene(scene, compatibility=asked).world.sensors.camera("bowtech1")
        looks[name] = -camera.world_from_camera.rotation[:, 2]  # along -z of OpenGL
    assert looks[""] == pytest.approx((0.0, 0.0, -1.0), abs=0.01)
    assert looks["uwsim"] == pytest.approx(looks[""])
    assert looks["visual-frames"] == pytest.approx((0.0, 0.0, 1.0), abs=0.01)


def test_a_link_of_which_nothing_is_seen_has_its_own_frame_for_a_visual_one() -> None:
    simulation = open_scene(read_scene(SCENE).nominal_scene)
    link, visual = (
        simulation.world.bodies.find(f"girona500/end_effector{at}") for at in ("", "@visual")
    )
    assert visual.world_from_body.position == pytest.approx(link.world_from_body.position)
    assert visual.box is None


def test_a_link_whose_name_has_a_slash_is_found_by_its_route(tmp_path: Path) -> None:
    """As in robot files that put the names of links in a name space."""
    inside = '<link name="ns/base_link"/><link name="tool"/>' + joint("j", "ns/base_link tool")
    vehicle = VehicleSpec(name="rov", file=str(write_robot(tmp_path, inside)))
    world = open_scene(scene_of(vehicle), is_blind=True).world
    found = [
        world.bodies.find(route).name
        for route in ("ns/base_link", "/rov/ns/base_link/", "rov/x/tool")
    ]
    assert found == ["ns/base_link", "rov/ns/base_link", "rov/tool"]
    with pytest.raises(UnknownName):
        world.bodies.find("rov/ns")
