"""The plan of a run, divided into trials.

A trial is a sequence of levels that run in one simulation: the whole sweep with one seed if the
mode is sequential, one level with one seed if it is independent.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any, Literal

from ...benchmark.plugin import Plugin
from ...benchmark.spec import BenchmarkSpec
from ...benchmark.updater_settings import scene_of_level, updater_draws
from ...benchmark.updaters import Level
from ...benchmark.updaters import levels as levels_of
from ...bus import Algorithm
from ...errors import BadSetting, did_you_mean
from ...middleware.lockstep.spec import ClientSpec
from ...scene.spec import SceneSpec
from ...scene.variation import Draw, draw
from ...world import TIMESTEP
from ..own_process.facts import AlgorithmFacts, facts_of
from ..tracks.track import Track

Mode = Literal["sequential", "independent"]
START_TIMEOUT = 10.0
"""The default timeout for the start of a level [s of simulation time]."""


@dataclass(frozen=True, kw_only=True)
class Trial:
    """A sequence of levels that run in one simulation, with one seed."""

    index: int
    """The index in the plan, from 0."""
    repeat: int
    """The index of the repeat, from 0."""
    seed: int
    """The seed of every random stream."""
    levels: tuple[Level, ...]
    """The levels to run, in order."""
    is_independent: bool
    """True if the trial is one level of an independent benchmark."""

    @property
    def values(self) -> tuple[tuple[float, ...], ...]:
        """The values of the swept parameters of each level, the outermost updater first."""
        return tuple(tuple(value for _, value in level.values) for level in self.levels)

    @property
    def stream_prefix(self) -> str:
        """The prefix of the name of every random stream."""
        if not self.is_independent:
            return ""
        values = ",".join(f"{value:.12g}" for _, value in self.levels[0].values)
        return f"level/{values}/"


@dataclass(frozen=True, kw_only=True)
class AlgorithmUnderTest:
    """An algorithm, its parameters, and where it runs."""

    cls: type[Algorithm] | AlgorithmFacts
    """The class of the algorithm; or the facts of a class that its own process alone imports."""
    name: str
    """The name with which the user selected it."""
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    """The values of ``--set algorithm.NAME=VALUE``."""
    own_process: bool = False
    """True if it runs in a process of its own, in lock-step."""
    client: ClientSpec | None = None
    """The external program that is the algorithm; None if the algorithm is ``cls``."""
    folder: Path | None = None
    """The working directory of its own process; None for that of the simulation."""
    sources: Mapping[str, Path] | None = None
    """The files of the class, which its own process has found; None to find them when hashed."""

    @property
    def facts(self) -> AlgorithmFacts:
        """The facts of the class."""
        return facts_of(self.cls)

    @property
    def loaded_class(self) -> type[Algorithm]:
        """The class in this process; `Algorithm` itself if its own process alone imports it."""
        return Algorithm if isinstance(self.cls, AlgorithmFacts) else self.cls


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A benchmark with scene, algorithm and options: an immutable value that is sent to workers."""

    benchmark: BenchmarkSpec
    """The content of the benchmark file."""
    scene: SceneSpec
    """The scene, with ``--set`` applied."""
    algorithm: AlgorithmUnderTest
    """The algorithm under test, and where it runs."""
    settings: tuple[tuple[str, str], ...] = ()
    """Every ``--set``, as written; settings of scene and updaters are already applied."""
    mode: Mode = "sequential"
    """The mode of the levels: each continues from the previous level, or all are independent."""
    seed: int = 0
    """The seed of the first repeat."""
    repeats: int = 1
    """The number of repeats, with seeds ``seed ... seed + repeats - 1``."""
    track: Track | None = None
    """The rule for the topics that the algorithm may receive; None: all that are not hidden."""
    level_choices: tuple[tuple[str, float], ...] = ()
    """``--level``: only levels whose swept parameter has one of these values."""
    compatibility: frozenset[str] = frozenset()
    """The names of the compatibility quirks that are on."""
    timestep: float = TIMESTEP
    """The length of a physics step [s]."""
    udp_address: str | None = None
    """The address of this computer at which an autopilot connects; None: there is no autopilot."""
    has_px4: bool = False
    """True if the autopilot is PX4; otherwise it is ArduPilot."""
    data_path: tuple[Path, ...] = ()
    """The folders in which files are searched for (``--data-path``)."""
    is_blind: bool = False
    """True if images are black, as in the control run, whose algorithm (`frozen`) ignores them."""
    records_motion: bool = True
    """True if trials record the motion of all bodies; environments for learning do not."""
    inputs: Mapping[int, bytes] = field(default_factory=dict)
    """The recorded inputs of the pilot of an earlier run, which are sent again: the content of a
    file for the index of each trial."""
    plugins: tuple[Plugin, ...] = ()
    """The plugins of ``--plugin`` and of the benchmark file, and an algorithm's ``FILE.py``."""

    def __reduce__(self) -> tuple[Callable[..., Plan], tuple[object, ...]]:
        """Pickle the plugins first, because later fields may be of their classes."""
        values = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "plugins"}
        return _build_plan, (self.plugins, values)

    @property
    def is_bundled(self) -> bool:
        """True if only code of uwsim runs, that is, a bundled algorithm without plugins."""
        cls = self.algorithm.cls
        is_own = not isinstance(cls, AlgorithmFacts) and cls.__module__.startswith("uwsim.")
        return is_own and not self.plugins

    @property
    def start_timeout(self) -> float:
        """The timeout for the start of a level (``u:patience``) [s of simulation time]."""
        if self.benchmark.patience is not None:
            return self.benchmark.patience
        client = self.algorithm.client
        if client is not None and client.sync == "none":
            return client.limit * client.speed  # the user starts the program meanwhile
        return START_TIMEOUT

    def draws(self, seed: int) -> tuple[Draw, ...]:
        """Return the values drawn with a seed: variations of the scene, then of the benchmark."""
        return (*draw(self.scene, seed), *updater_draws(self.benchmark, seed))

    def plan_of(self, trial: Trial) -> Plan:
        """Return the plan with the scene of a trial, whose level may set numbers of the scene."""
        if not trial.is_independent:
            return self
        scene = scene_of_level(self.scene, self.benchmark.scene_updater, trial.levels[0])
        return self if scene is self.scene else replace(self, scene=scene)

    def levels(self) -> tuple[Level, ...]:
        """Return the levels to run.

        Raises:
            BadSetting: ``--level`` names no swept parameter, or a value that is not in the sweep.
        """
        return chosen_levels(levels_of(self.benchmark.scene_updater), self.level_choices)

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
                is_independent=self.mode == "independent",
            )
            for repeat in range(self.repeats)
            for i, group in enumerate(groups)
        )


