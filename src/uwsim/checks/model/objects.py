"""Warnings about the numbers of a loose object: likely mistakes of units and frames."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...errors import Diagnostic, UwsimError
from ...model.body_names import object_body
from ...model.collision.scene_shapes import collision_shapes
from ...model.collision.shapes import CollisionShape, bounding_box
from ...scene.accepted_warnings import ObjectWarning, acceptance_hint
from ...scene.object import PhysicsSpec
from ..subjects import CheckedScene
from .vehicles import MAX_VOLUME_RATIO

MAX_OFFSET_SHARE = 0.05
"""The greatest expected distance of the centre of mass from the object's bounding box, as a
fraction of the box's longest edge [1]."""


ObjectCheck = Callable[[PhysicsSpec, Sequence[CollisionShape]], str]
"""A function that describes unlikely values of an object, from its shapes; empty if none."""


def object_numbers(
    scene: CheckedScene, checks: Mapping[ObjectWarning, ObjectCheck]
) -> Iterator[Diagnostic]:
    """Apply checks to each loose object; the keys are the names that suppress the warnings."""
    for index, physics in scene.loose_objects.items():
        if physics.centre_of_mass is None and physics.volume is None:
            continue
        spec = scene.spec.objects[index]
        with suppress(UwsimError):  # reported where models are checked
            shapes = collision_shapes(scene.resolved_scene, (), {index: physics})
            for warning, check in checks.items():
                text = check(physics, shapes[object_body(index)])
                if text and warning not in spec.accepts:
                    message = f"the object {spec.name!r}: {text}. {acceptance_hint(warning)}"
                    yield scene.warning(spec, message, "physics")


def describe_centre(physics: PhysicsSpec, shapes: Sequence[CollisionShape]) -> str:
    """Describe a centre of mass outside the box around an object; empty if inside."""
    box = bounding_box(shapes)
    half = np.array(box.size)  # half the edges, (3,) [m]
    if physics.centre_of_mass is None:
        return ""
    offset: Array = np.array(physics.centre_of_mass) - box.body_from_shape.position
    distance = length(np.maximum(np.abs(offset) - half, 0.0))
    if distance <= MAX_OFFSET_SHARE * 2.0 * half.max():
        return ""
    return (
        f"its centre of mass lies {distance:.3g} m outside the box around it, "
        f"{_edges(half)} m; expected within (<u:centreOfMass> is in metres, in the object's frame)"
    )


def describe_volume(physics: PhysicsSpec, shapes: Sequence[CollisionShape]) -> str:
    """Describe a displaced volume that is too large for the box around an object; empty if not."""
    half = np.array(bounding_box(shapes).size)  # half the edges, (3,) [m]
    box_volume = float(np.prod(2.0 * half))
    if physics.volume is None or physics.volume <= MAX_VOLUME_RATIO * box_volume:
        return ""
    return (
        f"it displaces {physics.volume:.3g} m3 and the box around it, {_edges(half)} m, has "
        f"{box_volume:.3g} m3; expected at most {MAX_VOLUME_RATIO:g} times that "
        "(<u:volume> is in m3)"
    )


def _edges(half: Array) -> str:
    return " ".join(f"{2.0 * edge:.3g}" for edge in half.tolist())
