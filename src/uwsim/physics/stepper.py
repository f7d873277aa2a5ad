"""The time loop of a scene with simulated vehicles, with compiled code between MuJoCo's steps.

MuJoCo's own step is called through its bindings, which turn its errors into exceptions; all else of
a step is two calls into `step_kernel`, or one between two steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import address_of
from ..base.record import Record
from . import step_kernel
from .actuation.autopilot import Autopilot
from .actuation.servos import Servos
from .bounce_limit import BounceLimit
from .engine_warnings import StepCheck
from .hydrodynamics import callback
from .hydrodynamics.hydrodynamics import Hydrodynamics

AUTOPILOT_PERIOD = 0.02
"""Period of the autopilots [s]."""

Ints = npt.NDArray[np.int64]


@dataclass(slots=True)
class StepperState(Record):
    """What the next step depends on, besides the engine's numbers."""

    has_flow: bool = False
    """Whether the water moved in the last step."""


class Stepper:
    """Takes the steps of one engine.

    Args:
        data: the engine's state.
        water: around its bodies.
        autopilots: of the simulated vehicles.
        servos: of their joints.
        placed: joints of the vehicles that stay where they are put.
        wet: bodies whose water is set.
        check: says what is wrong with a step.
        bounces: bounds the energy of objects that bounce; None where none does.
    """

    def __init__(
        self,
        data: mujoco.MjData,
        water: Hydrodynamics,
        autopilots: Sequence[Autopilot],
        servos: Sequence[Servos],
        placed: Sequence[int],
        wet: Sequence[int],
        check: StepCheck,
        bounces: BounceLimit | None,
    ) -> None:
        model = water.model
        self._bounces = bounces
        self._model, self._data, self._water, self._check = model, data, water, check
        self._plan = plan = np.zeros(1, step_kernel.PLAN)
        uses_callback = callback.has_slot()
        plan["model"], plan["data"] = model._address, data._address
        plan["is_in_middle"] = uses_callback
        plan["kinematics"] = callback.kinematics_address()
        plan["autopilot_steps"] = max(1, round(AUTOPILOT_PERIOD / model.opt.timestep))
        plan["timestep"] = model.opt.timestep
        self._kept = {
            "offsets": (callback.offsets(), 1),
            "autopilots": (_numbers([each.addresses for each in autopilots]), 5),
            "servos": (_numbers([each.addresses for each in servos]), 3),
            "placed": (_numbers([_places(model, joint) for joint in placed]), 2),
            "speeds": (check.speeds, 3),
            "wet": (_numbers([list(wet)]), 1),
        }
        for name, (numbers, width) in self._kept.items():
            plan[name], plan[f"n_{name}"] = numbers.ctypes.data, numbers.size // width
        self._poses = np.zeros(7 * len(placed))
        plan["poses"] = self._poses.ctypes.data
        counters = check.counters
        plan["warnings"], plan["n_warnings"] = counters.ctypes.data, len(counters)
        plan["stride"] = counters.strides[0]
        self._n_wet = len(wet)
        self.state = StepperState()
        """What the next step depends on."""
        self._step: Callable[[mujoco.MjModel, mujoco.MjData], None] = (
            mujoco.mj_step if uses_callback else lambda _, data: water.step_without_callback(data)
        )
        self._uses_callback = uses_callback
        self._end_and_begin: Callable[[npt.NDArray[np.void]], int] = step_kernel.end_and_begin
        if bounces is not None:
            self._end_and_begin = self._bound_and_begin

    @property
    def n_steps(self) -> int:
        """Steps taken since the beginning; one that failed counts."""
        return int(self._plan["step"][0])

    def run(
        self,
        n: int,
        first: int,
        motion: Array | None,
        samples: npt.NDArray[np.void] | None = None,
        step: int = 0,
        *,
        samples_last: bool = False,
    ) -> bool:
        """Take steps.

        Args:
            n: how many.
            first: how many were taken before.
            motion: of the water at the bodies in each step, velocity [m/s], acceleration [m/s2] and
                rotation [rad/s] in W, (n, m, 9); one row counts for all; None: it is still.
            samples: taken after each step but the last, a record of `sampling.TABLE`, (1,).
            step: the number of the first step by the clock of the samples.
            samples_last: take them after the last step, too.

        Returns:
            Whether a timer of the samples was due after the last step, and they were taken.

        Raises:
            SimulationFailed: MuJoCo warned, or a body moves faster than can be: what follows would
                not be true.
        """
        if motion is None and self.state.has_flow:
            motion = np.zeros((1, self._n_wet, step_kernel.ROW))
            self.state.has_flow = False
        elif motion is not None:
            self.state.has_flow = True
        plan, model, data, advance = self._plan, self._model, self._data, self._step
        plan["step"] = first
        plan["samples"] = 0 if samples is None else address_of(samples)
        plan["ahead"] = step - 1 - first
        plan["water"] = 0 if motion is None else motion.ctypes.data
        plan["n_water"] = 0 if motion is None else len(motion)
        if self._uses_callback:
            callback.install()  # mj_resetCallbacks may have emptied the slot
        step_kernel.begin(plan)
        found = step_kernel.WENT_WELL
        for _ in range(n - 1):
            advance(model, data)
            found = self._end_and_begin(plan)
            if found != step_kernel.WENT_WELL:
                break
        else:
            advance(model, data)
            found = step_kernel.end(plan)
            if self._bounces is not None and found == step_kernel.WENT_WELL:
                self._bounces.apply()
        if found != step_kernel.WENT_WELL:
            plan["step"] += 1
            self._check.fail(self.n_steps, found - step_kernel.TOO_FAST)
        return samples_last and bool(step_kernel.sample(plan))

    def _bound_and_begin(self, plan: npt.NDArray[np.void]) -> int:
        """Complete a step, bound what bounces, sample, and begin the next step."""
        assert self._bounces is not None
        found = int(step_kernel.end(plan))
        if found == step_kernel.WENT_WELL:
            self._bounces.apply()
            step_kernel.sample(plan)
            step_kernel.begin(plan)
        return found


def _numbers(rows: Sequence[Sequence[int]]) -> Ints:
    return np.array(rows, dtype=np.int64).ravel()


def _places(model: mujoco.MjModel, joint: int) -> tuple[int, int]:
    return int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
