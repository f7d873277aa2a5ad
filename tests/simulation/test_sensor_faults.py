"""Faults of sensors: the same words for every sensor, seeded, on all its topics."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.simulation.girona500 import make
from uwsim.base import rng
from uwsim.devices.fault import FaultSpec
from uwsim.devices.fault_times import FaultTimes
from uwsim.errors import SceneError
from uwsim.messages import Imu, LaserScan, Pressure, seconds
from uwsim.sensors.pressure_sensor import PressureSensorSpec
from uwsim.sensors.sonar.multibeam_sensor import MultibeamSensorSpec
from uwsim.simulation import Simulation
from uwsim.simulation.faulty_topic import FaultyTopic, SensorFault
from uwsim.topics.sensor_topic import MultibeamSensorToLaserScanSpec, PressureSensorToROSSpec

DEPTH = PressureSensorSpec(name="depth", relative_to="base_link", std=0.01)
TOPIC = PressureSensorToROSSpec(name="depth", topic="/depth", rate=50)


def received(*faults: FaultSpec, messages: list[Any] | None = None, **fields: Any) -> list[tuple]:
    """What comes out of a faulty topic for a message each second: when, and what."""
    given = messages or [Pressure(pressure=float(k)) for k in range(10)]
    now, found = [0.0], []
    made = [
        SensorFault(fault, type(given[0]), rng.stream(1, "times"), rng.stream(1, "noise"))
        for fault in faults
    ]
    topic = FaultyTopic(made, lambda m: found.append((now[0], m)), lambda: now[0])
    for k, message in enumerate(given):
        now[0] = float(k)
        topic.publish(message)
    return found


def fault(kind: str, **fields: Any) -> FaultSpec:
    return FaultSpec(**{"sensor": "depth", "kind": kind, "start": 3.0, "end": 6.0, **fields})


def test_dropout_is_silence() -> None:
    assert [time for time, _ in received(fault("dropout"))] == [0, 1, 2, 6, 7, 8, 9]


def test_freeze_repeats_the_last_value_with_new_time_stamps() -> None:
    found = received(fault("freeze"))
    assert [m.pressure for _, m in found] == [0, 1, 2, 2, 2, 2, 6, 7, 8, 9]
    assert [seconds(m.header.stamp) for _, m in found[3:6]] == [3.0, 4.0, 5.0]


def test_bias_is_a_step() -> None:
    found = received(fault("bias", size=0.5))
    assert [m.pressure for _, m in found] == [0, 1, 2, 3.5, 4.5, 5.5, 6, 7, 8, 9]


def test_latency_delays_and_then_catches_up() -> None:
    found = received(fault("latency", delay=2.0))
    assert [(time, m.pressure) for time, m in found] == [
        (0, 0), (1, 1), (2, 2), (5, 3), (6, 4), (6, 5), (6, 6), (7, 7), (8, 8), (9, 9),
    ]  # fmt: skip


def test_outliers_come_at_a_rate_and_have_their_size() -> None:
    """2000 samples at 0.2 /s: 18.1 % hit, within 2.6 points; size within 15 % (99.7 %)."""
    zeros = [Pressure() for _ in range(2000)]
    spec = fault("outliers", size=5.0, rate=0.2, start=0.0, end=None)
    errors = np.array([m.pressure for _, m in received(spec, messages=zeros)])
    assert np.mean(errors != 0.0) == pytest.approx(1.0 - np.exp(-0.2), abs=0.026)
    assert np.std(errors[errors != 0.0]) == pytest.approx(5.0, rel=0.15)


def test_only_the_field_that_is_named_is_changed_and_the_message_itself_is_not() -> None:
    given = [Imu()]
    spec = fault("bias", size=1.0, field="angular_velocity.z", start=0.0)
    ((_, message),) = received(spec, messages=given)
    assert (message.angular_velocity.z, message.angular_velocity.x) == (1.0, 0.0)
    assert given[0].angular_velocity.z == 0.0
    scan = LaserScan(ranges=np.ones(3, dtype=np.float32))
    ((_, message),) = received(replace(spec, field="ranges"), messages=[scan])
    assert message.ranges.tolist() == [2.0, 2.0, 2.0]
    assert message.ranges.dtype == np.float32
    ((_, message),) = received(replace(spec, field="ranges"), messages=given)
    assert (
        message.angular_velocity == given[0].angular_velocity
    )  # of another type: the sensor's other topics are as they were


def test_faults_of_one_sensor_add_up() -> None:
    found = received(fault("bias", size=0.5), fault("dropout", start=4.0, end=5.0))
    assert [(time, m.pressure) for time, m in found[3:5]] == [(3, 3.5), (5, 5.5)]


def test_random_faults_take_their_share_of_the_time() -> None:
    """Rate 0.1 for 2 s each: present for 1 - exp(-0.2) of 20 000 s, within 0.01 (99.9 %)."""
    spec = FaultSpec(sensor="depth", kind="dropout", rate=0.1, duration=2.0)
    times = FaultTimes(spec, rng.stream(0, "test"))
    share = np.mean([times.is_present(0.1 * k) for k in range(200_000)])
    assert share == pytest.approx(1.0 - np.exp(-0.2), abs=0.01)


def depths(*parts: object, topics: tuple = (TOPIC,)) -> tuple[Simulation, list[float]]:
    simulation = make(topics, change=lambda vehicle: replace(vehicle, parts=parts))
    found: list[float] = []
    simulation.bus.subscribe("/depth", Pressure, lambda m: found.append(m.pressure))
    simulation.advance(0.4)
    return simulation, found


def test_a_fault_in_a_scene_changes_no_noise_and_repeats() -> None:
    spec = FaultSpec(sensor="depth", kind="dropout", rate=10.0, duration=0.05)
    _, whole = depths(DEPTH)
    _, first = depths(DEPTH, spec)
    _, again = depths(DEPTH, spec)
    assert first == again
    assert 2 < len(first) < len(whole)
    assert set(first) < set(whole)


def test_a_saved_simulation_goes_on_with_the_same_faults() -> None:
    spec = FaultSpec(sensor="depth", kind="outliers", rate=20.0, size=3.0)
    simulation, found = depths(DEPTH, spec)
    saved = simulation.save()
    simulation.advance(0.2)
    before = found[-10:]
    simulation.restore(saved)
    simulation.advance(0.2)
    assert found[-10:] == before


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (FaultSpec(), "names a <u:thruster> or a <u:sensor>"),
        (FaultSpec(sensor="dept", kind="freeze"), "No sensor is called 'dept'"),
        (FaultSpec(sensor="depth"), "<u:kind> of a sensor is 'loss'"),
        (FaultSpec(thruster="sway", kind="freeze"), "<u:kind> of a thruster is 'freeze'"),
    ],
)
def test_a_fault_that_cannot_be_is_refused(spec: FaultSpec, said: str) -> None:
    with pytest.raises(SceneError, match=said):
        depths(DEPTH, spec)


def test_the_words_are_the_same_for_a_multibeam() -> None:
    fan = MultibeamSensorSpec(
        name="fan", relative_to="base_link", init_angle=-10.0, final_angle=10.0, angle_incr=5.0,
        range=5.0,
    )  # fmt: skip
    spec = FaultSpec(sensor="fan", kind="bias", field="ranges", size=2.0)
    topic = MultibeamSensorToLaserScanSpec(name="fan", topic="/fan")
    simulation = make((topic,), change=lambda vehicle: replace(vehicle, parts=(fan, spec)))
    simulation.latest_message("/fan")
    simulation.advance(0.1)
    assert simulation.latest_message("/fan").ranges.tolist() == [7.0] * 5
