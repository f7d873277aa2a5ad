"""``showTrajectory``: where a body went, in L, at least 0.02 m apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim import Simulation
from uwsim.assets.bundled import bundled_files
from uwsim.checks import check_file
from uwsim.messages import TwistStamped
from uwsim.scene.reader import read_scene
from uwsim.scene.sim_params import ShowTrajectorySpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec

TWIST = ROSTwistToPATSpec(topic="/twist", vehicle_name="girona500")


def driven(*shown: ShowTrajectorySpec) -> Simulation:
    """A vehicle that was driven along its x axis for a second at 0.5 m/s."""
    scene = read_scene(bundled_files("scenes")["visibility-scene"])
    params = replace(scene.sim_params, show_trajectory=shown)
    simulation = open_scene(
        replace(scene, sim_params=params, ros_interfaces=(TWIST,)), is_blind=True
    )
    message = TwistStamped()
    message.twist.linear.x = 0.5
    for _ in range(100):
        simulation.publish("/twist", message)
        simulation.advance(0.01)
    return simulation


def test_points_are_at_least_2_cm_apart_and_lie_on_the_path() -> None:
    shown = ShowTrajectorySpec(target="girona500/base_link", color=(0.0, 1.0, 0.0))
    with driven(shown) as simulation:
        (trajectory,) = simulation.world.trajectories
        points, times = trajectory.points, trajectory.times
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        assert (steps > 0.02).all()
        assert (steps < 0.03).all()
        assert points[-1] == pytest.approx(simulation.pose("girona500").position, abs=0.03)
        assert (np.diff(times) > 0.0).all()
        assert trajectory.spec.color == (0.0, 1.0, 0.0)
        saved = simulation.save()
        trajectory.clear()
        assert trajectory.points.shape == (0, 3)
        simulation.restore(saved)
        assert np.array_equal(trajectory.points, points)


def test_points_older_than_the_time_window_go_and_unknown_targets_are_left_out() -> None:
    window = ShowTrajectorySpec(target="girona500", time_window=0.3)
    with driven(window, ShowTrajectorySpec(target="nowhere")) as simulation:
        (trajectory,) = simulation.world.trajectories
        assert trajectory.times.min() >= simulation.time - 0.3 - 1e-9
        assert len(trajectory.points) > 3
        simulation.advance(1.0)
        assert len(trajectory.points) <= 1


def test_check_does_not_call_them_unsimulated() -> None:
    found = [each.message for each in check_file(bundled_files("scenes")["cirs"])]
    assert not [message for message in found if "trajector" in message]
