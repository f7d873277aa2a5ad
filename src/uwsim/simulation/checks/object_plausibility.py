"""Warnings about the numbers of a loose object: likely mistakes of units and frames."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...errors import UwsimError
from ...model.body_names import object_body
from ...model.collision.scene_shapes import collision_shapes
from ...model.collision.shapes import CollisionShape, bounds
from ...scene.checks.plausibility import ObjectWarning
from ...scene.object import PhysicsSpec
from ...scene.spec import SceneSpec
from .vehicle_plausibility import ROOM

MARGIN = 0.05
"""So far outside its box the centre of mass of an object may lie, as a share of its length."""


def of_objects(
    scene: SceneSpec, objects: Mapping[int, PhysicsSpec], data_path: tuple[Path, ...]
) -> Iterator[tuple[int, ObjectWarning, str]]:
    """Each check of loose objects: number, name of the warning, and a message or nothing.

    Args:
        scene: spec of the scene.
        objects: what each is, by its number.
        data_path: folders in which files are looked for.
    """
    for index, physics in objects.items():
        if physics.centre_of_mass is None and physics.volume is None:
            continue
        with suppress(UwsimError):  # reported where models are checked
            shapes = collision_shapes(scene, {}, (), {index: physics}, data_path)
            parts = shapes[object_body(index)]
            yield index, "places", centre_said(physics, parts)
            yield index, "buoyancy", volume_said(physics, parts)


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
