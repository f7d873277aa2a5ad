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
from .hydrodynamics.columns import TURN, WATER_COLUMNS
from .hydrodynamics.hydrodynamics import Hydrodynamics
from .hydrodynamics.water_function import WATER_ROW, DriftFunction, WaterFunction

AUTOPILOT_PERIOD = 0.02
"""Period of the autopilots [s]."""

Ints = npt.NDArray[np.int64]


def _word(name: str) -> int:
    """How many words of a plan lie before a field."""
    return int(step_kernel.PLAN.fields[name][1]) // 8  # type: ignore[index]


_STEP, _SAMPLES, _AHEAD = map(_word, ("step", "samples", "ahead"))
_FLOW, _FLOW_PARAMETERS = map(_word, ("flow", "flow_parameters"))
_NEEDS_POINTS, _N_WATER = map(_word, ("needs_points", "n_water"))
_DRIFT, _DRIFT_PARAMETERS = map(_word, ("drift", "drift_parameters"))


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
        felt_at: where these feel it, in their axes, (n, 3) [m].
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
        felt_at: Array,
        check: StepCheck,
        bounces: BounceLimit | None,
    ) -> None:
        model = water.model
        self._bounces = bounces
        self._model, self._data, self._water, self._check = model, data, water, check
        self._plan = plan = np.zeros(1, step_kernel.PLAN)
        self._words = plan.view(np.int64).data  # a number is set faster there than in a field
        self._table: tuple[npt.NDArray[np.void] | None, int] = None, 0  # of samples; its address
        uses_callback = callback.has_slot()
        plan["model"], plan["data"] = model._address, data._address
        plan["is_in_middle"] = uses_callback
        plan["kinematics"] = callback.function_address("mj_kinematics")
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
        self._wet, self._felt_at = list(wet), np.ascontiguousarray(felt_at)
        self._rows = np.zeros((len(wet), WATER_ROW))  # of the water at these bodies
        plan["felt_at"], plan["water_rows"] = address_of(self._felt_at), address_of(self._rows)
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
        return self._words[_STEP]

    def run(
        self,
        n: int,
        first: int,
        water: WaterFunction | None,
        samples: npt.NDArray[np.void] | None = None,
        step: int = 0,
        *,
        samples_last: bool = False,
        drift: DriftFunction | None = None,
    ) -> bool:
        """Take steps.

        Args:
            n: how many.
            first: how many were taken before.
            water: how it moves at the bodies, which are placed; None: it is still.
            samples: taken after each step but the last, a record of `sampling.TABLE`, (1,).
            step: the number of the first step by the clock of the samples.
            samples_last: take them after the last step, too.
            drift: moves the vehicles that are not simulated; None: they stay.

        Returns:
            Whether a timer of the samples was due after the last step, and they were taken.

        Raises:
            SimulationFailed: MuJoCo warned, or a body moves faster than can be: what follows would
                not be true.
        """
        plan, words, model, data = self._plan, self._words, self._model, self._data
        if samples is not self._table[0]:
            self._table = samples, 0 if samples is None else address_of(samples)
        words[_STEP], words[_SAMPLES], words[_AHEAD] = first, self._table[1], step - 1 - first
        self._set_water(water, n)
        words[_DRIFT] = 0
        if drift is not None:
            words[_DRIFT], words[_DRIFT_PARAMETERS] = drift.function, drift.address
        advance = self._step
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
            words[_STEP] += 1
            self._check.fail(self.n_steps, found - step_kernel.TOO_FAST)
        return samples_last and bool(step_kernel.sample(plan))

    def _set_water(self, water: WaterFunction | None, n: int) -> None:
        """Let the water of the next steps move so; None: it is still."""
        words = self._words
        if water is not None:
            self.state.has_flow = True
            words[_FLOW], words[_FLOW_PARAMETERS] = water.function, water.address
            words[_NEEDS_POINTS], words[_N_WATER] = water.needs_points, 1 if water.is_steady else n
            return
        words[_NEEDS_POINTS] = words[_N_WATER] = 0
        if self.state.has_flow:
            self.state.has_flow = False
            at_bodies = self._data.userdata[: WATER_COLUMNS * self._model.nbody]
            rows = at_bodies.reshape(-1, WATER_COLUMNS)  # (bodies, columns)
            rows[self._wet, :6] = rows[self._wet, TURN : TURN + 3] = 0.0

    def _bound_and_begin(self, plan: npt.NDArray[np.void]) -> int:
        """Complete a step, bound what bounces, sample, and begin the next step."""
        assert self._bounces is not None
        found = int(step_kernel.end(plan))
        if found == step_kernel.WENT_WELL:
            self._bounces.apply()
            step_kernel.sample_and_begin(plan)
        return found


def _numbers(rows: Sequence[Sequence[int]]) -> Ints:
    return np.array(rows, dtype=np.int64).ravel()


def _places(model: mujoco.MjModel, joint: int) -> tuple[int, int]:
    return int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
