"""The scene of a run with PX4: its elements ``<u:px4>``, without those of other autopilots."""

from __future__ import annotations

from dataclasses import replace

from ...devices.ardupilot import ArduPilotSpec
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
    if not any(vehicle.parts_of(Px4Spec) for vehicle in vehicles):
        indices = [i for i, vehicle in enumerate(vehicles) if vehicle.dynamics is not None]
        if not indices:
            raise BadSetting(
                "--px4: no vehicle of the scene has <u:dynamics>, which thrusters need."
            )
        first_vehicle = vehicles[indices[0]]
        vehicles[indices[0]] = replace(first_vehicle, parts=(*first_vehicle.parts, Px4Spec()))
    ports = [spec.port for vehicle in vehicles for spec in vehicle.parts_of(Px4Spec)]
    for port in ports:
        if ports.count(port) > 1:
            raise BadSetting(
                f"--px4: {ports.count(port)} elements <u:px4> have the TCP port {port}; expected "
                "4560 plus the number of the instance of PX4."
            )
    return replace(scene, vehicles=tuple(vehicles))


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
