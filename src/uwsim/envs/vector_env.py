"""The vector of environments of a benchmark file: rows that are stepped one after the other."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Unpack

from gymnasium.vector import AutoresetMode, SyncVectorEnv

from .benchmark_env import BenchmarkEnv, EnvOptions


class BenchmarkVectorEnv(SyncVectorEnv):
    """A vector of environments in this process.

    Row i after ``reset(seed=s)`` is the single environment after ``reset(seed=s + i)``, to the bit.

    Args:
        benchmark: a benchmark file or a bundled name.
        num_envs: the number of rows.
        autoreset_mode: ``NextStep`` (the default), ``SameStep`` or ``Disabled``.
        options: the options of `BenchmarkEnv`.
    """

    def __init__(
        self,
        benchmark: str | Path,
        num_envs: int = 1,
        *,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        **options: Unpack[EnvOptions],
    ) -> None:
        make = partial(BenchmarkEnv, benchmark, **options)
        super().__init__([make] * num_envs, autoreset_mode=autoreset_mode)

    @property
    def stepper(self) -> str:
        """The stepper of the rows, and the reason for it."""
        return str(self.envs[0].unwrapped.stepper)  # type: ignore[attr-defined]
