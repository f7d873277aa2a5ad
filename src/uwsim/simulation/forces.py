"""The forces of a scene: their binding, and the wrenches for the engine in each step."""

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
        SceneError: a force names a missing body; the error has the line of the force in the file.
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
    """Yield the wrenches of a step that begins at ``time`` [s], for `Engine.apply_wrenches`.

    Raises:
        SimulationFailed: a force raises an exception, or returns something else than pairs of an
            attachment and six numbers.
        UwsimError: a force acts on an object that is not an attachment of the scene.
    """
    for spec, force in forces:
        return_value: object = None
        try:
            return_value = pairs = force.wrenches(time)
            for attachment, values in pairs:
                wrench = np.asarray(values)
                if not isinstance(attachment, SceneAttachment):
                    raise UwsimError(
                        f"{_describe_force(spec)} acts on a {type(attachment).__name__} at "
                        f"{time:.6g} s; expected what attach() of its ForceWorld has returned."
                    )
                if (
                    wrench.shape != (6,)
                    or wrench.dtype.kind not in "biuf"
                    or not np.isfinite(wrench).all()
                ):
                    raise SimulationFailed(
                        f"{_describe_force(spec)} acts on {attachment.name!r} with "
                        f"{short_repr(wrench.tolist())} at {time:.6g} s; expected six finite "
                        "numbers [N, N m]."
                    )
                if attachment.engine_body is not None:
                    yield attachment.engine_body, attachment.position_on_body, wrench
        except (Exception, SystemExit) as error:  # errors of third-party code
            if isinstance(error, UwsimError) and not _is_inside_force(error):
                raise
            raise _make_failure(spec, return_value, error, time) from error


def _make_failure(
    spec: ForceSpec, return_value: object, error: BaseException, time: float
) -> SimulationFailed:
    """Return the error for an exception of a force, or for a return value of another type."""
    if _is_inside_force(error):
        return SimulationFailed(
            f"{_describe_force(spec)} raised {type_and_text(error)} at {time:.6g} s."
        )
    return SimulationFailed(
        f"{_describe_force(spec)} returned {short_repr(return_value)} at {time:.6g} s; expected "
        f"pairs of an attachment and six finite numbers [N, N m] ({type_and_text(error)})."
    )


def _is_inside_force(error: BaseException) -> bool:
    """Return whether code called by `engine_wrenches` raised an error, not its own lines."""
    return error.__traceback__ is not None and error.__traceback__.tb_next is not None


def _describe_force(spec: ForceSpec) -> str:
    """Return the name of a force with its element, or with its class if it has no element."""
    elements = [f"<u:{element}>" for element, kind in FORCES.items() if type(spec) is kind]
    return f"The force {spec.name!r} ({elements[0] if elements else type(spec).__name__})"
