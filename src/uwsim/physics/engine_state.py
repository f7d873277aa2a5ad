"""The state of the physics of a scene, as one record."""

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
from .original_physics import OriginalPhysicsState
from .poses import PosesState

if TYPE_CHECKING:
    from .stepper import StepperState


class EngineFlags(ExternalValue):
    """The flags that disable parts of a step; `islands` sets one of them before every step.

    Args:
        model: the engine's model.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model

    def value(self) -> int:
        """Return MuJoCo's ``disableflags``."""
        return int(self._model.opt.disableflags)

    def set(self, value: object) -> None:
        """Set MuJoCo's ``disableflags``."""
        if not isinstance(value, int):
            raise wrong_scene_error()
        self._model.opt.disableflags = value


@dataclass(slots=True)
class ModelState(Record):
    """The numbers of the engine's model that servos, grips, lifts and steps change."""

    link_positions: Array
    """The position of each body in the frame of its parent, (nbody, 3) [m]."""
    stops: Array
    """The end stops of each joint, (njnt, 2) [rad or m]."""
    gains: Array
    """The gains of each actuator, (nactuator, k)."""
    biases: Array
    """The biases of each actuator, (nactuator, k)."""
    welds: Array
    """The parameters of each equality constraint, such as the relative pose of a weld, (neq, k)."""
    geom_contype: npt.NDArray[np.int32]
    """The collision bits of each shape, ``geom_contype``, (ngeom,)."""
    geom_conaffinity: npt.NDArray[np.int32]
    """The collision bits that each shape collides with, (ngeom,)."""
    body_contype: npt.NDArray[np.int32]
    """The collision bits of all shapes of each body, ``body_contype``, (nbody,)."""
    body_conaffinity: npt.NDArray[np.int32]
    """The collision bits that the shapes of each body collide with, (nbody,)."""
    flags: EngineFlags
    """The flags that disable parts of a step."""

    @staticmethod
    def from_model(model: mujoco.MjModel) -> ModelState:
        """Return views of the numbers of a model."""
        return ModelState(
            link_positions=model.body_pos,
            stops=model.jnt_range,
            gains=model.actuator_gainprm,
            biases=model.actuator_biasprm,
            welds=model.eq_data,
            geom_contype=model.geom_contype,
            geom_conaffinity=model.geom_conaffinity,
            body_contype=model.body_contype,
            body_conaffinity=model.body_conaffinity,
            flags=EngineFlags(model),
        )


@dataclass(slots=True)
class EngineState(Record):
    """The state of the physics."""

    memory: EngineMemory
    """The numbers of MuJoCo's data."""
    model: ModelState
    """The numbers of MuJoCo's model that change."""
    n_steps: int
    """The number of steps taken, including one that failed."""
    actuation: dict[int, ActuationState]
    """The actuation of each vehicle with dynamics, by index."""
    poses: PosesState
    """The validity of the computed poses, and the poses of bodies outside the engine."""
    grips: GripsState
    """The objects that are held."""
    contacts: EngineContactsState
    """The validity of the contacts."""
    lift: LiftState
    """The progress of lifted bodies."""
    bounces: BounceState | None
    """The energy limits of objects that bounce."""
    stepper: StepperState | None
    """The state of the stepper."""
    original_physics: OriginalPhysicsState | None
    """The state of the physics of UWSim; None if the scene does not use it."""
