"""Rules about vehicles that ArduPilot steers, of ``uwsim check SCENE --ardupilot``.

A vehicle is checked if it has a ``<u:ardupilot>``; if no vehicle has one, the first vehicle with
thrusters is, with a default element, which is what a run with ``--ardupilot`` does.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...autopilots.ardupilot.frames import FRAMES, Frame
from ...base.geometry import Array
from ...base.numerics.linear import dot
from ...devices.ardupilot import ArduPilotSpec
from ...devices.mavlink import MavlinkSpec
from ...errors import Diagnostic
from ...model.balance import Balance, balance_of
from ...physics.actuation.allocation import HEAVE, thrust_curve, thrusters_on_base, wrench
from ...scene.hydrodynamics.spec import ThrusterSpec
from ...scene.vehicle import VehicleSpec
from ...world import GRAVITY, TIMESTEP
from ..subjects import CheckedScene
from .motors import Motor, find_differences

MIN_UPRIGHT = 0.9
"""The least cosine of the angle of the base's z axis to the vertical at the start [1]."""
MAX_HEAVE_SHARE = 0.25
"""The greatest share of the vertical thrust that may only hold the depth [1]."""
MIN_VERTICAL_SHARE = 0.05
"""The vertical component of a thruster's direction below which it is a horizontal thruster [1]."""
MAX_RATE_ERROR = 0.005
"""The greatest difference of the rate of exchanges from the requested rate, as a fraction [1]."""
MAX_START_DEPTH = 0.5
"""The greatest depth of a start that is not reported [m]."""
MAX_HOME_DEPTH = 0.05
"""The greatest distance of home from the surface that is not reported [m]."""


@dataclass(frozen=True, eq=False)
class SteeredVehicle:
    """A vehicle that ArduPilot steers."""

    spec: VehicleSpec
    """The spec of the vehicle."""
    autopilot: ArduPilotSpec
    """The element, or the default one."""
    source: object
    """The spec whose line is stated."""
    thrusters: tuple[ThrusterSpec, ...]
    """The thrusters in the frame of the base."""
    balance: Balance
    """The mass and the displaced mass."""
    up: Array
    """The unit vector in the base frame that points up at the start, (3,)."""

    @property
    def is_z_down(self) -> bool:
        """True if the z axis of the base points down for ArduPilot."""
        axes = self.autopilot.axes
        return bool(self.up[2] < 0.0) if axes == "start" else axes == "frd"

    @property
    def frd_from_base(self) -> Array:
        """The signs of the base's axes in forward, starboard, down, (3,)."""
        return np.array([1.0, 1.0, 1.0] if self.is_z_down else [1.0, -1.0, -1.0])

    def motors(self) -> dict[int, Motor]:
        """Return the thrusters behind the outputs, by index of the motor: channel n is motor n.

        A frame's first motors are at the first channels, which ``SERVO1_FUNCTION`` 33 to
        ``SERVO8_FUNCTION`` 40 do.
        """
        names = {thruster.name: thruster for thruster in self.thrusters}
        outputs = [
            (channel.number, names[channel.thruster], channel.reversed)
            for channel in self.autopilot.channels
            if channel.thruster in names
        ]
        if not self.autopilot.channels:
            outputs = [(k, thruster, False) for k, thruster in enumerate(self.thrusters, start=1)]
        return {
            number - 1: self._motor(number, thruster, is_reversed)
            for number, thruster, is_reversed in outputs
        }

    def _motor(self, channel: int, thruster: ThrusterSpec, is_reversed: bool) -> Motor:
        direction = wrench(thruster, np.zeros(3))[:3] * (-1.0 if is_reversed else 1.0)
        position = np.array(thruster.position) - self.balance.centre_of_mass
        signs = self.frd_from_base
        return Motor(channel, thruster.name, position * signs, direction * signs)


def steered_vehicles(scene: CheckedScene) -> list[SteeredVehicle]:
    """Return the vehicles with dynamics that ArduPilot steers."""
    elements = [
        (index, vehicle, element)
        for index, vehicle in enumerate(scene.spec.vehicles)
        for element in vehicle.parts_of(ArduPilotSpec)
    ]
    if not elements:
        elements = [
            (index, vehicle, ArduPilotSpec())
            for index, vehicle in enumerate(scene.spec.vehicles)
            if index in scene.dynamics and scene.dynamics[index].thrusters
        ][:1]
    vehicles = []
    for index, vehicle, element in elements:
        if index not in scene.dynamics or index not in scene.robots:
            continue
        dynamics, robot = scene.dynamics[index], scene.robots[index]
        pose = scene.spec.world_from_localized @ vehicle.localized_from_base
        vehicles.append(
            SteeredVehicle(
                vehicle,
                element,
                element if element.source_line is not None else vehicle,
                thrusters_on_base(robot, dynamics.thrusters, vehicle.joint_values),
                balance_of(robot, dynamics, vehicle.joint_values),
                pose.rotation[2],
            )
        )
    return vehicles


