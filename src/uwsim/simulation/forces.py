"""The forces of a scene: bound to it, and given to the engine in each step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..base.geometry import Array
from ..errors import (
    SceneError,
    SimulationFailed,
    UnknownName,
    UwsimError,
    short_repr,
    type_and_text,
)
from ..forces import FORCES, Force, ForceSpec
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


def engine_wrenches(
    forces: Sequence[tuple[ForceSpec, Force]], time: float
) -> Iterator[tuple[int, Array, Array]]:
    """Return the wrenches of forces in the step that begins at ``time`` [s], as `Engine.apply_wrenches` does.

    Raises:
        SimulationFailed: a force raises, or gives no pairs of an attachment and six numbers.
        UwsimError: a force acts on what is no attachment of the scene.
    """
    for spec, force in forces:
        returned: object = None
        try:
            returned = pairs = force.wrenches(time)
            for attachment, given in pairs:
                wrench = np.asarray(given)
                if not isinstance(attachment, SceneAttachment):
                    raise UwsimError(
                        f"{_shown_force(spec)} acts on a {type(attachment).__name__} at "
                        f"{time:.6g} s; expected what attach() of its ForceWorld has returned."
                    )
                if (
                    wrench.shape != (6,)
                    or wrench.dtype.kind not in "biuf"
                    or not np.isfinite(wrench).all()
                ):
                    raise SimulationFailed(
                        f"{_shown_force(spec)} acts on {attachment.name!r} with "
                        f"{short_repr(wrench.tolist())} at {time:.6g} s; expected six finite "
                        "numbers [N, N m]."
                    )
                if attachment.engine_body is not None:
                    yield attachment.engine_body, attachment.on_body, wrench
        except (Exception, SystemExit) as error:  # errors of third-party code
            if isinstance(error, UwsimError) and not _is_inside_force(error):
                raise
            raise _failed(spec, returned, error, time) from error


def _failed(
    spec: ForceSpec, returned: object, error: BaseException, time: float
) -> SimulationFailed:
    """Return the error for what a force has raised, or for what it gives being no pairs."""
    if _is_inside_force(error):
        return SimulationFailed(
            f"{_shown_force(spec)} raised {type_and_text(error)} at {time:.6g} s."
        )
    return SimulationFailed(
        f"{_shown_force(spec)} returned {short_repr(returned)} at {time:.6g} s; expected pairs of "
        f"an attachment and six finite numbers [N, N m] ({type_and_text(error)})."
    )


def _is_inside_force(error: BaseException) -> bool:
    """Whether code that `engine_wrenches` has called raised an error, not its own lines."""
    return error.__traceback__ is not None and error.__traceback__.tb_next is not None


def _shown_force(spec: ForceSpec) -> str:
    """Return the name of a force and its element, or its class where it has none."""
    elements = [f"<u:{element}>" for element, kind in FORCES.items() if type(spec) is kind]
    return f"The force {spec.name!r} ({elements[0] if elements else type(spec).__name__})"
