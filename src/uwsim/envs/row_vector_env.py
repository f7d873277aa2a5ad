"""A vector of environments whose rows compiled code steps together: for training.

Observations, actions, rewards and the measures of position and energy are those of `BenchmarkEnv`,
with the same seeds, levels, currents and waves; they agree with the engine to 1e-10. Row i is the
single environment with ``stepper="rows"``, to the bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from numbers import Integral
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from ..base.geometry import Array
from ..base.numerics.named_draws import seed_array
from ..benchmark.environment.observer import MAX_OBSERVATION
from ..errors import BadSetting, did_you_mean, short_repr
from ..runs.planning.plan import Plan
from .actions import read_action_values
from .benchmark_env import MAX_SEED
from .compiled.episodes import Episodes
from .levels import Value, check_options, read_choices
from .steppers import ROWS

Flags = npt.NDArray[np.bool_]
EPISODE_IS_OVER = "An episode is over; call reset(options={'reset_mask': ...})."
"""The error of a step without automatic resets."""


def read_vector_options(num_envs: object, autoreset_mode: object) -> AutoresetMode:
    """Check the number of rows, and return the mode of automatic resets.

    Raises:
        BadSetting: the number is no whole number from 1 on, or there is no such mode.
    """
    if not isinstance(num_envs, Integral) or int(num_envs) < 1:
        raise BadSetting(f"num_envs is {short_repr(num_envs)}; expected a whole number from 1 on.")
    modes = [mode.value for mode in AutoresetMode]
    if not isinstance(autoreset_mode, AutoresetMode) and autoreset_mode not in modes:
        raise BadSetting(
            f"autoreset_mode is {short_repr(autoreset_mode)}; expected {', '.join(modes)}."
            f"{did_you_mean(str(autoreset_mode), modes)}"
        )
    return AutoresetMode(autoreset_mode)


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
        mode = read_vector_options(num_envs, autoreset_mode)
        self._updater, self.num_envs = plan.benchmark.scene_updater, num_envs
        self._episodes = Episodes(plan, num_envs, threads=threads)
        self._mode = mode
        self.metadata = {"render_modes": [], "autoreset_mode": self._mode}
        self.layout = self._episodes.layout
        """The name and the size of each part of an observation, in order."""
        size, n_actions = sum(n for _, n in self.layout), self._episodes.n_actions
        self.single_observation_space = Box(-MAX_OBSERVATION, MAX_OBSERVATION, (size,), np.float64)
        self.single_action_space = Box(-1.0, 1.0, (n_actions,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._row_seeds: list[int | None] = [None] * num_envs  # of generators not yet created
        self._generators: list[np.random.Generator | None] = [None] * num_envs
        self._choices: list[Mapping[str, Value]] = [{}] * num_envs  # of the last reset of a row
        self._rows_to_reset = np.ones(num_envs, np.bool_)
        self._is_new = True  # no episode was begun

    @property
    def stepper(self) -> str:
        """The stepper of the rows, and the reason for it."""
        return ROWS

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Array, dict[str, Any]]:
        """Begin episodes of all rows, or of those of ``options["reset_mask"]``.

        Args:
            seed: the seed of the first row; the next row has the next seed; or one for each row.
            options: ``{"level": {...}}`` as for `BenchmarkEnv`, and ``reset_mask`` (n,). Automatic
                resets keep the level.
        """
        options = dict(check_options(options))
        mask = _read_mask(options.pop("reset_mask", None), self.num_envs)
        choices = read_choices(self._updater, options, has_paths=False)
        self._begin(mask, _read_seeds(seed, self.num_envs), choices)
        self._is_new = False
        for i in np.flatnonzero(mask).tolist():
            self._choices[i] = choices
        return self._episodes.arrays.observations.copy(), self._infos(mask)

    def step(self, actions: npt.ArrayLike) -> tuple[Array, Array, Flags, Flags, dict[str, Any]]:
        """Take a step with each row; rows whose episode is over begin a new one (`NEXT_STEP`)."""
        if self._is_new:
            raise gymnasium.error.ResetNeeded("No episode is running; call reset() first.")
        values = read_action_values(actions, self.action_space.shape, "The array of actions")
        resets = self._rows_to_reset
        infos: dict[str, Any] = {}
        if resets.any():
            if self._mode is AutoresetMode.DISABLED:
                raise BadSetting(EPISODE_IS_OVER)
            self._begin_again(resets)
            infos = self._infos(resets)
        self._episodes.step(values, ~resets)
        arrays = self._episodes.arrays
        rewards, observations = arrays.rewards.copy(), arrays.observations.copy()
        terminated, truncated = arrays.terminated.copy(), arrays.truncated.copy()
        self._rows_to_reset = terminated | truncated
        if self._rows_to_reset.any():
            infos |= self._results(self._rows_to_reset, observations)
            if self._mode is AutoresetMode.SAME_STEP:
                finished_rows = self._rows_to_reset
                self._begin_again(finished_rows)
                observations = arrays.observations.copy()
                infos |= self._infos(finished_rows)
        return observations, rewards, terminated, truncated, infos

    def close_extras(self, **options: object) -> None:
        """End the threads."""
        self._episodes.close()

    def _begin(
        self, mask: Flags, seeds: Sequence[int | None], choices: Mapping[str, Value]
    ) -> None:
        """Begin episodes of some rows; rows without a seed draw one."""
        row_seeds = []
        for i in np.flatnonzero(mask).tolist():
            seed = seeds[i]
            if seed is None:
                seed = int(self._generator(i).integers(MAX_SEED))
            else:
                self._row_seeds[i], self._generators[i] = seed, None
            row_seeds.append(seed)
        self._episodes.begin(mask, row_seeds, choices)
        self._rows_to_reset = self._rows_to_reset & ~mask

    def _begin_again(self, mask: Flags) -> None:
        """Begin the next episodes of some rows, with the levels of their last reset."""
        rest = mask.copy()
        while rest.any():
            choices = self._choices[int(np.argmax(rest))]
            rows = rest & np.array([other is choices for other in self._choices])
            self._begin(rows, [None] * self.num_envs, choices)
            rest &= ~rows

    def _generator(self, row: int) -> np.random.Generator:
        """Return the generator of a row's seeds, which is created when the first is drawn."""
        generator = self._generators[row]
        if generator is None:
            generator, _ = seeding.np_random(self._row_seeds[row])
            self._generators[row] = generator
        return generator

    def _infos(self, mask: Flags) -> dict[str, Any]:
        """Return the seeds, levels and variations of the rows that begin an episode."""
        episodes = self._episodes
        return _info_of(
            mask,
            {
                "seed": episodes.seeds,
                "level": episodes.levels,
                "variations": episodes.variations,
            },
        )

    def _results(self, finished_rows: Flags, observations: Array) -> dict[str, Any]:
        """Return the results of the rows whose episode is over."""
        rows = np.flatnonzero(finished_rows)
        result = _info_of(finished_rows, _spread(self._episodes.results(rows), rows, self.num_envs))
        if self._mode is not AutoresetMode.SAME_STEP:
            return result
        final_observations = np.full(self.num_envs, None, dtype=object)
        for i in rows.tolist():
            final_observations[i] = observations[i].copy()
        return {
            "final_obs": final_observations,
            "_final_obs": finished_rows.copy(),
            "final_info": {**self._infos(finished_rows), **result},
            "_final_info": finished_rows.copy(),
        }


