"""The scene of a run with PX4: its elements ``<u:px4>``, without those of other autopilots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ...devices.ardupilot import ArduPilotSpec
from ...devices.device import DeviceSpec
from ...devices.px4 import Px4Spec
from ...errors import BadSetting
from ...scene.spec import SceneSpec
from ...scene.vehicle import VehicleSpec


def connect_px4(scene: SceneSpec) -> SceneSpec:
    """Return a scene with at least one ``<u:px4>``, and without ``<u:ardupilot>``.

    A scene without one has it in the first vehicle with dynamics.

    Raises:
        BadSetting: no vehicle has dynamics, or two vehicles have one port.
    """
    vehicles = [remove_parts(vehicle, ArduPilotSpec) for vehicle in scene.vehicles]
    vehicles = add_autopilot(vehicles, Px4Spec(), option="--px4")
    ports = [spec.port for vehicle in vehicles for spec in vehicle.parts_of(Px4Spec)]
    for port in ports:
        if ports.count(port) > 1:
            raise BadSetting(
                f"--px4: {ports.count(port)} elements <u:px4> have the TCP port {port}; expected "
                "4560 plus the number of the instance of PX4."
            )
    return replace(scene, vehicles=tuple(vehicles))


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
