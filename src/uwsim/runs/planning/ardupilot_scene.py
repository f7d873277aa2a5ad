"""The scene of a run with ArduPilot: its elements ``<u:ardupilot>``, and its steps."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from dataclasses import replace

from ...devices.ardupilot import ArduPilotLink, ArduPilotSpec
from ...devices.mavlink import MavlinkSpec
from ...devices.px4 import Px4, Px4Spec
from ...scene.spec import SceneSpec
from ...simulation import Simulation
from ...world import TIMESTEP
from .autopilot_scene import add_autopilot, check_ports, remove_parts

ADDRESS = "127.0.0.1"
"""The address of this computer at which ArduPilot is expected by default."""


def connect_ardupilot(scene: SceneSpec, *, ends_on_restart: bool = False) -> SceneSpec:
    """Return a scene with at least one ``<u:ardupilot>``, and without ``<u:px4>``.

    A scene without one has it in the first vehicle with dynamics.

    Args:
        scene: the scene.
        ends_on_restart: True if a new start of ArduPilot ends the run, as in a benchmark.

    Raises:
        BadSetting: no vehicle has dynamics, or two elements open one port.
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
    check_ports(connected_scene, option="--ardupilot", advice="an <instance> each")
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
        if vehicle.parts_of(ArduPilotSpec) and not vehicle.parts_of(MavlinkSpec):
            link = MavlinkSpec(name=f"{vehicle.name}/autopilot")
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


def link_notes(simulation: Simulation) -> list[str]:
    """Return a note for each autopilot with lost, repeated or invalid packets."""
    return [
        part.describe()
        for part in simulation.world.devices
        if (isinstance(part, ArduPilotLink) and part.state.exchange.has_events)
        or (isinstance(part, Px4) and part.state.lock_step.has_events)
    ]
