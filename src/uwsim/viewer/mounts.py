"""The entries of the head for what is mounted on bodies: cameras, lamps, sensors, frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from ..base.geometry import Pose
from ..sensors.range_sensor import RangeSensorSpec
from ..sensors.sensor import MountedSensor
from ..sensors.sonar.imaging_sonar import ImagingSonarSpec
from ..sensors.sonar.multibeam_sensor import FanSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..simulation.live_scene import LiveScene
from .bodies import Bodies, pose_row
from .models import Models

Json = dict[str, Any]


def describe_cameras(world: LiveScene, bodies: Bodies) -> Iterator[Json]:
    """Yield the entry of each camera, in the order of the scene."""
    links = {  # of several cameras with one name, the last is used
        spec.name: f"{vehicle}/{spec.relative_to}"
        for vehicle, spec in _mounted_parts(world)
        if isinstance(spec, VirtualCameraSpec)
    }
    for name in world.sensors.cameras:
        camera = world.sensors.camera(name)
        yield {
            **_mount_fields(bodies, links[name], camera.world_from_camera),
            "name": name,
            "grey": camera.is_grey,
            **asdict(camera.intrinsics),
        }


def describe_lamps(world: LiveScene, bodies: Bodies) -> Iterator[Json]:
    """Yield the entry of each lamp, and of each signal lamp."""
    for lamp in world.scenery.mounted_lamps:
        spec = lamp.spec
        yield {
            **_mount_fields(bodies, lamp.link, lamp.world_from_lamp),
            "name": spec.name,
            "half_angle": math.radians(spec.fov / 2.0),
            "softness": spec.softness,
            "colour": list(spec.color),
            "intensity": spec.intensity,
            "shadow": spec.shadow,
            "on": lamp.is_on,
        }


def describe_projector(world: LiveScene, bodies: Bodies, models: Models) -> Json | None:
    """Return the entry of the projector; None if the scene has none."""
    if world.scenery.mounted_projector is None:
        return None
    projector, pattern = world.scenery.mounted_projector
    return {
        **_mount_fields(bodies, projector.link, projector.world_from_projector),
        "fovy": math.radians(projector.spec.fov),
        "laser": projector.spec.laser,
        "pattern": models.pattern(pattern),
    }


def describe_sensors(world: LiveScene, bodies: Bodies) -> Iterator[Json]:
    """Yield the entry of each sensor whose rays the page shows."""
    for name, spec in _mounted_parts(world):
        mount = world.vehicles.find(name).mount(spec)
        fields = {**_mount_fields(bodies, mount.name, mount.world_from_body), "name": spec.name}
        if isinstance(spec, RangeSensorSpec):
            yield {**fields, "kind": "range", "reach": spec.range, "from": 0.0, "to": 0.0}
        elif isinstance(spec, FanSpec):
            ends = math.radians(spec.init_angle), math.radians(spec.final_angle)
            yield {**fields, "kind": "fan", "reach": spec.range, "from": ends[0], "to": ends[1]}
        elif isinstance(spec, ImagingSonarSpec):
            half = math.radians(spec.horizontal_aperture) / 2.0
            yield {**fields, "kind": "sonar", "reach": spec.range, "from": -half, "to": half}


def describe_frames(world: LiveScene, bodies: Bodies) -> Iterator[Json]:
    """Yield the entry of each frame: L, the links and the mounts of sensors."""
    yield {"name": "L", "body": None, "pose": pose_row(world.model.scene.world_from_localized)}
    for index, vehicle in enumerate(world.model.scene.vehicles):
        for link in world.model.robots[index].links:
            name = f"{vehicle.name}/{link.name}"
            world_from_link = world.engine.poses.link(index, link.name)
            yield {**_mount_fields(bodies, name, world_from_link), "name": name}
        for part in (part for name, part in _mounted_parts(world) if name == vehicle.name):
            mount = world.vehicles.find(vehicle.name).mount(part)
            yield {**_mount_fields(bodies, mount.name, mount.world_from_body), "name": part.name}


def _mounted_parts(world: LiveScene) -> Iterator[tuple[str, MountedSensor]]:
    """Yield the vehicle's name and the spec of each sensor on a link that exists."""
    for index, vehicle in enumerate(world.model.scene.vehicles):
        for _, part in vehicle.all_parts():
            links = world.model.robots[index]
            if isinstance(part, MountedSensor) and links.link(part.relative_to) is not None:
                yield vehicle.name, part


def describe_vehicles(world: LiveScene, bodies: Bodies) -> Iterator[Json]:
    """Yield the entry of each vehicle."""
    for index, spec in enumerate(world.model.scene.vehicles):
        vehicle = world.vehicles.find(spec.name)
        yield {
            "name": bodies.labels[index],
            "body": bodies.link(index, world.model.robots[index].root),
            "thrusters": list(vehicle.thrusters),
            "joints": list(vehicle.joint_names),
        }


def _mount_fields(bodies: Bodies, name: str, world_from_part: Pose) -> Json:
    """Return the fields ``body`` and ``pose``: the body of a link, and a part's pose on it.

    Args:
        bodies: the bodies of the head.
        name: the link, ``vehicle/link``.
        world_from_part: the pose of the part.
    """
    vehicle, _, link = name.partition("/")
    body = bodies.named_link(vehicle, link)
    return {"body": body, "pose": pose_row(bodies.pose(body).inverse() @ world_from_part)}
