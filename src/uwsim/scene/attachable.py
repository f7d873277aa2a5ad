"""The bodies of a scene on which a force can act, by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from .spec import SceneSpec
from .urdf.robot import RobotSpec


@dataclass(frozen=True)
class AttachableBody:
    """A body on which a force can act: a link of a vehicle, or an object."""

    kind: Literal["vehicle", "object"]
    """The kind of body."""
    index: int
    """The index of the vehicle or object in the scene."""
    link: str = ""
    """The name of the link; empty for an object."""


def attachable_bodies(
    scene: SceneSpec, robots: Mapping[int, RobotSpec]
) -> dict[str, AttachableBody]:
    """Return the bodies by name: ``vehicle`` (its base), ``vehicle/link``, or an object.

    A name that several bodies share is that of the first.

    Args:
        scene: the scene.
        robots: the robots by the index of the vehicle in the scene.
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
    """Return whether forces move a body: on a vehicle with dynamics, or a loose object."""
    if body.kind == "vehicle":
        return scene.vehicles[body.index].dynamics is not None
    moves_bodies = scene.is_dynamic or scene.has_original_physics
    solid = scene.solid_objects.get(body.index)
    return moves_bodies and solid is not None and solid.is_loose
