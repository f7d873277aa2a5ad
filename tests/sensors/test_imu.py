"""The imu: attitude, angular velocity and specific force, on vehicles that move or stand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.simulation.girona500 import TWIST, command, make, run
from uwsim.base.geometry import (
    Pose,
    rotation_from_quaternion,
    rpy_from_rotation,
)
from uwsim.messages import Imu, Vector3
from uwsim.sensors.drift import DriftSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.sensors.range_sensor import RangeSensorSpec
from uwsim.simulation import Simulation
from uwsim.topics import InterfaceSpec
from uwsim.topics.sensor_topic import ImuToROSImuSpec

OFF_AXIS = ImuSpec(
    name="imu", relative_to="base_link", position=(0.4, -0.3, 0.7), orientation=(0.3, -0.2, 1.1)
)


def simulation_with(*parts: object, rate: int = 500) -> Simulation:
    """A vehicle with dynamics with these sensors; each IMU has its own topic."""
    topics: list[InterfaceSpec] = [
        ImuToROSImuSpec(name=part.name, topic=part.name, rate=rate)
        for part in parts
        if isinstance(part, ImuSpec)
    ]
    return make((TWIST, *topics), change=lambda vehicle: replace(vehicle, parts=parts))


def numbers(vector: Vector3) -> np.ndarray:
    return np.array([vector.x, vector.y, vector.z])


def world_from_imu(simulation: Simulation, spec: ImuSpec = OFF_AXIS) -> Pose:
    base = simulation.world.bodies.find("girona500/base_link").world_from_body
    return base @ Pose.from_rpy(spec.position, spec.orientation)


def test_on_a_vehicle_that_stands_it_measures_gravity_upwards() -> None:
    """The z axis of the bundled vehicle points down; the imu is turned."""
    topic = ImuToROSImuSpec(name="imu", topic="imu", rate=100)
    simulation = make((topic,), change=lambda one: replace(one, parts=(OFF_AXIS,), dynamics=None))
    simulation.latest_message("imu")
    run(simulation, 0.02)
    message = simulation.latest_message("imu")
    force = world_from_imu(simulation).rotation @ numbers(message.linear_acceleration)
    assert force == pytest.approx([0.0, 0.0, 9.81], abs=1e-12)
    assert isinstance(message, Imu)
    assert message.header.frame_id == "imu"


def test_rates_and_forces_are_the_derivatives_of_the_motion() -> None:
    """Central differences over steps of a turning, accelerating vehicle, lever arm included."""
    simulation = simulation_with(OFF_AXIS)
    command(simulation, 0.5, -0.3)
    simulation.latest_message("imu")
    run(simulation, 0.6)
    poses, messages = [], []
    for _ in range(12):
        simulation.advance()
        poses.append(world_from_imu(simulation))
        messages.append(simulation.latest_message("imu"))
    dt, k = simulation.timestep, 6
    places = np.array([pose.position for pose in poses])
    acceleration = (places[k + 1] - 2.0 * places[k] + places[k - 1]) / dt**2
    turned = poses[k + 1].rotation @ poses[k - 1].rotation.T
    rate = Rotation.from_matrix(turned).as_rotvec() / (2.0 * dt)
    axes = poses[k].rotation
    # the force of a message is that of the middle of its step; the difference is of its end
    force = 0.5 * (
        numbers(messages[k].linear_acceleration) + numbers(messages[k + 1].linear_acceleration)
    )
    assert np.abs(rate).max() > 0.01
    assert np.abs(acceleration).max() > 0.1
    assert axes @ numbers(messages[k].angular_velocity) == pytest.approx(rate, abs=2e-4)
    assert axes @ force - [0.0, 0.0, 9.81] == pytest.approx(acceleration, abs=0.02)


def test_noise_of_the_attitude_has_its_standard_deviation() -> None:
    """1500 angles: within 7 %, 3.8 standard errors (99.98 %)."""
    simulation = simulation_with(replace(OFF_AXIS, std=0.01))
    simulation.latest_message("imu")
    errors = []
    offset = simulation.world.model.scene.world_from_localized.rotation
    for _ in range(500):
        simulation.advance()
        q = simulation.latest_message("imu").orientation
        measured = rotation_from_quaternion(np.array([q.w, q.x, q.y, q.z]))
        true = offset.T @ world_from_imu(simulation).rotation
        errors.append(rpy_from_rotation(measured @ true.T))
    assert np.std(errors) == pytest.approx(0.01, rel=0.07)
    message = simulation.latest_message("imu")
    assert message.orientation_covariance == pytest.approx((1e-4 * np.eye(3)).ravel())


def test_covariances_are_those_of_the_noise() -> None:
    spec = replace(
        OFF_AXIS,
        gyro=DriftSpec(noise_density=1e-3),
        accelerometer=DriftSpec(noise_density=2e-3, turn_on_bias=0.1),
    )
    simulation = simulation_with(spec, rate=100)
    simulation.latest_message("imu")
    run(simulation, 0.1)
    message = simulation.latest_message("imu")
    assert message.angular_velocity_covariance[0] == pytest.approx(1e-6 * 100)
    assert message.linear_acceleration_covariance[4] == pytest.approx(4e-6 * 100 + 0.01)
    assert message.linear_acceleration_covariance[1] == 0.0


def test_a_sensor_more_changes_no_numbers_and_no_motion() -> None:
    noisy = replace(OFF_AXIS, std=0.01, gyro=DriftSpec(noise_density=1e-3, random_walk=1e-3))
    other = replace(noisy, name="another")
    ray = RangeSensorSpec(name="ray", relative_to="base_link", range=5.0, std=0.1)
    found = []
    for parts in ((noisy,), (ray, other, noisy), (noisy,)):
        simulation = simulation_with(*parts, rate=50)
        command(simulation, 0.4, 0.2)
        simulation.latest_message("imu")
        run(simulation, 0.3)
        motion = np.zeros(simulation.world.engine.motion.size)
        simulation.world.engine.motion.read(motion)
        found.append((repr(simulation.latest_message("imu")), motion.tobytes()))
    assert found[0] == found[1] == found[2]


def test_to_measure_leaves_the_velocities_of_contacts_as_they_are() -> None:
    simulation = simulation_with(OFF_AXIS, rate=1)
    command(simulation, 0.5, -0.3)
    run(simulation, 0.1)
    data = simulation.world.engine._data
    before = data.cvel.copy(), data.subtree_com.copy()
    simulation.world.sensors.sensor("imu", ("imu",)).sample(simulation.time)
    assert np.array_equal(data.cvel, before[0])
    assert np.array_equal(data.subtree_com, before[1])


def test_a_saved_simulation_goes_on_with_the_same_measurements() -> None:
    spec = replace(OFF_AXIS, std=0.01, gyro=DriftSpec(noise_density=1e-3, bias_instability=1e-3))
    simulation = simulation_with(spec)
    simulation.latest_message("imu")
    run(simulation, 0.02)
    saved = simulation.save()
    run(simulation, 0.02)
    first = repr(simulation.latest_message("imu"))
    simulation.restore(saved)
    run(simulation, 0.02)
    assert repr(simulation.latest_message("imu")) == first
