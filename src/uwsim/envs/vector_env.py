"""The vector of environments of a benchmark file: rows that are stepped one after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from gymnasium.vector import AutoresetMode, SyncVectorEnv

from .benchmark_env import BenchmarkEnv


class BenchmarkVectorEnv(SyncVectorEnv):  # type: ignore[misc]  # mypy skips gymnasium
    """A vector of environments in this process.

    Row i after ``reset(seed=s)`` is the single environment after ``reset(seed=s + i)``, to the bit.

    Args:
        benchmark: a benchmark file or a bundled name.
        num_envs: the number of rows.
        autoreset_mode: ``NextStep`` (the default), ``SameStep`` or ``Disabled``.
        observation: an option of `BenchmarkEnv`, as are the following.
    """

    def __init__(
        self,
        benchmark: str | Path,
        num_envs: int = 1,
        *,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
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
    ) -> None:
        make = partial(
            BenchmarkEnv,
            benchmark,
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
        )
        super().__init__([make] * num_envs, autoreset_mode=autoreset_mode)

    @property
    def stepper(self) -> str:
        """The stepper of the rows, and the reason for it."""
        return str(self.envs[0].unwrapped.stepper)
