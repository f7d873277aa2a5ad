"""Autopilots in a scene: they are added to a vehicle, left out, and have ports of their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ...checks.scene.shared_ports import find_shared_ports
from ...devices.ardupilot import ArduPilotSpec
from ...devices.device import DeviceSpec
from ...devices.px4 import Px4Spec
from ...errors import BadSetting
from ...scene.spec import SceneSpec
from ...scene.vehicle import VehicleSpec


def add_autopilot(
    vehicles: Sequence[VehicleSpec], autopilot: DeviceSpec, *, option: str
) -> list[VehicleSpec]:
    """Return the vehicles; if none has such an autopilot, the first one with dynamics gets it.

    Raises:
        BadSetting: no vehicle has dynamics.
    """
    connected_vehicles = list(vehicles)
    if any(vehicle.parts_of(type(autopilot)) for vehicle in vehicles):
        return connected_vehicles
    for i, vehicle in enumerate(vehicles):
        if vehicle.dynamics is not None:
            connected_vehicles[i] = replace(vehicle, parts=(*vehicle.parts, autopilot))
            return connected_vehicles
    raise BadSetting(f"{option}: no vehicle of the scene has <u:dynamics>, which thrusters need.")


def disconnect_autopilots(scene: SceneSpec) -> SceneSpec:
    """Return a scene without ``<u:ardupilot>`` and ``<u:px4>``, which would wait for a program."""
    vehicles = tuple(
        remove_parts(remove_parts(vehicle, ArduPilotSpec), Px4Spec) for vehicle in scene.vehicles
    )
    return replace(scene, vehicles=vehicles)


def remove_parts(vehicle: VehicleSpec, kind: type) -> VehicleSpec:
    """Return a vehicle without the parts of a kind."""
    parts = tuple(part for part in vehicle.parts if not isinstance(part, kind))
    return replace(vehicle, parts=parts)


def check_ports(scene: SceneSpec, *, option: str, advice: str) -> None:
    """Raise BadSetting if two elements of a scene open one port, with the advice of the option."""
    errors = [
        f"{option}: {port.owner}: {port.place} is that of {other.owner}, too; expected {advice}."
        for port, other in find_shared_ports(scene)
    ]
    if errors:
        raise BadSetting("\n".join(errors))