def _read_seeds(seed: int | Sequence[int | None] | None, n: int) -> list[int | None]:
    """Return the seed of each row; None: the row draws one.

    Raises:
        BadSetting: there are other than n seeds, or one is no integer from 0 to 2^63 - 1.
    """
    if seed is None:
        return [None] * n
    if isinstance(seed, int | np.integer):
        return list(seed_array([int(seed) + i for i in range(n)]).tolist())
    seeds = seed.tolist() if isinstance(seed, np.ndarray) else seed
    if not isinstance(seeds, list | tuple) or len(seeds) != n:
        raise BadSetting(f"seed is {short_repr(seed)}; expected an integer or a list of {n}.")
    for value in seeds:
        if value is not None and not isinstance(value, int | np.integer):
            raise BadSetting(f"seed has {short_repr(value)}; expected integers or None.")
    seed_array([int(value) for value in seeds if value is not None])
    return [None if value is None else int(value) for value in seeds]


def _read_mask(mask: object, n: int) -> Flags:
    """Return the rows to reset; without a mask, all.

    Raises:
        BadSetting: the mask is no array of n booleans, or chooses no row.
    """
    if mask is None:
        return np.ones(n, np.bool_)
    flags: Flags = np.array(mask)
    if flags.dtype != np.bool_ or flags.shape != (n,) or not flags.any():
        raise BadSetting(
            f"reset_mask is {short_repr(mask)}; expected an array of {n} booleans with True for "
            "one row at least."
        )
    return flags


def _spread(values: Mapping[str, Any], rows: npt.NDArray[np.int64], n: int) -> dict[str, Any]:
    """Return values of some rows as arrays of all n rows; others are 0, or None for texts."""
    spread: dict[str, Any] = {}
    for name, value in values.items():
        if isinstance(value, Mapping):
            spread[name] = _spread(value, rows, n)
            continue
        spread[name] = np.full(n, None if value.dtype == object else 0, dtype=value.dtype)
        spread[name][rows] = value
    return spread


def _info_of(mask: Flags, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the ``info`` of a vector: copies of arrays, each with the mask of its valid rows."""
    info: dict[str, Any] = {}
    for name, value in values.items():
        info[name] = _info_of(mask, value) if isinstance(value, Mapping) else value.copy()
        info[f"_{name}"] = mask.copy()
    return info
