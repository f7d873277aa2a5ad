"""What changes of the physics of a scene, as one record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.record import ExternalValue, Record, wrong_scene_error
from .actuation.vehicle_actuation import ActuationState
from .bounce_limit import BounceState
from .collision.contacts import EngineContactsState
from .engine_memory import EngineMemory
from .grips import GripsState
from .kinematics.lift import LiftState
from .poses import PosesState
from .uwsim_physics import UwsimPhysicsState

if TYPE_CHECKING:
    from .stepper import StepperState


class EngineFlags(ExternalValue):
    """What MuJoCo leaves out of a step: `islands` chooses it anew for every step.

    Args:
        model: of the engine.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model

    def value(self) -> int:
        """Return the flags."""
        return int(self._model.opt.disableflags)

    def set(self, value: object) -> None:
        """Set the flags."""
        if not isinstance(value, int):
            raise wrong_scene_error()
        self._model.opt.disableflags = value


@dataclass(slots=True)
class ModelState(Record):
    """The numbers of the engine's model that servos, grips, lifts and steps change."""

    link_places: Array
    """Where each body is on its parent, (nbody, 3) [m]."""
    stops: Array
    """The limits of each joint, (njnt, 2) [rad or m]."""
    gains: Array
    """The gains of each actuator, (nactuator, k)."""
    biases: Array
    """The biases of each actuator, (nactuator, k)."""
    welds: Array
    """The places of what is welded, (neq, k)."""
    shape_kinds: npt.NDArray[np.int32]
    """The kinds that each shape is of, as bits, (ngeom,)."""
    shape_touches: npt.NDArray[np.int32]
    """The kinds that each shape touches, as bits, (ngeom,)."""
    body_kinds: npt.NDArray[np.int32]
    """The kinds that the shapes of each body are of, as bits, (nbody,)."""
    body_touches: npt.NDArray[np.int32]
    """The kinds that the shapes of each body touch, as bits, (nbody,)."""
    flags: EngineFlags
    """What is left out of a step."""

    @staticmethod
    def of(model: mujoco.MjModel) -> ModelState:
        """Return the numbers of a model themselves."""
        return ModelState(
            link_places=model.body_pos,
            stops=model.jnt_range,
            gains=model.actuator_gainprm,
            biases=model.actuator_biasprm,
            welds=model.eq_data,
            shape_kinds=model.geom_contype,
            shape_touches=model.geom_conaffinity,
            body_kinds=model.body_contype,
            body_touches=model.body_conaffinity,
            flags=EngineFlags(model),
        )


@dataclass(slots=True)
class EngineState(Record):
    """What changes of the physics."""

    memory: EngineMemory
    """MuJoCo's numbers."""
    model: ModelState
    """The numbers of its model that change."""
    n_steps: int
    """The steps taken; one that failed counts."""
    actuation: dict[int, ActuationState]
    """What moves each simulated vehicle, by its number."""
    poses: PosesState
    """What changes of the frames."""
    grips: GripsState
    """What is held."""
    contacts: EngineContactsState
    """Whether the contacts hold."""
    lift: LiftState
    """How far bodies are lifted."""
    bounces: BounceState | None
    """What bounds the energy of objects that bounce."""
    stepper: StepperState | None
    """What the next step depends on."""
    uwsim_physics: UwsimPhysicsState | None
    """What the original's physics keeps."""
