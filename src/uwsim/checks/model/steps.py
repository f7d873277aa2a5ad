"""Warnings about loose objects that are too thin for the step of a simulation.

A thin object that rolls as fast as it sinks turns by a large angle in a step, and its contacts are
then sampled too coarsely: it may end the run, or come to rest at a wrong place.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress

from ...errors import Diagnostic, UwsimError
from ...model.body_names import object_body
from ...model.collision.scene_shapes import collision_shapes
from ...model.collision.shapes import CollisionShape, bounding_box
from ...physics.free_objects import loose_hydrodynamics
from ...scene.object import PhysicsSpec
from ...world import GRAVITY
from ..subjects import CheckedScene

MAX_TURN = math.pi
"""The greatest rotation in a step; beyond half a turn its direction is ambiguous [rad]."""


def thin_objects(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of every object that is too thin for a step."""
    if not scene.dynamics:
        return
    density = next(iter(scene.dynamics.values())).density
    for index, physics in scene.loose_objects.items():
        with suppress(UwsimError):  # reported where models are checked
            shapes = collision_shapes(scene.resolved_scene, (), {index: physics})
            message = describe_rotation(
                physics, shapes[object_body(index)], density, scene.timestep
            )
            if message:
                spec = scene.spec.objects[index]
                yield scene.warning(spec, f"the object {spec.name!r}: {message}", "physics")


def describe_rotation(
    physics: PhysicsSpec, shapes: Sequence[CollisionShape], density: float, timestep: float
) -> str:
    """Describe an object that may turn by more than `MAX_TURN` in a step; empty if it does not.

    The object is assumed to roll about its longest axis, as fast as it sinks with its broadest side
    down. The radius of the rolling is half the middle edge of its bounding box.

    Args:
        physics: the physics of the object.
        shapes: its collision shapes.
        density: the density of the water [kg/m3].
        timestep: the length of a step [s].
    """
    water = loose_hydrodynamics("", physics, shapes, density)
    weight_in_water = GRAVITY * (physics.mass - density * water.volume)
    drag = max(water.quadratic_damping[:3])
    if weight_in_water <= 0.0 or drag <= 0.0:
        return ""
    speed = math.sqrt(weight_in_water / drag)
    radius = sorted(bounding_box(shapes).size)[1]
    if speed * timestep <= MAX_TURN * radius:
        return ""
    return (
        f"it is {2000.0 * radius:.3g} mm thick and sinks at {speed:.2g} m/s. If it rolls as fast, "
        f"it turns by {speed * timestep / radius:.2g} rad in a step of {timestep:g} s. Contacts "
        f"may throw it or end the run; expected steps of "
        f"{_round_down_to_digit(MAX_TURN * radius / speed):g} s at most"
    )


def _round_down_to_digit(time: float) -> float:
    power = 10.0 ** math.floor(math.log10(time))
    return math.floor(time / power * (1.0 + 1e-9)) * power
