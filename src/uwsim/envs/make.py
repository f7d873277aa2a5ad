"""``uwsim.make_env``, ``uwsim.make_parallel_env``: the environments of any benchmark file."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypedDict, Unpack

from ..errors import MissingExtra

if TYPE_CHECKING:
    from ..editing import Benchmark, Scene
    from .benchmark_env import BenchmarkEnv
    from .parallel_env import ParallelBenchmarkEnv
    from .task import AgentOptions

INSTALL = "scripts/setup envs in a checkout, else pip install with the extra [envs]"
"""The ways to install the packages of the environments."""


class EnvOptions(TypedDict, total=False):
    """The options of an environment; `BenchmarkEnv` describes them."""

    scene: str | Path | Scene | None
    observation: Sequence[str] | None
    action: Sequence[str] | None
    reward: str | None
    success: str | None
    vehicle: str | None
    reference: str | None
    period: float | None
    settings: Mapping[str, float | str] | None
    data_path: Sequence[str | Path]
    render_mode: str | None
    camera: str | None
    frame_size: tuple[int, int] | None
    real_time_factor: float


class ParallelOptions(TypedDict, total=False):
    """The options of an environment of several vehicles; `ParallelBenchmarkEnv` describes them."""

    scene: str | Path | Scene | None
    agents: Mapping[str, AgentOptions] | None
    settings: Mapping[str, float | str] | None
    data_path: Sequence[str | Path]
    render_mode: str | None
    camera: str | None


def make_env(
    benchmark: str | Path | Benchmark,
    *,
    stepper: Literal["engine", "rows", "auto"] = "engine",
    **options: Unpack[EnvOptions],
) -> BenchmarkEnv:
    """Make the Gymnasium environment of a benchmark file.

    Args:
        benchmark: a benchmark file, a bundled name or a `Benchmark`; with ``observation`` and
            ``action`` it needs no ``<u:environment>``.
        stepper: ``engine`` for episodes that are trials of the benchmark to the bit, ``rows`` for
            compiled rows, or ``auto`` for rows if they can step the environment.
        options: the options of `uwsim.envs.BenchmarkEnv`.

    Raises:
        MissingExtra: Gymnasium is not installed.
        UwsimError: a file, a name or an option is invalid.
    """
    if importlib.util.find_spec("gymnasium") is None:
        raise MissingExtra(f"Environments need Gymnasium: {INSTALL}.")
    from .benchmark_env import BenchmarkEnv

    return BenchmarkEnv(benchmark, stepper=stepper, **options)


def make_parallel_env(
    benchmark: str | Path | Benchmark, **options: Unpack[ParallelOptions]
) -> ParallelBenchmarkEnv:
    """Make the PettingZoo environment of a benchmark file in which several vehicles act.

    Args:
        benchmark: a benchmark file, a bundled name or a `Benchmark`; with ``agents`` it needs no
            ``<u:environment>``.
        options: the options of `uwsim.envs.parallel_env.ParallelBenchmarkEnv`.

    Raises:
        MissingExtra: PettingZoo is not installed.
        UwsimError: a file, a name or an option is invalid.
    """
    if importlib.util.find_spec("pettingzoo") is None:
        raise MissingExtra(f"Environments of several vehicles need PettingZoo: {INSTALL}.")
    from .parallel_env import ParallelBenchmarkEnv

    return ParallelBenchmarkEnv(benchmark, **options)
