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


@dataclass(frozen=True)
class Level:
    """A level of a sweep: the value of each updater, the outermost first."""

    values: tuple[tuple[str, float], ...]
    """The parameter and value of each updater, as ``(("current", 0.1), ("fog", 0.05))``."""

    def __str__(self) -> str:
        return ", ".join(f"{name}={value:g}" for name, value in self.values)


@dataclass(frozen=True, kw_only=True)
class SceneUpdaterSpec(Spec, abc.ABC):
    """An element of ``<sceneUpdater>``, which changes the scene from level to level."""

    name: ClassVar[str]
    """The parameter: the name of its column in the result."""
    unit: ClassVar[str] = "1"
    """The unit of its values."""
    child: SceneUpdaterSpec | None = element("sceneUpdater", default=None)
    """The nested updater, which is stepped first."""
    settling_time: float = element(default=0.0, attribute=True, namespaced=True, minimum=0.0)
    """The time after each step of it, the first level included, during which measuring and the
    interval wait [s] (``u:settlingTime``)."""

    @abc.abstractmethod
    def values(self) -> tuple[float, ...]:
        """Return the value of each of its levels."""

    @abc.abstractmethod
    def bind(self, stage: Stage) -> SceneUpdater:
        """Resolve the changed part of the scene; raises UnknownName or UwsimError if it cannot."""

    def files(self, stage: Stage) -> Mapping[str, Path]:
        """Return the files and folders that it reads, by their names in the file."""
        return {}

    def errors(self) -> Iterable[str]:
        """Return its errors as a whole; a message ``<step> ...`` gets that child's line."""
        return ()

    @property
    def parameter(self) -> str:
        """The name of its column: `name`, unless the file selects another quantity."""
        return self.name

    @property
    def parameter_unit(self) -> str:
        """The unit of that column."""
        return self.unit

    @property
    def seconds_per_level(self) -> float | None:
        """The duration of a level when it is the deepest updater [s]; None: until ``stopOn``."""
        return None

    @property
    def first_value(self) -> float:
        """The value of the first level."""
        return self.values()[0]

    def blend(self, value: float, fraction: float) -> float:
        """Return the value at ``fraction`` (0..1) of the way from the first value to ``value``."""
        start = self.first_value
        return value if fraction >= 1.0 else start + (value - start) * fraction


class SceneUpdater(abc.ABC):
    """A bound updater, which changes one quantity of the scene."""

    @abc.abstractmethod
    def apply(self, value: float) -> None:
        """Step to ``value``, with which a level begins."""

    def begin(self, value: float) -> None:
        """Begin the first level of a sequence, before which there is no step: as `apply`."""
        self.apply(value)

    def ramp(self, value: float) -> None:
        """Set the scene to ``value`` outside of any level: as `apply`.

        It is called before the first level, and between the initial values and a level.
        """
        self.apply(value)

    @property
    def streams(self) -> tuple[tuple[str, int, str], ...]:
        """The topic, number and SHA-256 of the images that it published itself."""
        return ()

    def close(self) -> None:  # noqa: B027 - most updaters have none
        """Release its resources (a file)."""


def chain(spec: SceneUpdaterSpec) -> tuple[SceneUpdaterSpec, ...]:
    """Return the updater and those nested in it, outermost first.

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
    """Return the number of levels: the product over nested updaters."""
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
    """Return the duration of a level [s], that of the deepest updater; None: until ``stopOn``."""
    return chain(spec)[-1].seconds_per_level


def bind_updaters(spec: SceneUpdaterSpec, stage: Stage) -> tuple[SceneUpdater, ...]:
    """Bind the updater and those nested in it, outermost first."""
    return tuple(updater.bind(stage) for updater in chain(spec))


def find_steps(level: Level, last_level: Level | None) -> tuple[bool, ...]:
    """Return the updaters that change from ``last_level`` to ``level``, outermost first.

    As in the original, an updater steps only when its value or that of an outer one changes: a
    current that contains a sweep of fog resets its vehicle once, not at every fog level.
    """
    n = len(level.values)
    return tuple(
        last_level is None or last_level.values[:i] != level.values[:i] for i in range(1, n + 1)
    )


def settling_time(
    spec: SceneUpdaterSpec, level: Level, *, last_level: Level | None = None
) -> float:
    """Return the time for which measuring and the interval wait after the step to ``level`` [s]."""
    updater_steps = zip(chain(spec), find_steps(level, last_level), strict=True)
    return max(updater.settling_time if is_step else 0.0 for updater, is_step in updater_steps)


def apply_level(
    updaters: Sequence[SceneUpdater], level: Level, *, last_level: Level | None = None
) -> None:
    """Step to ``level``, the outermost updater first.

    Args:
        updaters: the bound updaters, outermost first.
        level: the level that begins.
        last_level: the previous level in the same simulation, if any; see `find_steps`.
    """
    updater_steps = zip(updaters, level.values, find_steps(level, last_level), strict=True)
    for updater, (_, value), is_step in updater_steps:
        if is_step:
            updater.apply(value)


def begin_level(updaters: Sequence[SceneUpdater], level: Level) -> None:
    """Begin the first level of a sequence, the outermost updater first."""
    for updater, (_, value) in zip(updaters, level.values, strict=True):
        updater.begin(value)


def ramp_level(updaters: Sequence[SceneUpdater], level: Level) -> None:
    """Set the scene to values outside of any level, the outermost updater first."""
    for updater, (_, value) in zip(updaters, level.values, strict=True):
        updater.ramp(value)
