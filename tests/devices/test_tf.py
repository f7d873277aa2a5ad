"""A vehicle that follows a frame of ROS."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.assets.bundled import scene_file
from uwsim.bus import Bus
from uwsim.devices.tf import ReceivedFrames, TfSpec
from uwsim.messages import Quaternion, TFMessage, Transform, TransformStamped, Vector3, header
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SimParamsSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation

NED = SimParamsSpec(offsetr=(math.pi, 0.0, -math.pi / 2))


def frame(
    parent: str, child: str, x: float, y: float, z: float, yaw: float = 0.0
) -> TransformStamped:
    return TransformStamped(
        header=header(0.0, parent),
        child_frame_id=child,
        transform=Transform(
            translation=Vector3(x=x, y=y, z=z),
            rotation=Quaternion(z=math.sin(yaw / 2), w=math.cos(yaw / 2)),
        ),
    )


def simulation_in(folder: Path) -> Simulation:
    robot = write_robot(folder, f'<link name="base_link">{shape()}</link>')
    follows = TfSpec(tf_id="/rov/base", position=(1.0, 0.0, 0.0), orientation=(0.0, 0.0, 0.25))
    vehicle = VehicleSpec(name="rov", file=str(robot), position=(1.0, 2.0, 3.0), tf=follows)
    return open_scene(scene_of(vehicle, sim_params=NED))


def test_a_vehicle_follows_its_frame_through_those_between_with_its_offset(tmp_path: Path) -> None:
    with simulation_in(tmp_path) as simulation:
        simulation.publish("/tf", TFMessage(transforms=[frame("odom", "rov/base", 5.0, 0.0, 4.0)]))
        simulation.advance(2 * simulation.timestep)
        assert simulation.pose("rov").position == pytest.approx([1.0, 2.0, 3.0])
        odom = frame("/world", "odom", 10.0, 20.0, 0.0, yaw=math.pi / 2)
        simulation.publish("/tf", TFMessage(transforms=[odom]))
        simulation.advance(2 * simulation.timestep)
        pose = simulation.pose("rov")
    assert pose.position == pytest.approx([10.0, 26.0, 4.0])
    heading = math.pi / 2 + 0.25
    assert pose.rotation[:2, 0] == pytest.approx([math.cos(heading), math.sin(heading)])


def test_what_it_follows_is_saved(tmp_path: Path) -> None:
    with simulation_in(tmp_path) as first, simulation_in(tmp_path) as second:
        first.publish("/tf", TFMessage(transforms=[frame("world", "odom", 1.0, 0.0, 0.0)]))
        first.advance(2 * first.timestep)
        second.restore(first.save())
        moved = TFMessage(transforms=[frame("odom", "rov/base", 5.0, 0.0, 4.0)])
        for each in (first, second):
            each.publish("/tf", moved)
            each.advance(2 * each.timestep)
        assert second.pose("rov").position == pytest.approx([7.0, 0.0, 4.0])
        assert np.array_equal(first.pose("rov").position, second.pose("rov").position)


def heard(*frames: TransformStamped) -> ReceivedFrames:
    bus = Bus()
    found = ReceivedFrames(bus)
    bus.publisher("/tf", TFMessage)(TFMessage(transforms=[*frames]))
    bus.deliver()
    return found


def test_frames_in_a_circle_lead_nowhere() -> None:
    found = heard(frame("a", "b", 1.0, 0.0, 0.0), frame("b", "a", 1.0, 0.0, 0.0))
    assert found.find("a") is None


def test_a_transform_that_is_none_is_left_out() -> None:
    sound = frame("world", "a", 1.0, 0.0, 0.0)
    nothing = replace(sound.transform, rotation=Quaternion(w=0.0))
    nowhere = replace(sound.transform, translation=Vector3(x=math.nan))
    far = replace(sound.transform, translation=Vector3(x=1e300))
    bad = [replace(sound, transform=each) for each in (nothing, nowhere, far)]
    found = heard(sound, *bad)
    pose = found.find("a")
    assert pose is not None
    assert pose.position.tolist() == [1.0, 0.0, 0.0]


def test_a_vehicle_in_water_follows_the_same_in_steps_taken_one_by_one(tmp_path: Path) -> None:
    def end(*, at_once: bool) -> np.ndarray:
        scene = read_scene(scene_file("currents-scene", ())).nominal_scene
        vehicle = replace(scene.vehicles[0], parts=(), tf=TfSpec(tf_id="leader"))
        with open_scene(replace(scene, vehicles=(vehicle,), ros_interfaces=())) as simulation:
            x, y, z = vehicle.position
            leader = frame("world", "leader", x + 0.5, y, z)
            simulation.publish("/tf", TFMessage(transforms=[leader]))
            for _ in range(1 if at_once else 250):
                simulation.advance(0.5 if at_once else 0.002)
            return simulation.pose("girona500").position

    moved = end(at_once=True)
    assert np.array_equal(moved, end(at_once=False))
