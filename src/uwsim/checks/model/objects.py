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
from ...model.collision.shapes import CollisionShape, bounds
from ...scene.accepted_warnings import ObjectWarning, unless_meant
from ...scene.object import PhysicsSpec
from ..subjects import CheckedScene
from .vehicles import ROOM

MARGIN = 0.05
"""So far outside its box the centre of mass of an object may lie, as a share of its length."""


ObjectCheck = Callable[[PhysicsSpec, Sequence[CollisionShape]], str]
"""Describes what is unlikely about an object with its shapes; empty if nothing."""


def object_numbers(
    scene: CheckedScene, checks: Mapping[ObjectWarning, ObjectCheck]
) -> Iterator[Diagnostic]:
    """Apply checks, by the name of their warning, to one loose object after another."""
    for index, physics in scene.loose_objects.items():
        if physics.centre_of_mass is None and physics.volume is None:
            continue
        thing = scene.spec.objects[index]
        with suppress(UwsimError):  # reported where models are checked
            shapes = collision_shapes(scene.resolved, (), {index: physics})
            for warning, check in checks.items():
                text = check(physics, shapes[object_body(index)])
                if text and warning not in thing.accepts:
                    message = f"the object {thing.name!r}: {text}. {unless_meant(warning)}"
                    yield scene.warning(thing, message, "physics")


def centre_said(physics: PhysicsSpec, shapes: Sequence[CollisionShape]) -> str:
    """Warn of a centre of mass outside the box around an object."""
    box = bounds(shapes)
    half = np.array(box.size)  # (3,) [m]
    if physics.centre_of_mass is None:
        return ""
    place: Array = np.array(physics.centre_of_mass) - box.body_from_shape.position
    outside = length(np.maximum(np.abs(place) - half, 0.0))
    if outside <= MARGIN * 2.0 * half.max():
        return ""
    return (
        f"its centre of mass lies {outside:.3g} m outside the box around it, "
        f"{_edges(half)} m; expected within (<u:centreOfMass> is in metres, in the object's frame)"
    )


def volume_said(physics: PhysicsSpec, shapes: Sequence[CollisionShape]) -> str:
    """Warn of an object that displaces more than the box around it has room for."""
    half = np.array(bounds(shapes).size)  # (3,) [m]
    room = float(np.prod(2.0 * half))
    if physics.volume is None or physics.volume <= ROOM * room:
        return ""
    return (
        f"it displaces {physics.volume:.3g} m3 and the box around it, {_edges(half)} m, holds "
        f"{room:.3g} m3; expected at most {ROOM:g} times that (<u:volume> is in m3)"
    )


def _edges(half: Array) -> str:
    return " ".join(f"{2.0 * edge:.3g}" for edge in half.tolist())