def presence(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report a scene without a vehicle that ArduPilot can steer."""
    if not steered_vehicles(scene):
        message = "no vehicle has thrusters and <u:dynamics>; ArduPilot has nothing to steer"
        yield scene.error(None, message)


def thruster_layout(scene: CheckedScene, frame: Frame | None) -> Iterator[Diagnostic]:
    """Report thrusters that are mirrored, exchanged or reversed against the frame's motors.

    Args:
        scene: the scene.
        frame: the frame; None for the frame with as many motors that fits best.
    """
    for vehicle in steered_vehicles(scene):
        motors = vehicle.motors()
        chosen_frame = frame or _fitting_frame(motors)
        if chosen_frame is None:
            counts = ", ".join(f"{entry.name} {len(entry.motors)}" for entry in FRAMES)
            message = (
                f"the vehicle {vehicle.spec.name!r}: no frame of ArduPilot has {len(motors)} "
                f"motors ({counts}). Write a matrix for FRAME_CONFIG 7, or change the <channel>s"
            )
            yield scene.error(vehicle.source, message)
            continue
        for finding in find_differences(motors, chosen_frame):
            yield scene.error(vehicle.source, f"the vehicle {vehicle.spec.name!r}: {finding.text}")


def _fitting_frame(motors: dict[int, Motor]) -> Frame | None:
    """Return the frame with as many motors that has the fewest differences; None if none has."""
    frames = [frame for frame in FRAMES if len(frame.motors) == len(motors)]

    def count(frame: Frame) -> int:
        return sum(len(finding.channels) or 1 for finding in find_differences(motors, frame))

    return min(frames, key=count, default=None)


def body_axes(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report a base whose z axis is not the one that ArduPilot is sent."""
    for vehicle in steered_vehicles(scene):
        cosine = float(vehicle.up[2])
        name, axes = vehicle.spec.name, vehicle.autopilot.axes
        if abs(cosine) < MIN_UPRIGHT:
            angle = math.degrees(math.acos(min(1.0, abs(cosine))))
            message = (
                f"the vehicle {name!r}: the z axis of its base is {angle:.0f} degrees from the "
                "vertical at the start; expected up or down, with x forward. Set <axes> frd or flu"
            )
            yield scene.warning(vehicle.source, message, "axes")
            continue
        specific_force = GRAVITY * cosine * (1.0 if vehicle.is_z_down else -1.0)
        if specific_force > 0.0:
            right_axes = "flu" if cosine > 0.0 else "frd"
            message = (
                f"the vehicle {name!r}: accel_body at rest is (0, 0, {specific_force:+.2f}) m/s2; "
                f"expected (0, 0, {-GRAVITY:.2f}). The z axis of the base points "
                f"{'up' if cosine > 0.0 else 'down'}: set <axes> {right_axes}, not {axes}"
            )
            yield scene.error(vehicle.source, message, "axes")


def exchange_rate(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of a rate that the step of a run does not divide.

    A run takes the step nearest to the default one that divides the time between two exchanges of
    the vehicle with the highest rate.
    """
    vehicles = steered_vehicles(scene)
    highest_rate = max((vehicle.autopilot.rate for vehicle in vehicles), default=1.0)
    step = 1.0 / (highest_rate * max(1, round(1.0 / (highest_rate * TIMESTEP))))
    for vehicle in vehicles:
        autopilot = vehicle.autopilot
        rate = 1.0 / (autopilot.count_steps(step) * step)
        if abs(rate - autopilot.rate) > MAX_RATE_ERROR * autopilot.rate:
            message = (
                f"the vehicle {vehicle.spec.name!r}: steps of {1e3 * step:g} ms, for the highest "
                f"<rate>, give {rate:g} exchanges per second, not {autopilot.rate:g}; expected "
                f"{highest_rate:g} divided by a whole number"
            )
            yield scene.warning(vehicle.source, message, "rate")


def buoyancy(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of a vehicle that needs much of its vertical thrust to hold its depth."""
    for vehicle in steered_vehicles(scene):
        excess = GRAVITY * (vehicle.balance.displaced_mass - vehicle.balance.mass)  # [N]
        vertical_thrust = sum(
            _vertical_thrust(thruster, vehicle.up) for thruster in vehicle.thrusters
        )
        if vertical_thrust > 0.0 and abs(excess) > MAX_HEAVE_SHARE * vertical_thrust:
            way = "floats up" if excess > 0.0 else "sinks"
            message = (
                f"the vehicle {vehicle.spec.name!r} {way} with {abs(excess):.3g} N, which takes "
                f"{100 * abs(excess) / vertical_thrust:.0f} % of its vertical thrust; ArduSub "
                "expects neutral buoyancy, a little positive"
            )
            yield scene.warning(vehicle.source, message)


def _vertical_thrust(thruster: ThrusterSpec, up: Array) -> float:
    """Return the thrust along the vertical in the weaker direction [N]."""
    thrusts, _ = thrust_curve(thruster)
    share = abs(dot(wrench(thruster, np.zeros(3))[:3], up))
    if share < MIN_VERTICAL_SHARE:
        return 0.0
    return share * float(min(-thrusts[0], thrusts[-1]))


def navigation(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of missing sensors, and of a home from which depth is not counted from the surface."""
    topics = {
        str(topic).strip("/")
        for interface in scene.spec.ros_interfaces
        for topic in (getattr(interface, "topic", None),)
        if topic
    }
    surface = scene.spec.ocean_state.ocean_surface_height
    for vehicle in steered_vehicles(scene):
        name, links = vehicle.spec.name, vehicle.spec.parts_of(MavlinkSpec)
        yield from _missing_topics(scene, vehicle, topics)
        if _is_submarine(vehicle) and not any(link.dvl or link.odometry for link in links):
            message = (
                f"the vehicle {name!r} has no <u:mavlink> with <dvl> or <odometry>. POSHOLD and "
                "GUIDED then use the GPS that ArduPilot's simulation makes of the true position, "
                "which a vehicle under water does not have"
            )
            yield scene.warning(vehicle.source, message)
        home = scene.spec.world_from_localized.transform(np.array(vehicle.autopilot.home))
        if abs(float(home[2]) - surface) > MAX_HOME_DEPTH:
            message = (
                f"the vehicle {name!r}: home is {abs(float(home[2]) - surface):.2f} m "
                f"{'above' if home[2] > surface else 'below'} the surface; ArduSub counts its "
                "depth from there. Set <home> to a point at the surface"
            )
            yield scene.warning(vehicle.source, message, "home")


def start_depth(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of a submarine that starts under water, where ArduSub sets its depth to 0."""
    surface = scene.spec.ocean_state.ocean_surface_height
    for vehicle in steered_vehicles(scene):
        start = scene.spec.world_from_localized @ vehicle.spec.localized_from_base
        depth = surface - float(start.position[2])
        if _is_submarine(vehicle) and depth > MAX_START_DEPTH:
            message = (
                f"the vehicle {vehicle.spec.name!r} starts {depth:.2f} m deep. ArduSub sets its "
                "depth to 0 where it is started, and again whenever it is higher. Start it at the "
                "surface, or send it only below its start"
            )
            yield scene.warning(vehicle.source, message)


def _is_submarine(vehicle: SteeredVehicle) -> bool:
    """Return whether a vehicle has thrusters that push up or down."""
    wrenches = (wrench(thruster, np.zeros(3)) for thruster in vehicle.thrusters)
    return any(abs(column[HEAVE]) > 0.5 for column in wrenches)


def _missing_topics(
    scene: CheckedScene, vehicle: SteeredVehicle, topics: set[str]
) -> Iterator[Diagnostic]:
    """Warn of topics of sensors that nothing publishes."""
    named_topics = [(vehicle.source, "rangefinder", t) for t in vehicle.autopilot.rangefinders]
    if vehicle.autopilot.battery:
        named_topics.append((vehicle.source, "battery", vehicle.autopilot.battery))
    for link in vehicle.spec.parts_of(MavlinkSpec):
        named_topics += [
            (link, element, topic)
            for element, topic in (
                ("dvl", link.dvl),
                ("odometry", link.odometry),
                ("range", link.range),
            )
            if topic
        ]
    for source, element, topic in named_topics:
        if topic.strip("/") not in topics:
            hint = scene.diagnostics.suggest(topic.strip("/"), sorted(topics))
            message = f"<{element}>: nothing in <rosInterfaces> publishes {topic!r}.{hint}"
            yield scene.warning(source, message, element)
