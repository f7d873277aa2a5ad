"""Rules about the dynamics of a scene: names in hydrodynamics, collision shapes, floors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...errors import Diagnostic, SceneError, UwsimError
from ...model.body_names import object_body
from ...model.collision.scene_shapes import collision_shapes, solid_objects_in_water
from ...model.placement import set_on_floor
from ...physics.free_objects import object_errors
from ..subjects import CheckedScene


def hydrodynamic_names(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return the errors in names of the hydrodynamics of a scene."""
    return scene.names.diagnostics


def object_shapes(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report objects for which the engine has no collision shape, or that it cannot move."""
    dynamics, spec = scene.dynamics, scene.spec
    density = next(iter(dynamics.values())).density if dynamics else None
    for index, physics in solid_objects_in_water(spec, dynamics).items():
        object_spec = spec.objects[index]
        try:
            shapes = collision_shapes(scene.resolved_scene, (), {index: physics})
            if physics.is_loose:
                yield from object_errors(object_spec, physics, shapes[object_body(index)], density)
        except UwsimError as error:
            yield scene.error(object_spec, str(error).removesuffix("."), "physics")


def missing_floors(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return the errors about bodies to be placed on a floor that have none below them."""
    try:
        set_on_floor(scene.resolved_scene)
    except SceneError as error:
        return error.diagnostics
    except UwsimError:  # reported where robots and models are checked
        pass
    return ()