def chosen_levels(
    levels: Sequence[Level], choices: Sequence[tuple[str, float]]
) -> tuple[Level, ...]:
    """Return the levels whose swept parameters have one of the chosen values.

    Raises:
        BadSetting: a name is not a swept parameter, or a value is not in the sweep.
    """
    selection = tuple(levels)
    for name in dict.fromkeys(name for name, _ in choices):
        values = [value for other, value in choices if other == name]
        sweep = {value for level in selection for n, value in level.values if n == name}
        if not sweep:
            names = [n for n, _ in selection[0].values]
            near = did_you_mean(name, names)
            raise BadSetting(f"--level {name}: this benchmark sweeps {', '.join(names)}.{near}")
        for value in values:
            if not any(_are_equal(value, other) for other in sweep):
                neighbour = min(
                    sorted(sweep, reverse=value > 0), key=lambda other: abs(other - value)
                )
                raise BadSetting(
                    f"--level {name}={value:.12g} is not a level; the nearest is {neighbour:.12g}."
                )
        selection = tuple(
            level
            for level in selection
            if any(_are_equal(dict(level.values)[name], value) for value in values)
        )
    return selection


def _build_plan(plugins: tuple[Plugin, ...], values: dict[str, Any]) -> Plan:
    return Plan(plugins=plugins, **values)


def _are_equal(a: float, b: float) -> bool:
    return abs(a - b) < 1e-9
