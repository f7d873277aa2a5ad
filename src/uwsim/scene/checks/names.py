"""Checks that names in a scene exist: links, sensors, vehicles.

An error where the original, too, would stop or crash; a warning where it warns and goes on.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import chain

from ...devices.force_sensor import ForceSensorSpec
from ...devices.lamp import MAX_LAMPS, LampSpec
from ...schema import Diagnostics, line_of, shown_tag
from ...topics import InterfaceSpec, element_of
from ...topics.sensor_topic import SensorToROSSpec
from ...topics.simulated_device_ros import unwrapped
from ...topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from ..object import ObjectSpec
from ..spec import SceneSpec
from ..urdf.robot import RobotSpec
from ..vehicle import VehicleSpec
from .angles import MORE_THAN_A_TURN
from .comms import check_comms
from .shared_names import check_shared_names

MAX_NAMED = 8
"""Objects that one warning names."""


def check_names(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    diagnostics: Diagnostics,
    stand_ins: Collection[int] = (),
) -> None:
    """Look up every name of a scene.

    Args:
        scene: the scene.
        robots: the robot of each vehicle that has one, by its number in the scene.
        diagnostics: receives what leads nowhere.
        stand_ins: numbers of the vehicles whose robot stands for another: what theirs has is not
            known.
    """
    check_left_out(scene, robots, diagnostics, stand_ins)
    for index in robots:
        _check_joints(scene.vehicles[index], robots[index], diagnostics)
    check_comms(scene, diagnostics)
    drawn = [vehicle for vehicle in scene.vehicles if not vehicle.vr]
    lamps = [lamp for vehicle in drawn for lamp in vehicle.parts_of(LampSpec)]
    for lamp in lamps[MAX_LAMPS:]:
        diagnostics.error(lamp, f"<u:lamp> {lamp.name!r}: more than {MAX_LAMPS} lamps")
    if scene.is_dynamic:
        _check_passable_objects(scene, diagnostics)
        _check_passable_vehicles(scene, robots, diagnostics)
    elif scene.is_original_physics:
        _check_loose_scenery(scene, diagnostics)


def check_left_out(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    diagnostics: Diagnostics,
    stand_ins: Collection[int] = (),
) -> None:
    """Report what is left out of a scene, or hidden by another of the same name."""
    for index in robots:
        is_its_own = index not in stand_ins
        vehicle = scene.vehicles[index]
        _check_links(vehicle, robots[index], scene, diagnostics, is_its_own=is_its_own)
    known = _names(scene)
    for interface in unwrapped(scene.ros_interfaces):
        _check_interface(interface, known, diagnostics)
    _check_sources(scene, diagnostics)
    check_shared_names(scene, diagnostics)


def _check_links(
    vehicle: VehicleSpec,
    robot: RobotSpec,
    scene: SceneSpec,
    diagnostics: Diagnostics,
    *,
    is_its_own: bool,
) -> None:
    links = {link.name: None for link in robot.links}
    for element, part in vehicle.all_parts():
        link = getattr(part, "relative_to", None) or getattr(part, "target", None)
        if link is None:
            continue
        if link not in links:
            is_error = isinstance(part, ForceSensorSpec | LampSpec)
            severity = "error" if is_error else "warning"
            near = diagnostics.near(link, links, severity)
            message = f"{shown_tag(element)}: {link!r} is no link of {vehicle.file}.{near}"
            if is_error:
                diagnostics.error(part, message)
            else:
                diagnostics.warning(part, f"{message} It is left out, as in the original")
        elif isinstance(part, ForceSensorSpec) and scene.sim_params.enable_physics:
            mass = next(each.mass for each in robot.links if each.name == link)
            if mass <= 0 and is_its_own:
                diagnostics.warning(part, f"{shown_tag(element)}: its link {link!r} has no mass")


def _check_joints(vehicle: VehicleSpec, robot: RobotSpec, diagnostics: Diagnostics) -> None:
    place = line_of(vehicle, "jointValues")
    if len(vehicle.joint_values) > len(robot.movable):
        diagnostics.warning(
            place,
            f"<jointValues> has {len(vehicle.joint_values)} values for {len(robot.movable)} "
            f"joints ({', '.join(joint.name for joint in robot.movable)}); the rest is not used",
        )
    for joint, value in zip(robot.movable, vehicle.joint_values, strict=False):
        held = joint.clamped(value)
        if held != value:
            message = f"joint {joint.name!r} at {value:g} is limited to {held:g}"
            if joint.kind != "prismatic" and abs(value) > MORE_THAN_A_TURN:
                message += f" [rad]; {value:g} degrees are {math.radians(value):.5g}"
            diagnostics.warning(place, message)


def _names(scene: SceneSpec) -> dict[str, dict[str, None]]:
    """Element -> the names that elements of that kind have, in their order."""
    known: dict[str, dict[str, None]] = {
        "vehicle": {vehicle.name: None for vehicle in scene.vehicles},
        "object": {thing.name: None for thing in scene.objects},
    }
    for vehicle in scene.vehicles:
        for element, part in vehicle.all_parts():
            name = str(getattr(part, "name", None) or getattr(part, "dccomms_id", ""))
            known.setdefault(element, {})[name] = None
    return known


def _check_interface(
    interface: InterfaceSpec,
    known: Mapping[str, Mapping[str, None]],
    diagnostics: Diagnostics,
) -> None:
    if isinstance(interface, SensorToROSSpec):
        return  # not left out as in the original: `NamedSensors.error` reports it
    element = element_of(interface)
    wanted = next(
        (
            getattr(interface, name)
            for name in ("vehicle_name", "camera_name", "name")
            if hasattr(interface, name)
        ),
        None,
    )
    if wanted is None:
        return
    kinds = interface.sources
    if not any(wanted in known.get(kind, {}) for kind in kinds):
        near = diagnostics.near(wanted, chain(*(known.get(kind, {}) for kind in kinds)), "warning")
        diagnostics.warning(
            interface,
            f"{shown_tag(element)}: no {_or(kinds)} is called {wanted!r}.{near} "
            "The interface is left out, as in the original",
        )
    elif (
        isinstance(interface, VirtualCameraToROSImageSpec)
        and interface.depth
        and wanted not in known.get("virtualRangeImage", {})
    ):
        diagnostics.error(
            interface,
            f"{shown_tag(element)}: <depth> 1 needs a virtualRangeImage; {wanted!r} is none",
        )


def _check_sources(scene: SceneSpec, diagnostics: Diagnostics) -> None:
    """Of several interfaces on one camera the original keeps the last."""
    cameras = [
        interface
        for interface in scene.ros_interfaces
        if isinstance(interface, VirtualCameraToROSImageSpec)
    ]
    last_of = {interface.camera_name: interface for interface in cameras}
    for name in _repeated(interface.camera_name for interface in cameras):
        last = last_of[name]
        diagnostics.warning(
            last,
            f"camera {name!r} has several interfaces; the original serves this last one only",
        )
    for name in _repeated(vehicle.name for vehicle in scene.vehicles):
        second = [vehicle for vehicle in scene.vehicles if vehicle.name == name][1]
        message = f"several vehicles are called {name!r}; searches find the first"
        diagnostics.warning(second, message)


def _check_passable_objects(scene: SceneSpec, diagnostics: Diagnostics) -> None:
    """Report the objects that simulated vehicles pass through, unless the file declares them so."""
    things = [
        thing
        for thing in scene.objects
        if thing.is_solid is None and not thing.is_touched(in_water=True)
    ]
    if things:
        diagnostics.warning(
            things[0],
            f"simulated vehicles pass through what has no <physics>: {_named(things)}; "
            "<u:solid>1</u:solid> in the object makes it solid, <u:solid>0</u:solid> says that it "
            "is meant",
        )


def _check_loose_scenery(scene: SceneSpec, diagnostics: Diagnostics) -> None:
    """Report scenery that the original's physics moves beside objects that have ``<physics>``."""
    things = [
        thing
        for thing in scene.objects
        if thing.is_solid is None and thing.physics is None and not thing.is_ground
    ]
    if things and any(thing.physics is not None for thing in scene.objects):
        diagnostics.warning(
            things[0],
            f"what has no <physics> is a loose box of 1 kg, as in the original: {_named(things)}; "
            "<u:solid>1</u:solid> in the object makes it solid and fixed, as one called 'terrain' "
            "is; <u:solid>0</u:solid> lets everything through",
        )


