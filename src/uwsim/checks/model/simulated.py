"""Rules about the simulated parts of a scene: names, shapes and floors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...errors import Diagnostic, SceneError, UwsimError
from ...model.body_names import object_body
from ...model.collision.scene_shapes import collision_shapes, simulated_solids
from ...model.placement import set_on_floor
from ...physics.free_objects import object_errors
from ..subjects import CheckedScene


def hydrodynamic_names(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return the errors in names of the hydrodynamics of a scene."""
    return scene.names.diagnostics


def object_shapes(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report objects of which the engine can make no collision shape, or that it cannot move."""
    dynamics, spec = scene.dynamics, scene.spec
    density = next(iter(dynamics.values())).density if dynamics else None
    for index, physics in simulated_solids(spec, dynamics).items():
        thing = spec.objects[index]
        try:
            made = collision_shapes(scene.resolved, (), {index: physics})
            if physics.is_loose:
                yield from object_errors(thing, physics, made[object_body(index)], density)
        except UwsimError as error:
            yield scene.error(thing, str(error).removesuffix("."), "physics")


def missing_floors(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return what of a scene is to stand on a floor that is not there."""
    try:
        set_on_floor(scene.resolved)
    except SceneError as error:
        return error.diagnostics
    except UwsimError:  # reported where robots and models are checked
        pass
    return ()
