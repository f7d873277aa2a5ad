from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import make
from uwsim.base.geometry import Pose, quaternion_from_rotation, rotation_from_xyz
from uwsim.devices.sway import AXES, SwaySpec, displace_pose
from uwsim.messages import Point, Quaternion
from uwsim.messages import Pose as PoseMessage
from uwsim.simulation import Simulation
from uwsim.topics.ros_pose_to_pat import ROSPoseToPATSpec


def swayed(
    position: tuple[float, ...],
    orientation: tuple[float, ...],
    sways: tuple[SwaySpec, ...],
    time: float,
) -> Pose:
    offsets = [(AXES.index(sway.axis), sway.offset(time)) for sway in sways]
    return displace_pose(position, orientation, offsets)


def test_a_vehicle_sways_about_its_place_in_the_file() -> None:
    sways = (
        SwaySpec(axis="x", amplitude=0.1, period=7.0),
        SwaySpec(axis="yaw", amplitude=0.0873, period=11.0),
    )
    start = swayed((2.0, 0.0, 2.5), (0.0, 0.0, 0.0), sways, 0.0)
    assert start.position == pytest.approx([2.0, 0.0, 2.5])
    quarter = swayed((2.0, 0.0, 2.5), (0.0, 0.0, 0.0), sways, 1.75)
    assert quarter.position == pytest.approx([2.1, 0.0, 2.5])
    turned = swayed((2.0, 0.0, 2.5), (0.0, 0.0, 0.0), sways, 2.75)
    assert np.arctan2(turned.rotation[1, 0], turned.rotation[0, 0]) == pytest.approx(0.0873)


def test_two_sways_on_one_axis_add_up() -> None:
    sway = SwaySpec(axis="z", amplitude=0.2, period=4.0)
    pose = swayed((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (sway, sway), 1.0)
    assert pose.position[2] == pytest.approx(1.4)


SWAYS = (
    SwaySpec(axis="x", amplitude=0.1, period=7.0, phase=0.4),
    SwaySpec(axis="roll", amplitude=0.2, period=9.0),
    SwaySpec(axis="yaw", amplitude=0.3, period=11.0, phase=2.0),
)


def by_set_pose(simulation: Simulation, pose: Pose) -> None:
    simulation.set_pose("girona500", pose)


def by_service(simulation: Simulation, pose: Pose) -> None:
    # what /set_entity_state does
    world = simulation.world
    world.vehicles.find("girona500").reset_pose(world.model.scene.world_from_localized @ pose)


def by_message(simulation: Simulation, pose: Pose) -> None:
    w, x, y, z = quaternion_from_rotation(pose.rotation)
    message = PoseMessage(Point(*pose.position), Quaternion(x, y, z, w))
    simulation.publish("/pose", message)
    simulation.advance()


@pytest.mark.parametrize("put", [by_set_pose, by_service, by_message])
def test_a_vehicle_put_elsewhere_sways_about_its_new_place(
    put: Callable[[Simulation, Pose], None],
) -> None:
    place = np.array([0.3, -2.0, 1.0, 0.1, 0.2, -1.2])  # x, y, z, Rx, Ry, Rz
    interfaces = (ROSPoseToPATSpec(topic="/pose", vehicle_name="girona500"),)
    with make(interfaces, change=lambda v: replace(v, parts=SWAYS, dynamics=None)) as simulation:
        simulation.advance(1.0)
        values = place.copy()
        for sway in SWAYS:
            values[AXES.index(sway.axis)] += sway.offset(simulation.time)
        put(simulation, Pose(values[:3], rotation_from_xyz(*values[3:])))
        for wait in (0.1, 3.0, 4.7):
            simulation.advance(wait)
            expected = swayed(tuple(place[:3]), tuple(place[3:]), SWAYS, simulation.time)
            pose = simulation.pose("girona500")
            assert pose.position == pytest.approx(expected.position, abs=2e-3)
            assert pose.rotation == pytest.approx(expected.rotation, abs=2e-3)


def test_a_vehicle_put_elsewhere_begins_at_its_place_in_the_file_after_a_reset() -> None:
    with make((), change=lambda v: replace(v, parts=SWAYS, dynamics=None)) as simulation:
        simulation.advance(1.0)
        before = simulation.pose("girona500")
        simulation.set_pose("girona500", Pose(np.array([3.0, 2.0, 1.0]), np.eye(3)))
        assert simulation.pose("girona500").position == pytest.approx([3.0, 2.0, 1.0])
        simulation.advance(1.0)
        simulation.reset()
        simulation.advance(1.0)
        assert simulation.pose("girona500").position.tolist() == before.position.tolist()
