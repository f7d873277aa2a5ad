"""A vector of environments whose rows compiled code steps together: for training.

The observations, actions and rewards are those of `BenchmarkEnv`, and the physics, currents and
waves included, agree with the engine to 1e-10. Not as in the benchmark: the measures are not
computed. A trained policy is scored by ``uwsim bench``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from ..base.geometry import Array
from ..benchmark.environment import RewardFunction
from ..benchmark.environment.channels import CHANNELS, VehicleState, to_base
from ..benchmark.environment.observer import MAX_OBSERVATION, limit_numbers
from ..benchmark.environment.reward import magnitude
from ..benchmark.updaters import Level
from ..errors import BadSetting
from ..physics.hydrodynamics.water_function import WaterFunction
from ..runs.planning.plan import Plan
from ..runs.planning.trial_cache import compile_plan
from .batch.rows import Rows
from .batch.task import Channel, RowTask, Term
from .benchmark_env import MAX_SEED
from .levels import Value, draw_level, read_choices
from .row_task import plan_rows

Flags = npt.NDArray[np.bool_]
NO_EXIT = 1e9
"""The distance at which an episode ends [m]: never."""


class RowVectorEnv(VectorEnv):  # type: ignore[misc]  # mypy skips gymnasium
    """Rows of an environment, stepped together by compiled code.

    Row i after ``reset(seed=s)`` has the bytes of the only row after ``reset(seed=s + i)``.

    Args:
        plan: the plan of the environment.
        num_envs: the number of rows.
        threads: the number of threads; it has no effect on the results.
        autoreset_mode: ``NextStep``, ``SameStep`` or ``Disabled``.

    Raises:
        BadSetting: rows cannot step the environment; the message has the reasons.
    """

    def __init__(
        self,
        plan: Plan,
        num_envs: int,
        *,
        threads: int = 1,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
    ) -> None:
        self._plan, self.num_envs = plan, num_envs
        self._task = plan_rows(plan, compile_plan(plan, 0))
        task, n_actions = self._task, len(self._task.vehicle.actuators)
        row_task = RowTask(
            channels=(Channel(name="position"),),
            terms=(Term(name="constant", weight=0.0),),
            timestep=plan.timestep,
            substeps=task.substeps,
            max_steps=task.max_steps,
            exit_distance=NO_EXIT,
        )
        self._rows = Rows(task.vehicle, row_task, num_envs, threads=threads)
        self._mode = AutoresetMode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": self._mode}
        sizes = [
            n_actions if CHANNELS[name][0] is None else CHANNELS[name][0]
            for name in task.spec.channels
        ]
        size = sum(size or 0 for size in sizes)
        self.single_observation_space = Box(-MAX_OBSERVATION, MAX_OBSERVATION, (size,), np.float64)
        self.single_action_space = Box(-1.0, 1.0, (n_actions,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._generators: list[np.random.Generator | None] = [None] * num_envs
        self._seeds = np.zeros(num_envs, np.int64)
        self._levels: dict[str, Array] = {}
        self._last_actions = np.zeros((num_envs, n_actions))
        self._square_sums = np.zeros(num_envs)  # of the distance over the episode [m2]
        self._rows_to_reset = np.ones(num_envs, np.bool_)
        names = [measure.name for measure in plan.benchmark.measures]
        self._reward = RewardFunction(task.spec.reward, names, self._state())

    @property
    def stepper(self) -> str:
        """The stepper of the rows, and the reason for it."""
        return "rows: one free vehicle, thrusters as actions, the state as observation"

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Array, dict[str, Any]]:
        """Begin episodes of all rows, or of those of ``options["reset_mask"]``.

        Args:
            seed: the seed of the first row; the next row has the next seed; or one for each row.
            options: ``{"level": {...}}`` as for `BenchmarkEnv`, and ``reset_mask`` (n,).
        """
        options = dict(options or {})
        mask = np.array(options.pop("reset_mask", np.ones(self.num_envs)), dtype=np.bool_)
        if mask.shape != (self.num_envs,):
            raise BadSetting(f"reset_mask has the shape {mask.shape}; expected {self.num_envs}.")
        choices = read_choices(self._plan.benchmark.scene_updater, options, has_paths=False)
        seeds = (
            list(seed)
            if isinstance(seed, Sequence)
            else [None if seed is None else seed + i for i in range(self.num_envs)]
        )
        self._begin(mask, seeds, choices)
        return self._observe(), self._infos(mask)

    def step(self, actions: npt.ArrayLike) -> tuple[Array, Array, Flags, Flags, dict[str, Any]]:
        """Take a step with each row; rows whose episode is over begin a new one (`NEXT_STEP`)."""
        values = np.clip(np.asarray(actions, dtype=np.float64), -1.0, 1.0)
        if values.shape != self._last_actions.shape or not np.isfinite(values).all():
            raise BadSetting(
                f"The actions have the shape {values.shape}; expected {self._last_actions.shape}, "
                "finite numbers."
            )
        resets = self._rows_to_reset.copy()
        if self._mode is AutoresetMode.DISABLED and resets.any():
            raise BadSetting("An episode is over; call reset(options={'reset_mask': ...}) first.")
        infos: dict[str, Any] = {}
        if resets.any():
            self._begin(resets, [None] * self.num_envs, {})
            infos |= self._infos(resets)
        steps = ~resets
        self._rows.step(values, mask=steps)
        rewards = self._score(values, steps)
        truncated = self._rows.truncated & steps
        self._rows_to_reset = truncated.copy()
        observations = self._observe()
        if truncated.any():
            infos = self._end(infos, observations, truncated)
            if self._mode is AutoresetMode.SAME_STEP:
                self._begin(truncated, [None] * self.num_envs, {})
                observations = self._observe()
                infos |= self._infos(truncated)
        return observations, rewards, np.zeros_like(truncated), truncated, infos

    def close_extras(self, **options: object) -> None:
        """End the threads."""
        self._rows.close()

    def _begin(
        self, mask: Flags, seeds: Sequence[int | None], choices: Mapping[str, Value]
    ) -> None:
        """Begin episodes of some rows."""
        row_seeds: list[int | None] = [None] * self.num_envs
        starts: list[tuple[int, Array, Array, WaterFunction | None]] = []
        for i in np.flatnonzero(mask).tolist():
            seed, generator = seeds[i], self._generators[i]
            if seed is not None or generator is None:
                generator, _ = seeding.np_random(seed)
                self._generators[i] = generator
            if seed is None:
                seed = int(generator.integers(MAX_SEED))
            level = draw_level(self._plan.benchmark.scene_updater, seed, choices)
            self._set_level(i, level)
            row_seeds[i], self._seeds[i] = seed, seed
            starts.append((i, *self._task.start(seed), self._task.water.function(seed, level)))
        self._rows.reset(mask, row_seeds)
        for i, position, attitude, water in starts:
            self._rows.states[i, :3], self._rows.states[i, 3:7] = position, attitude
            self._rows.set_water(i, water)
        self._last_actions[mask], self._square_sums[mask] = 0.0, 0.0
        self._rows_to_reset[mask] = False
        if hasattr(self, "_reward"):
            self._reward.restart(mask, self._state())

    def _set_level(self, row: int, level: Level) -> None:
        for name, value in level.values:
            self._levels.setdefault(name, np.zeros(self.num_envs))[row] = value

    def _state(self) -> VehicleState:
        """Return the present states of all rows."""
        states, frame = self._rows.states, self._task.world_from_localized.inverse()
        world_from_base = rotations_of(states[:, 3:7])
        n_steps: Array = self._rows.steps.astype(np.float64) * self._task.substeps
        times: Array = n_steps * self._plan.timestep
        twist = np.concatenate([to_base(world_from_base, states[:, 7:10]), states[:, 10:13]], -1)
        return VehicleState(
            position=to_base(frame.rotation.T, states[:, :3]) + frame.position,
            localized_from_base=_rotate_frames(frame.rotation, world_from_base),
            world_from_base=world_from_base,
            twist=twist,
            reference_position=self._task.trajectory.position(times),
            reference_motion=self._task.trajectory.velocity(times),
            time=times,
            last_action=self._last_actions,
        )

    def _observe(self) -> Array:
        state = self._state()
        return limit_numbers([CHANNELS[name][1](state) for name in self._task.spec.channels])

    def _score(self, actions: Array, steps: Flags) -> Array:
        """Return the rewards of the rows that took a step, 0 for others."""
        state = self._state()
        distance = magnitude(state.reference_position - state.position)
        self._square_sums += np.where(steps, distance * distance, 0.0)
        samples = {self._task.spec.reference or "": distance}
        rewards = np.where(steps, self._reward.compute_rows(samples, state, actions), 0.0)
        self._last_actions = np.where(steps[:, None], actions, self._last_actions)
        return rewards

    def _infos(self, mask: Flags) -> dict[str, Any]:
        """Return the seeds and the levels of the rows that begin an episode."""
        level: dict[str, Any] = {}
        for name, values in self._levels.items():
            level[name], level[f"_{name}"] = values.copy(), mask.copy()
        return {
            "seed": self._seeds.copy(),
            "_seed": mask.copy(),
            "level": level,
            "_level": mask.copy(),
        }

    def _end(self, infos: dict[str, Any], observations: Array, truncated: Flags) -> dict[str, Any]:
        """Return ``infos`` with the results of the rows whose episode is over."""
        rms = np.sqrt(self._square_sums / self._task.max_steps)
        result = {"rms_error": np.where(truncated, rms, 0.0), "_rms_error": truncated.copy()}
        if self._mode is not AutoresetMode.SAME_STEP:
            return infos | result
        final_obs = np.full(self.num_envs, None, dtype=object)
        for i in np.flatnonzero(truncated).tolist():
            final_obs[i] = observations[i].copy()
        return infos | {
            "final_obs": final_obs,
            "_final_obs": truncated.copy(),
            "final_info": result,
            "_final_info": truncated.copy(),
        }


def rotations_of(quaternions: Array) -> Array:
    """Return the rotations (n, 3, 3) of quaternions wxyz (n, 4)."""
    w, x, y, z = (quaternions[:, i] for i in range(4))
    rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _rotate_frames(rotation: Array, frames: Array) -> Array:
    """Return ``rotation @ frame`` for frames (n, 3, 3)."""
    columns = [to_base(rotation.T, frames[:, :, i]) for i in range(3)]
    return np.stack(columns, axis=-1)
