"""The forces of a scene: bound to it, and given to the engine in each step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..base.geometry import Array
from ..errors import SceneError, SimulationFailed, UnknownName, UwsimError
from ..forces import Force
from ..schema import diagnostic_at
from .physical_scene import PhysicalScene
from .world_views.force_view import ForceView, SceneAttachment


def bind_forces(scene: PhysicalScene) -> tuple[Force, ...]:
    """Bind the forces of a scene.

    Raises:
        SceneError: one names a body that is not there; with its line.
    """
    if not scene.model.scene.forces:
        return ()
    forces, world = [], ForceView(scene)
    for spec in scene.model.scene.forces:
        try:
            forces.append(spec.bind(world))
        except UnknownName as error:
            if spec.source_line is None:
                raise
            raise SceneError([diagnostic_at(spec, f"the force {spec.name!r}: {error}")]) from error
    return tuple(forces)


def engine_wrenches(forces: Sequence[Force], time: float) -> Iterator[tuple[int, Array, Array]]:
    """Return the wrenches of forces in the step that begins at ``time`` [s], as `Engine.push` does.

    Raises:
        SimulationFailed: a force is no number.
        UwsimError: a force acts on what is no attachment of the scene.
    """
    for force in forces:
        for attachment, wrench in force.wrenches(time):
            if np.shape(wrench) != (6,) or not np.isfinite(wrench).all():
                raise SimulationFailed(
                    f"{type(force).__name__} acts on {attachment.name!r} with "
                    f"{np.asarray(wrench).tolist()} at {time:.6g} s; expected six finite numbers "
                    "[N, N m]."
                )
            if not isinstance(attachment, SceneAttachment):
                raise UwsimError(
                    f"{type(force).__name__} acts on a {type(attachment).__name__}; expected what "
                    "attach() of its ForceWorld has returned."
                )
            if attachment.engine_body is not None:
                yield attachment.engine_body, attachment.on_body, wrench
