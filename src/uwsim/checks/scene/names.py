"""Rules about names in a scene that refer to nothing: links, sensors, vehicles.

Such a name is an error if the original UWSim stops or crashes, too, and a warning if the original
warns and continues. Other rules here are about joint values, lamps and bodies without contacts.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from ...devices.force_sensor import ForceSensorSpec
from ...devices.lamp import MAX_LAMPS, LampSpec
from ...errors import Diagnostic
from ...forces import FORCES
from ...scene.angles import MAX_PLAUSIBLE_ANGLE
from ...scene.object import ObjectSpec
from ...scene.spec import SceneSpec
from ...schema import format_tag, line_of
from ...topics import element_name
from ...topics.sensor_topic import SensorToROSSpec
from ...topics.simulated_device_ros import unwrap_interfaces
from ...topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from ..subjects import CheckedScene
from .shared_names import source_of

MAX_LISTED_OBJECTS = 8
"""The greatest number of objects that one warning names."""


def unknown_links(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report sensors and devices on links that their robot does not have."""
    for index, robot in scene.robots.items():
        vehicle = scene.spec.vehicles[index]
        links = {link.name: None for link in robot.links}
        for element, part in vehicle.all_parts():
            link = getattr(part, "relative_to", None) or getattr(part, "target", None)
            if link is None:
                continue
            if link not in links:
                is_error = isinstance(part, ForceSensorSpec | LampSpec)
                severity = "error" if is_error else "warning"
                suggestion = scene.diagnostics.suggest(link, links, severity)
                message = f"{format_tag(element)}: {link!r} is no link of {vehicle.file}."
                if is_error:
                    yield scene.error(part, f"{message}{suggestion}")
                else:
                    remark = "It is ignored, as in the original"
                    yield scene.warning(part, f"{message}{suggestion} {remark}")
            elif isinstance(part, ForceSensorSpec) and scene.spec.sim_params.enable_physics:
                mass = next(
                    robot_link.mass for robot_link in robot.links if robot_link.name == link
                )
                if mass <= 0 and not scene.has_substitute_robot(index):
                    message = f"{format_tag(element)}: its link {link!r} has no mass"
                    yield scene.warning(part, message)


