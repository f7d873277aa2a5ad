"""The base classes of scene updaters, and the levels of nested updaters."""

from __future__ import annotations

import abc
import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from ...errors import BadSetting
from ...schema import Spec, element
from ...world import Stage

MAX_LEVELS = 100_000
"""The greatest number of levels of a benchmark."""


@dataclass(frozen=True)
class Level:
    """A level of a benchmark: one value for each scene updater."""

    values: tuple[tuple[str, float], ...]
    """The column name and the value of each updater, the outermost first:
    ``(("current", 0.1), ("fog", 0.05))``."""

    def __str__(self) -> str:
        return ", ".join(f"{name}={value:g}" for name, value in self.values)


@dataclass(frozen=True, kw_only=True)
class SceneUpdaterSpec(Spec, abc.ABC):
    """An element of ``<sceneUpdater>``, which changes the scene from level to level."""

    name: ClassVar[str]
    """The name of the swept parameter: the name of its column in the result."""
    unit: ClassVar[str] = "1"
    """The unit of the values."""
    child: SceneUpdaterSpec | None = element("sceneUpdater", default=None)
    """The nested updater, which runs through all of its values for each value of this one."""
    settling_time: float = element(default=0.0, attribute=True, namespaced=True, minimum=0.0)
    """The time after each step of this updater, the first level included, before measures are
    active and the interval begins [s] (``u:settlingTime``)."""

    @abc.abstractmethod
    def values(self) -> tuple[float, ...]:
        """Return the values of this updater, in the order of the levels."""

    @abc.abstractmethod
    def bind(self, stage: Stage) -> SceneUpdater:
        """Resolve the part of the scene to change; raises UwsimError if the scene lacks it."""

    def files(self, stage: Stage) -> Mapping[str, Path]:
        """Return the files and folders that the updater reads: name in the benchmark -> path."""
        return {}

    def errors(self) -> Iterable[str]:
        """Return errors of values that are valid one by one, but not together.

        A message that begins with the name of a child, ``<step> ...``, gets the child's line.
        """
        return ()

    @property
    def parameter(self) -> str:
        """The name of the column: `name`, unless the file selects another quantity."""
        return self.name

    @property
    def parameter_unit(self) -> str:
        """The unit of the column."""
        return self.unit

    @property
    def seconds_per_level(self) -> float | None:
        """The duration of a level if this is the deepest updater [s]; None: until ``stopOn``."""
        return None

    @property
    def first_value(self) -> float:
        """The value in the first level."""
        return self.values()[0]

    def blend(self, value: float, fraction: float) -> float:
        """Return the value at ``fraction`` (0..1) of the way from the first value to ``value``."""
        start = self.first_value
        return value if fraction >= 1.0 else start + (value - start) * fraction


class SceneUpdater(abc.ABC):
    """An updater bound to a scene, of which it changes one quantity."""

    @abc.abstractmethod
    def apply(self, value: float) -> None:
        """Change the scene to ``value`` at the beginning of a level."""

    def begin(self, value: float) -> None:
        """Change the scene to ``value`` at the beginning of the first level of a sequence.

        The default is to call `apply`.
        """
        self.apply(value)

    def ramp(self, value: float) -> None:
        """Change the scene to ``value`` outside of any level.

        It is called before the first level, and during the prelude of an independent level. The
        default is to call `apply`.
        """
        self.apply(value)

    @property
    def streams(self) -> tuple[tuple[str, int, str], ...]:
        """The images that the updater itself has published: topic, number, SHA-256 hash."""
        return ()

    def close(self) -> None:  # noqa: B027 - most updaters have none open
        """Close the files of the updater."""


def chain(spec: SceneUpdaterSpec) -> tuple[SceneUpdaterSpec, ...]:
    """Return an updater and the updaters nested in it, the outermost first.

    A ``<none/>`` nested in another updater changes nothing and is left out.
    """
    updaters: list[SceneUpdaterSpec] = []
    updater: SceneUpdaterSpec | None = spec
    while updater is not None:
        if not updaters or updater.name != "none":
            updaters.append(updater)
        updater = updater.child
    return tuple(updaters)


