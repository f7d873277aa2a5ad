"""The time loop of a scene with vehicles with dynamics.

MuJoCo's step is called through its Python bindings, which convert its errors to exceptions. All
other parts of a step are compiled (`step_kernel`): one call between two steps, one before the first
and one after the last.
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
from .hydrodynamics.columns import OMEGA, WATER_COLUMNS
from .hydrodynamics.hydrodynamics import Hydrodynamics
from .hydrodynamics.water_function import WATER_ROW_LENGTH, DriftFunction, WaterFunction

AUTOPILOT_PERIOD = 0.02
"""The period of the autopilots [s]."""

Ints = npt.NDArray[np.int64]


def _word(name: str) -> int:
    """Return the index of a field in a record of `step_kernel.PLAN`, in words of 8 bytes."""
    return int(step_kernel.PLAN.fields[name][1]) // 8  # type: ignore[index]


_STEP, _SAMPLES, _OFFSET = map(_word, ("step", "samples", "step_offset"))
_FLOW, _FLOW_PARAMETERS = map(_word, ("flow", "flow_parameters"))
_NEEDS_POINTS, _N_WATER = map(_word, ("needs_points", "n_water"))
_USES_SUBMERGED_CENTRE = _word("uses_submerged_centre")
_DRIFT, _DRIFT_PARAMETERS = map(_word, ("drift", "drift_parameters"))


@dataclass(slots=True)
class StepperState(Record):
    """The state of a stepper, besides the state of the engine."""

    has_flow: bool = False
    """True if the water moved in the last step."""


class Stepper:
    """The time loop of one engine.

    Args:
        data: the engine's state.
        water: the hydrodynamics of the engine.
        autopilots: the autopilots of the vehicles with dynamics.
        servos: the servos of the vehicles with dynamics.
        kinematic_joints: the free joints of the kinematic vehicles.
        submerged_bodies: the MuJoCo IDs of the n bodies that the water acts on.
        reference_points: the points at which the water acts, in body axes, (n, 3) [m].
        check: the checks after a step.
        bounce_limit: the limit on the energy of objects that bounce; None if no object does.
    """

    def __init__(
        self,
        data: mujoco.MjData,
        water: Hydrodynamics,
        autopilots: Sequence[Autopilot],
        servos: Sequence[Servos],
        kinematic_joints: Sequence[int],
        submerged_bodies: Sequence[int],
        reference_points: Array,
        check: StepCheck,
        bounce_limit: BounceLimit | None,
    ) -> None:
        model = water.model
        self._bounce_limit = bounce_limit
        self._model, self._data, self._water, self._check = model, data, water, check
        self._plan = plan = np.zeros(1, step_kernel.PLAN)
        self._words = plan.view(np.int64).data  # setting a number is faster there than in a field
        self._table: tuple[npt.NDArray[np.void] | None, int] = None, 0  # of samples; its address
        uses_callback = callback.has_slot()
        plan["model"], plan["data"] = model._address, data._address
        plan["uses_midpoint"] = uses_callback
        plan["kinematics"] = callback.function_address("mj_kinematics")
        plan["autopilot_steps"] = max(1, round(AUTOPILOT_PERIOD / model.opt.timestep))
        plan["timestep"] = model.opt.timestep
        self._arrays = {
            "offsets": (callback.offsets(), 1),
            "autopilots": (_flatten([part.addresses for part in autopilots]), 5),
            "servos": (_flatten([part.addresses for part in servos]), 3),
            "kinematic_bodies": (
                _flatten([_addresses(model, joint) for joint in kinematic_joints]),
                2,
            ),
            "speeds": (check.speeds, 3),
            "submerged_bodies": (_flatten([list(submerged_bodies)]), 1),
        }
        for name, (numbers, width) in self._arrays.items():
            plan[name], plan[f"n_{name}"] = numbers.ctypes.data, numbers.size // width
        self._poses = np.zeros(7 * len(kinematic_joints))
        plan["poses"] = self._poses.ctypes.data
        counters = check.counters
        plan["warnings"], plan["n_warnings"] = counters.ctypes.data, len(counters)
        plan["warning_stride"] = counters.strides[0]
        self._bodies, self._points = list(submerged_bodies), np.ascontiguousarray(reference_points)
        self._rows = np.zeros((len(submerged_bodies), WATER_ROW_LENGTH))  # the water's motion
        plan["points"], plan["water_rows"] = address_of(self._points), address_of(self._rows)
        self.state = StepperState()
        """The state of the stepper."""
        self._step: Callable[[mujoco.MjModel, mujoco.MjData], None] = (
            mujoco.mj_step if uses_callback else lambda _, data: water.step_without_callback(data)
        )
        self._uses_callback = uses_callback
        self._end_and_begin: Callable[[npt.NDArray[np.void]], int] = step_kernel.end_and_begin
        if bounce_limit is not None:
            self._end_and_begin = self._limit_and_begin

    @property
    def n_steps(self) -> int:
        """The number of steps taken since the beginning, including one that failed."""
        return self._words[_STEP]

    def run(
        self,
        n: int,
        n_0: int,
        water: WaterFunction | None,
        samples: npt.NDArray[np.void] | None = None,
        step: int = 0,
        *,
        samples_last: bool = False,
        drift: DriftFunction | None = None,
    ) -> bool:
        """Take some steps.

        Args:
            n: the number of steps.
            n_0: the number of steps taken before.
            water: the motion of the water at the bodies, whose frames must be up to date; None in
                still water.
            samples: the samples to take after each step but the last, a record of
                `sampling.TABLE`, (1,).
            step: the number of the first step, as the timers of the samples count steps.
            samples_last: take samples after the last step, too.
            drift: moves the kinematic vehicles with the water; None: they do not drift.

        Returns:
            True if a timer of the samples was due after the last step, and they were taken.

        Raises:
            SimulationFailed: MuJoCo warned, or a body exceeds its speed limit, so that results
                would be invalid.
        """
        plan, words, model, data = self._plan, self._words, self._model, self._data
        if samples is not self._table[0]:
            self._table = samples, 0 if samples is None else address_of(samples)
        words[_STEP], words[_SAMPLES], words[_OFFSET] = n_0, self._table[1], step - 1 - n_0
        self._set_water(water, n)
        words[_DRIFT] = 0
        if drift is not None:
            words[_DRIFT], words[_DRIFT_PARAMETERS] = drift.function, drift.address
        advance = self._step
        if self._uses_callback:
            callback.install()  # mj_resetCallbacks may have emptied the slot
        step_kernel.begin_step(plan)
        outcome = step_kernel.STEP_OK
        for _ in range(n - 1):
            advance(model, data)
            outcome = self._end_and_begin(plan)
            if outcome != step_kernel.STEP_OK:
                break
        else:
            advance(model, data)
            outcome = step_kernel.end_step(plan)
            if self._bounce_limit is not None and outcome == step_kernel.STEP_OK:
                self._bounce_limit.apply()
        if outcome != step_kernel.STEP_OK:
            words[_STEP] += 1
            self._check.fail(self.n_steps, outcome - step_kernel.EXCESS_SPEED)
        return samples_last and bool(step_kernel.sample(plan))

    def _set_water(self, water: WaterFunction | None, n: int) -> None:
        """Set the function of the water's motion for the next n steps; None in still water."""
        words = self._words
        if water is not None:
            self.state.has_flow = True
            words[_FLOW], words[_FLOW_PARAMETERS] = water.function, water.address
            words[_NEEDS_POINTS], words[_N_WATER] = water.needs_points, 1 if water.is_steady else n
            words[_USES_SUBMERGED_CENTRE] = water.uses_submerged_centre
            return
        words[_NEEDS_POINTS] = words[_N_WATER] = 0
        if self.state.has_flow:
            self.state.has_flow = False
            at_bodies = self._data.userdata[: WATER_COLUMNS * self._model.nbody]
            rows = at_bodies.reshape(-1, WATER_COLUMNS)  # (bodies, columns)
            rows[self._bodies, :6] = rows[self._bodies, OMEGA : OMEGA + 3] = 0.0

    def _limit_and_begin(self, plan: npt.NDArray[np.void]) -> int:
        """Complete a step, limit the energy of bounces, sample, and begin the next step."""
        assert self._bounce_limit is not None
        outcome = int(step_kernel.end_step(plan))
        if outcome == step_kernel.STEP_OK:
            self._bounce_limit.apply()
            step_kernel.sample_and_begin(plan)
        return outcome


def _flatten(rows: Sequence[Sequence[int]]) -> Ints:
    return np.array(rows, dtype=np.int64).ravel()


def _addresses(model: mujoco.MjModel, joint: int) -> tuple[int, int]:
    return int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
