"""The scene of a run with PX4: its elements ``<u:px4>``, without those of other autopilots."""

from __future__ import annotations

from dataclasses import replace

from ...devices.ardupilot import ArduPilotSpec
from ...devices.px4 import Px4Spec
from ...scene.spec import SceneSpec
from .autopilot_scene import add_autopilot, check_ports, remove_parts


def connect_px4(scene: SceneSpec) -> SceneSpec:
    """Return a scene with at least one ``<u:px4>``, and without ``<u:ardupilot>``.

    A scene without one has it in the first vehicle with dynamics.

    Raises:
        BadSetting: no vehicle has dynamics, or two elements open one port.
    """
    vehicles = [remove_parts(vehicle, ArduPilotSpec) for vehicle in scene.vehicles]
    vehicles = add_autopilot(vehicles, Px4Spec(), option="--px4")
    connected_scene = replace(scene, vehicles=tuple(vehicles))
    advice = "4560 plus the number of the instance of PX4"
    check_ports(connected_scene, option="--px4", advice=advice)
    return connected_scene
