"""Samples that compiled steps take are those of steps taken one by one, with the same draws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import TWIST, make
from uwsim.currents import ConstantSpec, GaussMarkovSpec, PowerProfileSpec, SceneContext
from uwsim.devices.force_sensor import ForceSensorSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors import DvlSensorSpec, GpsSensorSpec, ImuSpec, PressureSensorSpec, RangeSensorSpec
from uwsim.simulation import Simulation
from uwsim.topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from uwsim.topics.pat_to_ros_odom import PATToROSOdomSpec
from uwsim.topics.sensor_topic import SensorToROSSpec

DOWN = (np.pi, 0.0, 0.0)
SENSORS = (
    ImuSpec(name="imu", relative_to="base_link", std=0.01),
    PressureSensorSpec(name="pressure", relative_to="base_link", std=0.01),
    GpsSensorSpec(name="gps", relative_to="base_link", std=0.1, max_depth=100.0),
    RangeSensorSpec(
        name="range", relative_to="base_link", range=50.0, look_at="down", beam_width=5.0, std=0.01
    ),
    DvlSensorSpec(
        name="dvl", relative_to="base_link", orientation=DOWN, std=0.001, beam_std=0.002,
        range_std=0.01, dropout=0.1, scale_std=0.01,
    ),
    ForceSensorSpec(name="contacts", target="base_link"),
    ForceSensorSpec(name="wrist", target="end_effector", measures="joint"),
)  # fmt: skip
TOPICS = (
    TWIST,
    *(SensorToROSSpec(name=each.name, topic=f"/{each.name}", rate=40) for each in SENSORS),
    PATToROSOdomSpec(topic="/odometry", vehicle_name="girona500", rate=30),
    ArmToROSJointStateSpec(topic="/joints", vehicle_name="girona500", rate=30),
)
UNREAD = ("imu", "pressure", "gps", "range", "dvl", "odometry", "joints", "contacts", "wrist")


def with_sensors(vehicle: VehicleSpec) -> VehicleSpec:
    return replace(vehicle, parts=(*vehicle.parts, *SENSORS))


def opened(current: object) -> Simulation:
    simulation = make(TOPICS, change=with_sensors)
    if current is not None:
        context = SceneContext(stream=simulation.world.stream)
        simulation.world.water.set(current.bind(context))  # type: ignore[attr-defined]
    return simulation


@pytest.mark.parametrize(
    "current",
    [
        None,
        ConstantSpec(velocity=(0.2, 0.1, 0.0)),
        PowerProfileSpec(velocity=(0.4, 0.1, 0.0), depth=20.0),
        GaussMarkovSpec(deviation=(0.1, 0.1, 0.0), mu=0.5),
    ],
)
def test_many_steps_at_once_take_the_samples_of_single_steps(current: object) -> None:
    first, second = opened(current), opened(current)
    taken: list[int] = []
    step = first.world.engine.step
    first.world.engine.step = lambda n, *rest, **more: (taken.append(n), step(n, *rest, **more))[1]  # type: ignore[method-assign, assignment, func-returns-value]
    first.advance(0.0)
    first.advance(0.5)
    second.advance(0.0)
    for _ in range(round(0.5 / second.timestep)):
        second.advance()
    assert max(taken) > round(0.1 / first.timestep), "no sample ended the steps"
    for topic in UNREAD:
        message = first.bus.unread_message(topic)
        assert message is not None
        assert repr(message) == repr(second.bus.unread_message(topic)), topic
    first.close()
    second.close()


def test_the_newest_message_is_known_although_others_read_and_one_is_kept() -> None:
    """Of what compiled steps sample: the message is that of the newest sample."""
    simulation = opened(None)
    for topic in ("imu", "joints"):
        simulation.bus.subscribe(topic, object, lambda _: None)
    simulation.advance(0.5)
    assert simulation.latest_message("imu").header.stamp.nanosec == 500_000_000
    received: list[object] = []
    simulation.bus.subscribe("imu", object, received.append)
    simulation.advance(0.5)
    box = simulation.state.access.newest_messages.value()["imu"][0]
    assert box is received[-1]
    assert simulation._access._inboxes["imu"].take() == [received[-1]], "one message is kept"
    simulation.close()
