"""The bodies of a scene on which a force can act, by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from .spec import SceneSpec
from .urdf.robot import RobotSpec


@dataclass(frozen=True)
class AttachableBody:
    """A vehicle's link or an object."""

    kind: Literal["vehicle", "object"]
    """The kind of body."""
    index: int
    """The number of the vehicle or object in the scene."""
    link: str = ""
    """The link; empty for an object."""


def attachable_bodies(
    scene: SceneSpec, robots: Mapping[int, RobotSpec]
) -> dict[str, AttachableBody]:
    """Return ``vehicle`` (its base), ``vehicle/link`` and objects; the first of equal names.

    Args:
        scene: the scene.
        robots: the robot of each vehicle that has one, by its number in the scene.
    """
    bodies: dict[str, AttachableBody] = {}
    for index, robot in robots.items():
        vehicle = scene.vehicles[index].name
        bodies.setdefault(vehicle, AttachableBody("vehicle", index, robot.root))
        for link in robot.links:
            bodies.setdefault(f"{vehicle}/{link.name}", AttachableBody("vehicle", index, link.name))
    for index, spec in enumerate(scene.objects):
        bodies.setdefault(spec.name, AttachableBody("object", index))
    return bodies


def is_moved_by_forces(scene: SceneSpec, body: AttachableBody) -> bool:
    """Return whether a body is simulated: a vehicle with ``u:dynamics``, or a loose object."""
    if body.kind == "vehicle":
        return scene.vehicles[body.index].dynamics is not None
    is_simulated = scene.is_dynamic or scene.has_uwsim_physics
    solid = scene.solid_objects.get(body.index)
    return is_simulated and solid is not None and solid.is_loose