def swept_parameters(spec: SceneUpdaterSpec) -> tuple[str, ...]:
    """Return the column name of each updater, outermost first; a second ``fog`` is ``fog_2``."""
    names: list[str] = []
    for updater in chain(spec):
        name = updater.parameter
        n_before = sum(earlier_name.split("_")[0] == name for earlier_name in names)
        names.append(name if n_before == 0 else f"{name}_{n_before + 1}")
    return tuple(names)


def n_levels(spec: SceneUpdaterSpec) -> int:
    """Return the number of levels: the product of the numbers of values of nested updaters."""
    total = 1
    for updater in chain(spec):
        total *= len(updater.values())
    return total


def levels(spec: SceneUpdaterSpec) -> list[Level]:
    """Return all levels in the order of execution: the deepest updater changes fastest."""
    if (n := n_levels(spec)) > MAX_LEVELS:
        raise BadSetting(f"The scene updater has {n} levels; expected at most {MAX_LEVELS}.")
    names = swept_parameters(spec)
    products = itertools.product(*(updater.values() for updater in chain(spec)))
    return [Level(tuple(zip(names, values, strict=True))) for values in products]


def initial_level(spec: SceneUpdaterSpec) -> Level:
    """Return the level with the initial value of every updater."""
    values = (updater.first_value for updater in chain(spec))
    return Level(tuple(zip(swept_parameters(spec), values, strict=True)))


def blend(spec: SceneUpdaterSpec, level: Level, fraction: float) -> Level:
    """Return the level at ``fraction`` (0..1) of the way from the initial level to ``level``."""
    values = (
        (name, updater.blend(value, fraction))
        for updater, (name, value) in zip(chain(spec), level.values, strict=True)
    )
    return Level(tuple(values))


def interval(spec: SceneUpdaterSpec) -> float | None:
    """Return the duration of a level [s], set by the deepest updater; None: until ``stopOn``."""
    return chain(spec)[-1].seconds_per_level


def bind_updaters(spec: SceneUpdaterSpec, stage: Stage) -> tuple[SceneUpdater, ...]:
    """Bind an updater and the updaters nested in it, the outermost first."""
    return tuple(updater.bind(stage) for updater in chain(spec))


def find_steps(level: Level, last_level: Level | None) -> tuple[bool, ...]:
    """Return for each updater, the outermost first, whether it steps from one level to the next.

    As in the original UWSim, an updater steps only when its own value or the value of an outer
    updater changes: a current updater that contains a sweep of fog resets its vehicle once for each
    current, not at every fog level. All updaters step if ``last_level`` is None.
    """
    n = len(level.values)
    return tuple(
        last_level is None or last_level.values[:i] != level.values[:i] for i in range(1, n + 1)
    )


def settling_time(
    spec: SceneUpdaterSpec, level: Level, *, last_level: Level | None = None
) -> float:
    """Return the time from the step to ``level`` until the interval and the measures begin [s]."""
    updater_steps = zip(chain(spec), find_steps(level, last_level), strict=True)
    return max(updater.settling_time if is_step else 0.0 for updater, is_step in updater_steps)


def apply_level(
    updaters: Sequence[SceneUpdater], level: Level, *, last_level: Level | None = None
) -> None:
    """Change the scene to ``level``, with the outermost updater first.

    Args:
        updaters: the bound updaters, outermost first.
        level: the level that begins.
        last_level: the previous level in the same simulation; None for the first (`find_steps`).
    """
    updater_steps = zip(updaters, level.values, find_steps(level, last_level), strict=True)
    for updater, (_, value), is_step in updater_steps:
        if is_step:
            updater.apply(value)


def begin_level(updaters: Sequence[SceneUpdater], level: Level) -> None:
    """Change the scene to the first level of a sequence, with the outermost updater first."""
    for updater, (_, value) in zip(updaters, level.values, strict=True):
        updater.begin(value)


def ramp_level(updaters: Sequence[SceneUpdater], level: Level) -> None:
    """Change the scene to values outside of any level, with the outermost updater first."""
    for updater, (_, value) in zip(updaters, level.values, strict=True):
        updater.ramp(value)
