"""The scene of a run with ArduPilot: its elements ``<u:ardupilot>``, and its steps."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from dataclasses import replace

from ...devices.ardupilot import ArduPilotSpec
from ...devices.mavlink import MavlinkSpec
from ...devices.px4 import Px4Spec
from ...errors import BadSetting
from ...scene.spec import SceneSpec
from ...world import TIMESTEP
from .px4_scene import add_autopilot, remove_parts

MAVLINK_PORT, PORTS_PER_INSTANCE = 5762, 10
"""The TCP port of ArduPilot's second serial port, and the distance to that of the next instance."""
ADDRESS = "127.0.0.1"
"""The address of this computer at which ArduPilot is expected by default."""


def connect_ardupilot(scene: SceneSpec, *, ends_on_restart: bool = False) -> SceneSpec:
    """Return a scene with at least one ``<u:ardupilot>``, and without ``<u:px4>``.

    A scene without one has it in the first vehicle with dynamics.

    Args:
        scene: the scene.
        ends_on_restart: True if a new start of ArduPilot ends the run, as in a benchmark.

    Raises:
        BadSetting: no vehicle has dynamics, or two vehicles have one port.
    """
    vehicles = [remove_parts(vehicle, Px4Spec) for vehicle in scene.vehicles]
    vehicles = add_autopilot(vehicles, ArduPilotSpec(), option="--ardupilot")
    if ends_on_restart:
        vehicles = [
            replace(
                vehicle,
                parts=tuple(
                    replace(part, on_restart="end") if isinstance(part, ArduPilotSpec) else part
                    for part in vehicle.parts
                ),
            )
            for vehicle in vehicles
        ]
    connected_scene = replace(scene, vehicles=tuple(vehicles))
    ports = [spec.udp_port for spec in ardupilot_specs(connected_scene)]
    for port in ports:
        if ports.count(port) > 1:
            raise BadSetting(
                f"--ardupilot: {ports.count(port)} elements <u:ardupilot> have the UDP port "
                f"{port}; expected an <instance> each."
            )
    return connected_scene


def connect_mavlink(scene: SceneSpec) -> SceneSpec:
    """Return a scene whose vehicles with ``<u:ardupilot>`` have a ``<u:mavlink>``, if they can.

    One that is added is at the second serial port of the vehicle's ArduPilot, and has no sensors.
    Without pymavlink, none is added.
    """
    if importlib.util.find_spec("pymavlink") is None:
        return scene
    vehicles = []
    for vehicle in scene.vehicles:
        autopilots = vehicle.parts_of(ArduPilotSpec)
        if autopilots and not vehicle.parts_of(MavlinkSpec):
            port = MAVLINK_PORT + PORTS_PER_INSTANCE * autopilots[0].instance
            link = MavlinkSpec(name=f"{vehicle.name}/autopilot", address=f"tcp:{ADDRESS}:{port}")
            vehicle = replace(vehicle, parts=(*vehicle.parts, link))
        vehicles.append(vehicle)
    return replace(scene, vehicles=tuple(vehicles))


def ardupilot_specs(scene: SceneSpec) -> Iterator[ArduPilotSpec]:
    """Yield the elements ``<u:ardupilot>`` of a scene."""
    for vehicle in scene.vehicles:
        yield from vehicle.parts_of(ArduPilotSpec)


def exchange_timestep(scene: SceneSpec) -> float:
    """Return the step nearest to the default one of which the exchanges take a whole number [s]."""
    rate = max((spec.rate for spec in ardupilot_specs(scene)), default=1.0 / TIMESTEP)
    return 1.0 / (rate * max(1, round(1.0 / (rate * TIMESTEP))))