def joint_values(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of too many joint values, or values beyond the limits of their joints."""
    for index, robot in scene.robots.items():
        vehicle = scene.spec.vehicles[index]
        line = line_of(vehicle, "jointValues")
        n_values, n_joints = len(vehicle.joint_values), len(robot.movable_joints)
        if n_values > n_joints:
            joints = ", ".join(joint.name for joint in robot.movable_joints)
            yield scene.warning(
                line,
                f"<jointValues> has {n_values} values for {n_joints} joints ({joints}); "
                "the rest is not used",
            )
        for joint, value in zip(robot.movable_joints, vehicle.joint_values, strict=False):
            limited_value = joint.clamp(value)
            if limited_value != value:
                message = f"joint {joint.name!r} at {value:g} is limited to {limited_value:g}"
                if joint.kind != "prismatic" and abs(value) > MAX_PLAUSIBLE_ANGLE:
                    message += f" [rad]; {value:g} degrees are {math.radians(value):.5g}"
                yield scene.warning(line, message)


def _names_by_kind(scene: SceneSpec) -> dict[str, dict[str, None]]:
    names: dict[str, dict[str, None]] = {
        "vehicle": {vehicle.name: None for vehicle in scene.vehicles},
        "object": {spec.name: None for spec in scene.objects},
    }
    for vehicle in scene.vehicles:
        for element, part in vehicle.all_parts():
            name = str(getattr(part, "name", None) or getattr(part, "dccomms_id", ""))
            names.setdefault(element, {})[name] = None
    elements = {spec: element for element, spec in FORCES.items()}
    for force in scene.forces:
        names.setdefault(f"u:{elements.get(type(force), '')}", {})[force.name] = None
    return names


def unknown_sources(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report interfaces whose vehicle, camera or sensor does not exist."""
    known_names = _names_by_kind(scene.spec)
    for interface in unwrap_interfaces(scene.spec.ros_interfaces):
        if isinstance(interface, SensorToROSSpec):
            continue  # an error, which `NamedSensors.error` reports
        element = element_name(interface)
        source = source_of(interface)
        if source is None:
            continue
        kinds = interface.sources
        if not any(source in known_names.get(kind, {}) for kind in kinds):
            names = chain(*(known_names.get(kind, {}) for kind in kinds))
            suggestion = scene.diagnostics.suggest(source, names, "warning")
            yield scene.warning(
                interface,
                f"{format_tag(element)}: no {' or '.join(kinds)} is called {source!r}.{suggestion} "
                "The interface is ignored, as in the original",
            )
        elif (
            isinstance(interface, VirtualCameraToROSImageSpec)
            and interface.depth
            and source not in known_names.get("virtualRangeImage", {})
        ):
            yield scene.error(
                interface,
                f"{format_tag(element)}: <depth> 1 needs a virtualRangeImage; {source!r} is none",
            )


def shared_sources(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of cameras with several interfaces, and of vehicles with the same name."""
    cameras = [
        interface
        for interface in scene.spec.ros_interfaces
        if isinstance(interface, VirtualCameraToROSImageSpec)
    ]
    last_interfaces = {interface.camera_name: interface for interface in cameras}
    for name in _repeated_names(interface.camera_name for interface in cameras):
        yield scene.warning(
            last_interfaces[name],
            f"camera {name!r} has several interfaces; the original serves this last one only",
        )
    vehicles = scene.spec.vehicles
    for name in _repeated_names(vehicle.name for vehicle in vehicles):
        second_vehicle = [vehicle for vehicle in vehicles if vehicle.name == name][1]
        message = f"several vehicles are called {name!r}; searches find the first"
        yield scene.warning(second_vehicle, message)


def excess_lamps(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report lamps beyond the limit of the renderer."""
    vehicles = [vehicle for vehicle in scene.spec.vehicles if not vehicle.vr]
    lamps = [lamp for vehicle in vehicles for lamp in vehicle.parts_of(LampSpec)]
    for lamp in lamps[MAX_LAMPS:]:
        yield scene.error(lamp, f"<u:lamp> {lamp.name!r}: more than {MAX_LAMPS} lamps")


def passable_objects(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report objects that vehicles with dynamics pass through, unless ``<u:solid>`` is set."""
    specs = [
        spec
        for spec in (scene.spec.objects if scene.spec.is_dynamic else ())
        if spec.is_solid is None and not spec.has_contacts(in_water=True)
    ]
    if specs:
        yield scene.warning(
            specs[0],
            "vehicles with dynamics pass through objects without <physics>: "
            f"{_list_objects(specs)}. <u:solid>1</u:solid> in the object makes it solid; "
            "<u:solid>0</u:solid> accepts the warning",
        )


def loose_scenery(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report objects without ``<physics>`` that fall as loose boxes, as in the original UWSim."""
    objects = scene.spec.objects if scene.spec.requests_original_physics else ()
    specs = [
        spec
        for spec in objects
        if spec.is_solid is None and spec.physics is None and not spec.is_ground
    ]
    if specs and any(spec.physics is not None for spec in objects):
        yield scene.warning(
            specs[0],
            "an object without <physics> is a loose box of 1 kg, as in the original: "
            f"{_list_objects(specs)}. With <u:solid>1</u:solid> it is solid and fixed, like "
            "'terrain'. Bodies pass through it with <u:solid>0</u:solid>",
        )


def _list_objects(specs: Sequence[ObjectSpec]) -> str:
    names = [f"{spec.name!r} (line {line_of(spec) or '?'})" for spec in specs[:MAX_LISTED_OBJECTS]]
    n_others = len(specs) - len(names)
    return ", ".join(names) + (f" and {n_others} more" if n_others else "")


def passable_vehicles(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report vehicles without dynamics or without shapes, which pass through other vehicles."""
    robots = scene.robots
    for index, vehicle in enumerate(scene.spec.vehicles if scene.spec.is_dynamic else ()):
        if "passable" in vehicle.accepts or vehicle.vr:
            continue
        links = robots[index].links if index in robots else ()
        if vehicle.dynamics is None:
            message = "vehicles with dynamics pass through it: it has no <u:dynamics>"
        elif links and not any(link.solids for link in links):
            message = "it passes through everything: no link has a <collision> or a <visual>"
        else:
            continue
        yield scene.warning(
            vehicle,
            f"vehicle {vehicle.name!r}: {message}. If intended: <u:accept>passable</u:accept>",
        )


def _repeated_names(names: Iterable[str]) -> list[str]:
    return [name for name, count in Counter(names).items() if count > 1]
