"""A vehicle that follows a table of poses: interpolation, gaps, velocities and invalid tables."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.base.geometry import rotation_about
from uwsim.devices.motion.pose_track import PoseTrack, interpolate_rotation
from uwsim.devices.motion.scripted_motion import (
    TITLES,
    ScriptedMotionSpec,
    read_poses,
    write_poses,
)
from uwsim.errors import AssetError, BadSetting
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec

NO_TURN = [1.0, 0.0, 0.0, 0.0]


def track(times: list[float], x: list[float], **settings: object) -> PoseTrack:
    positions = np.column_stack([x, np.zeros(len(x)), np.zeros(len(x))])
    quaternions = np.tile(NO_TURN, (len(x), 1))
    return PoseTrack(np.array(times), positions, quaternions, **settings)  # type: ignore[arg-type]


def scripted_scene(folder: Path, text: str, **settings: object) -> SceneSpec:
    robot = write_robot(folder, f'<link name="base_link">{shape()}</link>')
    (folder / "trajectory.csv").write_text(text)
    spec = ScriptedMotionSpec(file="trajectory.csv", **settings)  # type: ignore[arg-type]
    vehicle = VehicleSpec(name="rov", file=str(robot), parts=(spec,))
    return replace(scene_of(vehicle), path=str(folder / "scene.xml"))


def test_positions_are_linear_and_rotations_turn_evenly_on_the_shorter_arc() -> None:
    axis = np.array([0.6, 0.0, 0.8])
    angle, fraction = 2.0, 0.3
    start, end = np.array(NO_TURN), np.array([math.cos(1.0), *(math.sin(1.0) * axis)])
    for target in (end, -end):
        middle = interpolate_rotation(start, target, fraction)
        half = 0.5 * angle * fraction
        assert middle == pytest.approx([math.cos(half), *(math.sin(half) * axis)])
    positions, quaternions = np.array([[0.0, 1.0, 2.0], [1.0, 1.0, 0.0]]), np.array([start, end])
    pose = PoseTrack(np.array([2.0, 4.0]), positions, quaternions).pose(2.6)
    assert pose.position == pytest.approx([0.3, 1.0, 1.4])
    assert pose.rotation == pytest.approx(rotation_about(axis, 0.6))


def test_before_the_first_and_after_the_last_pose_the_body_rests() -> None:
    poses = track([1.0, 2.0], [3.0, 5.0])
    assert [poses.pose(time).position[0] for time in (0.0, 1.5, 9.0)] == [3.0, 4.0, 5.0]


def test_a_gap_is_held_or_crossed_or_refused() -> None:
    times, x = [0.0, 1.0, 11.0], [0.0, 1.0, 11.0]
    assert track(times, x, max_gap=2.0, gaps="hold").pose(6.0).position[0] == 1.0
    assert track(times, x, max_gap=2.0, gaps="interpolate").pose(6.0).position[0] == 6.0
    with pytest.raises(BadSetting, match=r"1 gaps of more than 2 s.* from 1 s to 11 s"):
        track(times, x, max_gap=2.0, gaps="refuse")
    assert track(times, x, max_gap=2.0).has_gap(6.0)
    assert not track(times, x, max_gap=2.0).has_gap(0.5)


def test_poses_that_are_not_finite_are_part_of_a_gap() -> None:
    poses = track([0.0, 1.0, 2.0], [0.0, math.nan, 4.0])
    assert poses.n_left_out == 1
    assert poses.pose(1.0).position[0] == 2.0
    with pytest.raises(BadSetting, match="No pose of 2 is finite"):
        track([0.0, 1.0], [math.inf, 1e9])
    with pytest.raises(BadSetting, match="do not increase: 1 s follows 1 s"):
        track([0.0, 1.0, 1.0], [0.0, 1.0, 2.0])


def test_the_vehicle_is_at_the_pose_of_each_step_and_has_its_velocity(tmp_path: Path) -> None:
    text = f"{TITLES}\n0,0,0,-1,1,0,0,0\n2,1,0,-1,0.5,0,0,0.8660254037844386\n"
    with open_scene(scripted_scene(tmp_path, text, max_gap=5.0)) as simulation:
        for steps in (0, 1, 200, 700):
            simulation.advance(0.002 * steps)
            time = simulation.time
            pose = simulation.pose("rov")
            assert pose.position == pytest.approx([min(0.5 * time, 1.0), 0.0, -1.0], abs=1e-12)
        vehicle = simulation.world.vehicles.find("rov")
        turn_rate = 2.0 * math.pi / 3.0 / 2.0
        assert np.linalg.norm(vehicle.velocity[:3]) == pytest.approx(0.5)
        assert vehicle.velocity[3:] == pytest.approx([0.0, 0.0, turn_rate], abs=1e-6)


def test_the_start_has_no_velocity(tmp_path: Path) -> None:
    text = f"{TITLES}\n0,500,0,-1,1,0,0,0\n2,500,0,-1,1,0,0,0\n"
    with open_scene(scripted_scene(tmp_path, text)) as simulation:
        simulation.advance(0.0)
        assert simulation.pose("rov").position[0] == 500.0
        velocity = simulation.world.vehicles.find("rov").velocity
        assert velocity == pytest.approx(np.zeros(6))


def test_a_table_is_written_as_it_is_read(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    times, positions = np.cumsum(rng.random(20)), rng.normal(size=(20, 3))
    quaternions = rng.normal(size=(20, 4))
    positions[3] = math.nan
    path = tmp_path / "poses.csv"
    path.write_text(write_poses(times, positions, quaternions))
    for before, after in zip(
        (times, positions, quaternions), read_poses(path, name="p"), strict=True
    ):
        assert np.array_equal(before, after, equal_nan=True)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time,x\n", "p:1: has the columns time, x; expected time, x, y"),
        (f"{TITLES}\n0,1\n", "p:2: has 2 cells; expected 8"),
        (f"{TITLES}\n0,0,0,0,1,0,0,up\n", "p:2: has a cell that is no number"),
    ],
)
def test_an_invalid_table_is_an_error_with_its_line(
    tmp_path: Path, text: str, message: str
) -> None:
    path = tmp_path / "poses.csv"
    path.write_text(text)
    with pytest.raises(AssetError, match=message):
        read_poses(path, name="p")