def _named(things: Sequence[ObjectSpec]) -> str:
    """Name the first of some objects, with their lines."""
    named = [f"{thing.name!r} (line {line_of(thing) or '?'})" for thing in things[:MAX_NAMED]]
    more = f" and {len(things) - MAX_NAMED} more" if len(things) > MAX_NAMED else ""
    return f"{', '.join(named)}{more}"


def _check_passable_vehicles(
    scene: SceneSpec, robots: Mapping[int, RobotSpec], diagnostics: Diagnostics
) -> None:
    """Report the vehicles that simulated ones pass through, and those without any shape."""
    for index, vehicle in enumerate(scene.vehicles):
        if "passable" in vehicle.accepts or vehicle.vr:
            continue
        links = robots[index].links if index in robots else ()
        if vehicle.dynamics is None:
            why = "simulated vehicles pass through it: it has no <u:dynamics>"
        elif links and not any(link.solids for link in links):
            why = "it passes through everything: no link has a <collision> or a <visual>"
        else:
            continue
        diagnostics.warning(
            vehicle,
            f"vehicle {vehicle.name!r}: {why}; if that is meant: <u:accept>passable</u:accept>",
        )


def _repeated(names: Iterable[str]) -> list[str]:
    return [name for name, count in Counter(names).items() if count > 1]


def _or(kinds: Iterable[str]) -> str:
    return " or ".join(kinds)
