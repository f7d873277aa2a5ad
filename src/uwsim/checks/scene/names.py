"""Checks that names in a scene exist: links, sensors, vehicles.

An error where the original, too, would stop or crash; a warning where it warns and goes on.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from ...devices.force_sensor import ForceSensorSpec
from ...devices.lamp import MAX_LAMPS, LampSpec
from ...errors import Diagnostic
from ...scene.angles import MORE_THAN_A_TURN
from ...scene.object import ObjectSpec
from ...scene.spec import SceneSpec
from ...schema import format_tag, line_of
from ...topics import element_of
from ...topics.sensor_topic import SensorToROSSpec
from ...topics.simulated_device_ros import unwrapped
from ...topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from ..subjects import CheckedScene
from .shared_names import source_of

MAX_NAMED = 8
"""Objects that one warning names."""


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
                near = scene.diagnostics.suggest(link, links, severity)
                message = f"{format_tag(element)}: {link!r} is no link of {vehicle.file}.{near}"
                if is_error:
                    yield scene.error(part, message)
                else:
                    yield scene.warning(part, f"{message} It is left out, as in the original")
            elif isinstance(part, ForceSensorSpec) and scene.spec.sim_params.enable_physics:
                mass = next(each.mass for each in robot.links if each.name == link)
                if mass <= 0 and not scene.has_stand_in(index):
                    yield scene.warning(
                        part, f"{format_tag(element)}: its link {link!r} has no mass"
                    )


def joint_values(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of joint values that are too many, or beyond the limits of their joints."""
    for index, robot in scene.robots.items():
        vehicle = scene.spec.vehicles[index]
        place = line_of(vehicle, "jointValues")
        if len(vehicle.joint_values) > len(robot.movable):
            joints = ", ".join(joint.name for joint in robot.movable)
            yield scene.warning(
                place,
                f"<jointValues> has {len(vehicle.joint_values)} values for {len(robot.movable)} "
                f"joints ({joints}); the rest is not used",
            )
        for joint, value in zip(robot.movable, vehicle.joint_values, strict=False):
            held = joint.clamped(value)
            if held != value:
                message = f"joint {joint.name!r} at {value:g} is limited to {held:g}"
                if joint.kind != "prismatic" and abs(value) > MORE_THAN_A_TURN:
                    message += f" [rad]; {value:g} degrees are {math.radians(value):.5g}"
                yield scene.warning(place, message)


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


def unknown_sources(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report interfaces whose vehicle, camera or sensor does not exist."""
    known = _names(scene.spec)
    for interface in unwrapped(scene.spec.ros_interfaces):
        if isinstance(interface, SensorToROSSpec):
            continue  # not left out as in the original: `NamedSensors.error` reports it
        element = element_of(interface)
        wanted = source_of(interface)
        if wanted is None:
            continue
        kinds = interface.sources
        if not any(wanted in known.get(kind, {}) for kind in kinds):
            names = chain(*(known.get(kind, {}) for kind in kinds))
            near = scene.diagnostics.suggest(wanted, names, "warning")
            yield scene.warning(
                interface,
                f"{format_tag(element)}: no {' or '.join(kinds)} is called {wanted!r}.{near} "
                "The interface is left out, as in the original",
            )
        elif (
            isinstance(interface, VirtualCameraToROSImageSpec)
            and interface.depth
            and wanted not in known.get("virtualRangeImage", {})
        ):
            yield scene.error(
                interface,
                f"{format_tag(element)}: <depth> 1 needs a virtualRangeImage; {wanted!r} is none",
            )


def shared_sources(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of several interfaces on one camera, of which the original keeps the last."""
    cameras = [
        interface
        for interface in scene.spec.ros_interfaces
        if isinstance(interface, VirtualCameraToROSImageSpec)
    ]
    last_of = {interface.camera_name: interface for interface in cameras}
    for name in _repeated(interface.camera_name for interface in cameras):
        last = last_of[name]
        yield scene.warning(
            last,
            f"camera {name!r} has several interfaces; the original serves this last one only",
        )
    vehicles = scene.spec.vehicles
    for name in _repeated(vehicle.name for vehicle in vehicles):
        second = [vehicle for vehicle in vehicles if vehicle.name == name][1]
        message = f"several vehicles are called {name!r}; searches find the first"
        yield scene.warning(second, message)


def lamps_beyond_the_last(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report lamps that are more than can be drawn."""
    drawn = [vehicle for vehicle in scene.spec.vehicles if not vehicle.vr]
    lamps = [lamp for vehicle in drawn for lamp in vehicle.parts_of(LampSpec)]
    for lamp in lamps[MAX_LAMPS:]:
        yield scene.error(lamp, f"<u:lamp> {lamp.name!r}: more than {MAX_LAMPS} lamps")


def passable_objects(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report the objects that simulated vehicles pass through, unless the file declares them so."""
    things = [
        thing
        for thing in (scene.spec.objects if scene.spec.is_dynamic else ())
        if thing.is_solid is None and not thing.is_touched(in_water=True)
    ]
    if things:
        yield scene.warning(
            things[0],
            f"simulated vehicles pass through what has no <physics>: {_named(things)}; "
            "<u:solid>1</u:solid> in the object makes it solid, <u:solid>0</u:solid> says that it "
            "is meant",
        )


def loose_scenery(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report scenery that the original's physics moves beside objects that have ``<physics>``."""
    objects = scene.spec.objects if scene.spec.is_original_physics else ()
    things = [
        thing
        for thing in objects
        if thing.is_solid is None and thing.physics is None and not thing.is_ground
    ]
    if things and any(thing.physics is not None for thing in objects):
        yield scene.warning(
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


def passable_vehicles(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report the vehicles that simulated ones pass through, and those without any shape."""
    robots = scene.robots
    for index, vehicle in enumerate(scene.spec.vehicles if scene.spec.is_dynamic else ()):
        if "passable" in vehicle.accepts or vehicle.vr:
            continue
        links = robots[index].links if index in robots else ()
        if vehicle.dynamics is None:
            why = "simulated vehicles pass through it: it has no <u:dynamics>"
        elif links and not any(link.solids for link in links):
            why = "it passes through everything: no link has a <collision> or a <visual>"
        else:
            continue
        yield scene.warning(
            vehicle,
            f"vehicle {vehicle.name!r}: {why}; if that is meant: <u:accept>passable</u:accept>",
        )


def _repeated(names: Iterable[str]) -> list[str]:
    return [name for name, count in Counter(names).items() if count > 1]
