"""The plan of a run, divided into trials.

A trial is a sequence that must be run in one go: one seed's whole sweep when the benchmark is
sequential, one seed's one level when it is independent.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Literal

from ...benchmark.plugin import Plugin
from ...benchmark.spec import BenchmarkSpec
from ...benchmark.updater_settings import updater_draws
from ...benchmark.updaters import Level
from ...benchmark.updaters import levels as levels_of
from ...bus import Algorithm
from ...errors import BadSetting, did_you_mean
from ...middleware.lockstep.spec import ClientSpec
from ...scene.spec import SceneSpec
from ...scene.variation import Draw, draw
from ...world import TIMESTEP

Mode = Literal["sequential", "independent"]
PATIENCE = 10.0
"""Default of the longest wait for a start, in simulation time [s]."""


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One sequence: its seed, and its levels."""

    index: int
    """Place in the plan, from 0."""
    repeat: int
    """Number of the repeat, from 0."""
    seed: int
    """Seed of every random stream."""
    levels: tuple[Level, ...]
    """Levels to run, in order."""
    is_alone: bool
    """Whether this is one level of an independent benchmark."""

    @property
    def values(self) -> tuple[tuple[float, ...], ...]:
        """The values of each level, the outermost first."""
        return tuple(tuple(value for _, value in level.values) for level in self.levels)

    @property
    def stream_prefix(self) -> str:
        """Prefix of the name of every random stream."""
        if not self.is_alone:
            return ""
        values = ",".join(f"{value:.12g}" for _, value in self.levels[0].values)
        return f"level/{values}/"


@dataclass(frozen=True, kw_only=True)
class AlgorithmUnderTest:
    """An algorithm, its parameters, and where it runs."""

    cls: type[Algorithm]
    """Its class."""
    name: str
    """The name that selected it."""
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    """The values of ``--set algorithm.NAME=VALUE``."""
    own_process: bool = False
    """Whether it runs in a process of its own, in lock-step."""
    client: ClientSpec | None = None
    """The program outside that is the algorithm; None where ``cls`` is."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A benchmark with scene, algorithm and options; an immutable value, sent to workers."""

    benchmark: BenchmarkSpec
    """The benchmark file."""
    scene: SceneSpec
    """The scene, with ``--set`` applied."""
    algorithm: AlgorithmUnderTest
    """What is tested, and where it runs."""
    settings: tuple[tuple[str, str], ...] = ()
    """Every ``--set``, as given; those of scene and updaters are already in these."""
    mode: Mode = "sequential"
    """How levels follow each other."""
    seed: int = 0
    """Seed of the first repeat."""
    repeats: int = 1
    """Number of repeats; they use seeds ``seed ... seed + repeats - 1``."""
    chosen: tuple[tuple[str, float], ...] = ()
    """``--level``: only levels whose swept parameter has one of these values."""
    compatibility: frozenset[str] = frozenset()
    """The compatibility quirks that are on."""
    timestep: float = TIMESTEP
    """Length of a physics step [s]."""
    data_path: tuple[Path, ...] = ()
    """Folders in which files are looked for."""
    is_blind: bool = False
    """Whether images are black: for a control that does not look at them."""
    inputs: Mapping[int, bytes] = field(default_factory=dict)
    """Number of a trial -> a pilot's inputs in an earlier run, which are sent again."""
    plugins: tuple[Plugin, ...] = ()
    """What was read with ``--plugin``."""

    def __reduce__(self) -> tuple[Callable[..., Plan], tuple[object, ...]]:
        """Pickle the plugins first, because later fields may be of their classes."""
        others = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "plugins"}
        return _unpacked, (self.plugins, others)

    @property
    def is_bundled(self) -> bool:
        """Whether only code of uwsim runs: a bundled algorithm without plugins."""
        return self.algorithm.cls.__module__.startswith("uwsim.") and not self.plugins

    @property
    def patience(self) -> float:
        """How long a start is waited for [s of simulation time]."""
        if self.benchmark.patience is not None:
            return self.benchmark.patience
        client = self.algorithm.client
        if client is not None and client.sync == "none":
            return client.limit * client.speed  # somebody has yet to start the program
        return PATIENCE

    def draws(self, seed: int) -> tuple[Draw, ...]:
        """Return the variations of a seed: those of the scene, then of the benchmark."""
        return (*draw(self.scene, seed), *updater_draws(self.benchmark, seed))

    def levels(self) -> tuple[Level, ...]:
        """Return the levels to run.

        Raises:
            BadSetting: ``--level`` names no swept parameter, or a value the sweep does not have.
        """
        return chosen_levels(levels_of(self.benchmark.scene_updater), self.chosen)

    def trials(self) -> tuple[Trial, ...]:
        """Divide the plan into trials, repeat by repeat, level by level."""
        levels = self.levels()
        groups = [levels] if self.mode == "sequential" else [(level,) for level in levels]
        return tuple(
            Trial(
                index=repeat * len(groups) + i,
                repeat=repeat,
                seed=self.seed + repeat,
                levels=group,
                is_alone=self.mode == "independent",
            )
            for repeat in range(self.repeats)
            for i, group in enumerate(groups)
        )


def chosen_levels(
    levels: Sequence[Level], chosen: Sequence[tuple[str, float]]
) -> tuple[Level, ...]:
    """Return those of the levels whose swept parameters have one of the values chosen for them.

    Raises:
        BadSetting: a name is no swept parameter, or a value is not in the sweep.
    """
    kept = tuple(levels)
    for name in dict.fromkeys(name for name, _ in chosen):
        wanted = [value for other, value in chosen if other == name]
        has = {value for level in kept for n, value in level.values if n == name}
        if not has:
            known = [n for n, _ in kept[0].values]
            near = did_you_mean(name, known)
            raise BadSetting(f"--level {name}: this benchmark sweeps {', '.join(known)}.{near}")
        for value in wanted:
            if not any(_same(value, other) for other in has):
                nearest = min(sorted(has, reverse=value > 0), key=lambda other: abs(other - value))
                raise BadSetting(
                    f"--level {name}={value:.12g} is not a level; the nearest is {nearest:.12g}."
                )
        kept = tuple(
            level
            for level in kept
            if any(_same(dict(level.values)[name], value) for value in wanted)
        )
    return kept


def _unpacked(plugins: tuple[Plugin, ...], others: dict[str, Any]) -> Plan:
    return Plan(plugins=plugins, **others)


def _same(a: float, b: float) -> bool:
    return abs(a - b) < 1e-9
