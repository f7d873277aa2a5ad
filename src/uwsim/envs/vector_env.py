"""The vector of environments of a benchmark file: rows that are stepped one after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Unpack

import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv

from ..editing import Benchmark, Scene
from ..errors import BadSetting
from ..messages.observation import Observation
from .actions import read_action_values
from .benchmark_env import BenchmarkEnv
from .frames import FrameSource
from .make import EnvOptions
from .row_task import RowsRefused
from .row_vector_env import EPISODE_IS_OVER, RowVectorEnv, read_vector_options
from .steppers import NO_IMAGES, StepperName, check_stepper
from .task import EnvironmentOptions, make_task


class VectorRow(BenchmarkEnv):
    """A row of a vector, whose automatic resets keep the options of the last reset by the user."""

    kept_options: dict[str, Any] | None = None
    """The options of the last reset by the user."""

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode, by default with `kept_options`."""
        return super().reset(seed=seed, options=options or self.kept_options)


class BenchmarkVectorEnv(SyncVectorEnv):  # type: ignore[misc]  # mypy skips gymnasium
    """A vector of environments in this process.

    Row i after ``reset(seed=s)`` is the single environment after ``reset(seed=s + i)``, to the bit.

    Args:
        benchmark: a benchmark file, a bundled name, or a `Benchmark`.
        num_envs: the number of rows.
        autoreset_mode: ``NextStep`` (the default), ``SameStep`` or ``Disabled``.
        scene: an option of `BenchmarkEnv`, as are the following.
    """

    def __init__(
        self,
        benchmark: str | Path | Benchmark,
        num_envs: int = 1,
        *,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        scene: str | Path | Scene | None = None,
        observation: Sequence[str] | None = None,
        action: Sequence[str] | None = None,
        reward: str | None = None,
        success: str | None = None,
        vehicle: str | None = None,
        reference: str | None = None,
        period: float | None = None,
        settings: Mapping[str, float | str] | None = None,
        data_path: Sequence[str | Path] = (),
        render_mode: str | None = None,
        camera: str | None = None,
        frame_size: tuple[int, int] | None = None,
        real_time_factor: float = 1.0,
    ) -> None:
        mode = read_vector_options(num_envs, autoreset_mode)
        if render_mode == "human" and num_envs > 1:
            raise BadSetting("render_mode='human' shows one environment; expected num_envs=1.")
        make = partial(
            VectorRow,
            benchmark,
            scene=scene,
            observation=observation,
            action=action,
            reward=reward,
            success=success,
            vehicle=vehicle,
            reference=reference,
            period=period,
            settings=settings,
            data_path=data_path,
            render_mode=render_mode,
            camera=camera,
            frame_size=frame_size,
            real_time_factor=real_time_factor,
        )
        super().__init__([make] * num_envs, autoreset_mode=mode)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begin episodes of all rows, or of those of ``options["reset_mask"]``.

        Args:
            seed: the seed of the first row; the next row has the next seed; or one for each row.
            options: ``{"level": {...}}`` as for `BenchmarkEnv`, and ``reset_mask`` (n,). Automatic
                resets keep the level.
        """
        kept_options = {k: v for k, v in (options or {}).items() if k != "reset_mask"} or None
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, np.bool_))
        for row, is_reset in zip(self.envs, np.asarray(mask).tolist(), strict=False):
            if is_reset:
                row.unwrapped.kept_options = kept_options
        result: tuple[Any, dict[str, Any]] = super().reset(seed=seed, options=options)
        return result

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Take a step with each row; wrong actions change no row."""
        values = read_action_values(actions, self.action_space.shape, "The array of actions")
        if self.autoreset_mode is AutoresetMode.DISABLED and self._autoreset_envs.any():
            raise BadSetting(EPISODE_IS_OVER)
        result: tuple[Any, Any, Any, Any, dict[str, Any]] = super().step(values)
        return result

    @property
    def stepper(self) -> str:
        """The stepper of the rows, and the reason for it."""
        return str(self.envs[0].unwrapped.stepper)


def make_vector_env(
    benchmark: str | Path | Benchmark,
    num_envs: int = 1,
    *,
    stepper: StepperName = "engine",
    threads: int = 1,
    autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
    **options: Unpack[EnvOptions],
) -> BenchmarkVectorEnv | RowVectorEnv:
    """Make a vector of environments of a benchmark file.

    Args:
        benchmark: a benchmark file, a bundled name, or a `Benchmark`.
        num_envs: the number of rows.
        stepper: ``engine`` for episodes that are trials of the benchmark to the bit, ``rows`` for
            compiled rows of free vehicles, several hundred times as fast, or ``auto`` for rows if
            they can step the environment.
        threads: the number of threads of ``rows``; it has no effect on the results.
        autoreset_mode: ``NextStep`` (the default), ``SameStep`` or ``Disabled``.
        options: the options of `BenchmarkEnv`.

    Raises:
        BadSetting: rows cannot step the environment; the message has the reasons.
        UwsimError: a file, a name or an option is invalid.
    """
    renders = options.get("render_mode") is not None
    if check_stepper(stepper) == "engine" or (stepper == "auto" and renders):
        return BenchmarkVectorEnv(benchmark, num_envs, autoreset_mode=autoreset_mode, **options)
    if renders:
        raise BadSetting(NO_IMAGES)
    settings, data_path = options.get("settings"), options.get("data_path", ())
    parts = EnvironmentOptions(
        observation=options.get("observation"),
        action=options.get("action"),
        reward=options.get("reward"),
        success=options.get("success"),
        vehicle=options.get("vehicle"),
        reference=options.get("reference"),
        period=options.get("period"),
    )
    plan = make_task(
        benchmark,
        parts,
        settings=settings or {},
        data_path=data_path,
        scene=options.get("scene"),
    )
    FrameSource(plan.scene, options.get("camera"), options.get("frame_size"))  # checks the names
    try:
        return RowVectorEnv(plan, num_envs, threads=threads, autoreset_mode=autoreset_mode)
    except RowsRefused:
        if stepper == "rows":
            raise
    return BenchmarkVectorEnv(benchmark, num_envs, autoreset_mode=autoreset_mode, **options)
