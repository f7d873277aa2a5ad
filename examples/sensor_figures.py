"""Draw what sensors measure on a survey, as in docs/sensors.md.

    python examples/sensor_figures.py docs/images/sensors.png       40 s

A Girona 500 with an arm swims over the rough bottom of the scene `survey-scene`: it rests,
moves ahead, turns, and stops; then its elbow turns. Grey lines are the truth.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

import uwsim
from uwsim.analysis.plots import PALETTE, save_plot, styled_figure
from uwsim.assets.bundled import bundled_files
from uwsim.devices.battery import BatterySpec
from uwsim.devices.force_sensor import ForceSensorSpec
from uwsim.devices.motor_currents import MotorCurrentsSpec
from uwsim.messages import JointState, Twist, TwistStamped, Vector3, header, seconds
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.sensors.drift import DriftSpec
from uwsim.sensors.dvl_sensor import DvlSensorSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.sensor_topic import BatteryToROSSpec, ForceSensorROSSpec, MotorCurrentsToROSSpec

NAME = "g500"
PHASES = ((5.0, 0.0, 0.0), (20.0, 0.4, 0.0), (12.0, 0.2, 0.2), (5.0, 0.0, 0.0))
"""The phases of the survey: duration [s], surge [m/s], yaw rate [rad/s]."""
ARM = (10.0, 0.15)
"""The last phase: duration [s] and rate [rad/s] of the elbow."""
STEP = 0.1
GYRO = DriftSpec(noise_density=2e-3)
ACCELEROMETER = DriftSpec(noise_density=2e-3)
TRUTH = {"color": "0.6", "lw": 2.0}
TOPICS = ("imu", "pressure", "dvl", "multibeam", "wrist", "battery", "currents")


@dataclass(frozen=True)
class Survey:
    """The messages of the sensors and the true motion."""

    messages: dict[str, list]
    """The messages of each topic, in order of time."""
    time: np.ndarray
    """The times of the true motion, (n,) [s]."""
    depth: np.ndarray
    """The depth of the base, (n,) [m]."""
    twist: np.ndarray
    """The twist of the base in its axes, (n, 6) [m/s, rad/s]."""

    def series(self, topic: str, field: Callable) -> tuple[np.ndarray, np.ndarray]:
        """Return the times of the messages of a topic, and a field of each message."""
        messages = self.messages[topic]
        times = np.array([seconds(message.header.stamp) for message in messages])
        return times, np.array([field(message) for message in messages])


def make_scene() -> SceneSpec:
    """Return the survey scene with a battery, motor currents and a wrist sensor."""
    scene = read_scene(bundled_files("scenes")["survey-scene"])
    vehicle = scene.vehicles[0]
    devices = (
        BatterySpec(name="battery", capacity=1000.0, voltage=48.0, resistance=0.2, hotel_load=60.0),
        MotorCurrentsSpec(name="currents", voltage=48.0, std=0.02),
        ForceSensorSpec(name="wrist", target="part4_base", measures="joint"),
    )
    parts = tuple(add_noise(part) for part in vehicle.parts)
    topics = (
        BatteryToROSSpec(name="battery", topic=f"/{NAME}/battery", rate=10),
        MotorCurrentsToROSSpec(name="currents", topic=f"/{NAME}/currents", rate=20),
        ForceSensorROSSpec(name="wrist", topic=f"/{NAME}/wrist", rate=20),
        ROSJointStateToArmSpec(topic=f"/{NAME}/arm", vehicle_name=NAME),
    )
    vehicle = replace(vehicle, parts=(*parts, *devices))
    return replace(scene, vehicles=(vehicle,), ros_interfaces=(*scene.ros_interfaces, *topics))


def add_noise(part: object) -> object:
    """Add beam dropouts to a DVL, and the noise of a low-cost IMU to an IMU."""
    if isinstance(part, DvlSensorSpec):
        return replace(part, beam_std=0.01, dropout=0.05, range_std=0.05)
    if isinstance(part, ImuSpec):
        return replace(part, gyro=GYRO, accelerometer=ACCELEROMETER)
    return part


def run_survey() -> Survey:
    """Run the survey, and record all topics."""
    times, depths, twists = [], [], []
    with uwsim.load(make_scene(), seed=1, is_blind=True) as simulation:
        simulation.advance(0.0)
        inboxes = {topic: simulation.bus.inbox(f"/{NAME}/{topic}", object) for topic in TOPICS}
        phases = [(*phase, 0.0) for phase in PHASES] + [(ARM[0], 0.0, 0.0, ARM[1])]
        for duration, surge, yaw, elbow in phases:
            for _ in range(round(duration / STEP)):
                twist = Twist(linear=Vector3(x=surge), angular=Vector3(z=yaw))
                stamp = header(simulation.time)
                simulation.publish(f"/{NAME}/twist", TwistStamped(header=stamp, twist=twist))
                arm = JointState(header=stamp, name=["Elbow"], velocity=np.array([-elbow]))
                simulation.publish(f"/{NAME}/arm", arm)
                times.append(simulation.time)
                depths.append(simulation.pose(NAME).position[2])
                twists.append(simulation.velocity(NAME))
                simulation.advance(STEP)
        messages = {name: list(inbox.take()) for name, inbox in inboxes.items()}
    return Survey(messages, np.array(times), np.array(depths), np.array(twists))


def draw_depth(axes: Axes, survey: Survey) -> None:
    times, depths = survey.series("pressure", lambda message: message.pressure)
    axes.plot(survey.time, survey.depth, **TRUTH)
    axes.plot(times, depths, ".", ms=1.5, color=PALETTE[0])
    axes.set_ylabel("pressureSensor: depth [m]")


def draw_speed(axes: Axes, survey: Survey) -> None:
    for k, (label, value) in enumerate(
        (
            ("ahead", lambda message: message.bs_longitudinal),
            ("across", lambda message: message.bs_transverse),
        )
    ):
        axes.plot(survey.time, survey.twist[:, k], **TRUTH)
        axes.plot(*survey.series("dvl", value), ".", ms=2.0, color=PALETTE[k], label=label)
    axes.set_ylabel("dvlSensor: velocity [m/s]")
    axes.legend()


def draw_altitude(axes: Axes, survey: Survey) -> None:
    axes.plot(
        *survey.series("dvl", lambda message: message.bd_range), color=PALETTE[0], label="DVL"
    )
    middle = survey.series("multibeam", lambda message: message.ranges[len(message.ranges) // 2])
    axes.plot(*middle, color=PALETTE[1], lw=0.8, label="middle beam of the multibeam")
    axes.set_ylabel("range to the bottom [m]")
    axes.set_ylim(top=5.3)
    axes.legend(loc="upper right")


def draw_gyro(axes: Axes, survey: Survey) -> None:
    axes.plot(*survey.series("imu", lambda message: message.angular_velocity.z), ".", ms=0.8)
    axes.plot(survey.time, survey.twist[:, 5], **TRUTH)
    axes.set_ylabel("imu: rate about z [rad/s]")


def draw_accelerometer(axes: Axes, survey: Survey) -> None:
    for k, axis in enumerate("xy"):
        series = survey.series(
            "imu", lambda message, axis=axis: getattr(message.linear_acceleration, axis)
        )
        axes.plot(*series, ".", ms=0.8, color=PALETTE[k], label=axis)
    axes.set_ylabel("imu: specific force [m/s$^2$]")
    axes.legend(markerscale=6)


def draw_profile(axes: Axes, survey: Survey) -> None:
    scans = survey.messages["multibeam"]
    for colour, scan in zip(PALETTE, scans[:: len(scans) // 3], strict=False):
        angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
        ranges = np.asarray(scan.ranges)
        label = f"{seconds(scan.header.stamp):.0f} s"
        axes.plot(ranges * np.sin(angles), -ranges * np.cos(angles), color=colour, label=label)
    axes.set_xlabel("to the side [m]")
    axes.set_ylabel("multibeamSensor: below it [m]")
    axes.legend()


def draw_wrist(axes: Axes, survey: Survey) -> None:
    for k, axis in enumerate("xyz"):
        series = survey.series(
            "wrist", lambda message, axis=axis: getattr(message.wrench.force, axis)
        )
        axes.plot(*series, color=PALETTE[k], label=axis)
    axes.set_ylabel("ForceSensor, joint: force [N]")
    axes.legend()


def draw_currents(axes: Axes, survey: Survey) -> None:
    names = survey.messages["currents"][0].name
    for k, name in enumerate(("surge_port", "surge_starboard", "heave_bow", "Elbow")):
        if name in names:
            joint_index = names.index(name)
            series = survey.series(
                "currents", lambda message, joint_index=joint_index: message.effort[joint_index]
            )
            axes.plot(*series, color=PALETTE[k], lw=0.8, label=name)
    axes.set_ylabel("u:motorCurrents [A]")
    axes.set_ylim(top=3.2)
    axes.legend(ncols=2, fontsize=7)


def draw_battery(axes: Axes, survey: Survey) -> None:
    axes.plot(*survey.series("battery", lambda message: message.voltage), color=PALETTE[0])
    axes.set_ylabel("u:battery: voltage [V]", color=PALETTE[0])
    charge = axes.twinx()
    charge.grid(visible=False)
    charge.plot(*survey.series("battery", lambda message: message.charge), color=PALETTE[1])
    charge.set_ylabel("charge [A h]", color=PALETTE[1])


PANELS = (
    *(draw_depth, draw_speed, draw_altitude),
    *(draw_gyro, draw_accelerometer, draw_profile),
    *(draw_wrist, draw_currents, draw_battery),
)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw what sensors measure on a survey.")
    parser.add_argument("file", type=Path)
    options = parser.parse_args()
    result = run_survey()
    with styled_figure((9.0, 7.0)) as figure:
        for axes, draw in zip(figure.subplots(3, 3).flat, PANELS, strict=True):
            draw(axes, result)
            if not axes.get_xlabel():
                axes.set_xlabel("time [s]")
        save_plot(figure, options.file)


if __name__ == "__main__":
    main()
