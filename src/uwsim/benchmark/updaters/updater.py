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
    """One level of a sweep: the value of each updater, the outermost first."""

    values: tuple[tuple[str, float], ...]
    """(parameter, value) of each updater, such as ``(("current", 0.1), ("fog", 0.05))``."""

    def __str__(self) -> str:
        return ", ".join(f"{name}={value:g}" for name, value in self.values)


@dataclass(frozen=True, kw_only=True)
class SceneUpdaterSpec(Spec, abc.ABC):
    """What ``<sceneUpdater>`` holds: how the scene changes from level to level."""

    name: ClassVar[str]
    """Its parameter: the name of its column in the result."""
    unit: ClassVar[str] = "1"
    """Unit of its values."""
    child: SceneUpdaterSpec | None = element("sceneUpdater", default=None)
    """The updater nested in it, which is stepped first."""
    settling_time: float = element(default=0.0, attribute=True, namespaced=True, minimum=0.0)
    """How long after each step of it, the first level included, measuring and the interval wait
    [s] (``u:settlingTime``)."""

    @abc.abstractmethod
    def values(self) -> tuple[float, ...]:
        """Return the value of each of its levels."""

    @abc.abstractmethod
    def bind(self, stage: Stage) -> SceneUpdater:
        """Find what it changes; raises UnknownName or UwsimError if it cannot."""

    def files(self, stage: Stage) -> Mapping[str, Path]:
        """Return the files and folders that it reads, by the names that the file has for them."""
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
        """How long a level lasts when it is the deepest [s]; None: until ``stopOn``."""
        return None

    @property
    def initial(self) -> float:
        """The value it starts from."""
        return self.values()[0]

    def blend(self, value: float, fraction: float) -> float:
        """Return the value at ``fraction`` (0..1) of the way from `initial` to ``value``."""
        start = self.initial
        return value if fraction >= 1.0 else start + (value - start) * fraction


class SceneUpdater(abc.ABC):
    """Something that changes one quantity of the scene."""

    @abc.abstractmethod
    def apply(self, value: float) -> None:
        """Step to ``value``, with which a level begins."""

    def begin(self, value: float) -> None:
        """Begin the first level of a sequence, before which nothing has stepped: as `apply`."""
        self.apply(value)

    def ramp(self, value: float) -> None:
        """Bring the scene to ``value`` outside of any level: as `apply`.

        That is before the first level, and on the way from the initial values to a level.
        """
        self.apply(value)

    @property
    def streams(self) -> tuple[tuple[str, int, str], ...]:
        """Topic, number and SHA-256 of the images that it published itself."""
        return ()

    def close(self) -> None:  # noqa: B027 - most updaters hold nothing
        """Release its resources (a file)."""


def chain(spec: SceneUpdaterSpec) -> tuple[SceneUpdaterSpec, ...]:
    """Return the updater and those nested in it, outermost first.

    A ``<none/>`` nested in another updater changes nothing and is left out.
    """
    found: list[SceneUpdaterSpec] = []
    updater: SceneUpdaterSpec | None = spec
    while updater is not None:
        if not found or updater.name != "none":
            found.append(updater)
        updater = updater.child
    return tuple(found)


def swept_parameters(spec: SceneUpdaterSpec) -> tuple[str, ...]:
    """Return the column name of each updater, outermost first; a second ``fog`` is ``fog_2``."""
    names: list[str] = []
    for updater in chain(spec):
        name = updater.parameter
        n_before = sum(other.split("_")[0] == name for other in names)
        names.append(name if n_before == 0 else f"{name}_{n_before + 1}")
    return tuple(names)


def n_levels(spec: SceneUpdaterSpec) -> int:
    """Return how many levels there are: the product over nested updaters."""
    total = 1
    for updater in chain(spec):
        total *= len(updater.values())
    return total


def levels(spec: SceneUpdaterSpec) -> list[Level]:
    """Return all levels in the order of execution: the deepest updater changes fastest."""
    if n_levels(spec) > MAX_LEVELS:
        raise BadSetting(f"The scene updater has {n_levels(spec)} levels; at most {MAX_LEVELS}.")
    names = swept_parameters(spec)
    products = itertools.product(*(updater.values() for updater in chain(spec)))
    return [Level(tuple(zip(names, values, strict=True))) for values in products]


def initial_level(spec: SceneUpdaterSpec) -> Level:
    """Return the level with the initial value of every updater."""
    values = (updater.initial for updater in chain(spec))
    return Level(tuple(zip(swept_parameters(spec), values, strict=True)))


def blend(spec: SceneUpdaterSpec, level: Level, fraction: float) -> Level:
    """Return the level at ``fraction`` (0..1) of the way from the initial level to ``level``."""
    blended = (
        (name, updater.blend(value, fraction))
        for updater, (name, value) in zip(chain(spec), level.values, strict=True)
    )
    return Level(tuple(blended))


def interval(spec: SceneUpdaterSpec) -> float | None:
    """Return how long a level lasts [s]: the deepest updater decides; None: until ``stopOn``."""
    return chain(spec)[-1].seconds_per_level


def bind_updaters(spec: SceneUpdaterSpec, stage: Stage) -> tuple[SceneUpdater, ...]:
    """Bind the updater and those nested in it, outermost first."""
    return tuple(updater.bind(stage) for updater in chain(spec))


def steps(level: Level, after: Level | None) -> tuple[bool, ...]:
    """Return the updaters that change when ``level`` follows ``after``, outermost first.

    As in the original, one steps only when its value or that of one around it is another: the
    current that contains a sweep of fog puts its vehicle back once, not at every fog.
    """
    n = len(level.values)
    return tuple(after is None or after.values[:i] != level.values[:i] for i in range(1, n + 1))


def settling_time(spec: SceneUpdaterSpec, level: Level, *, after: Level | None = None) -> float:
    """Return how long after the step to ``level`` measuring and the interval wait [s]."""
    stepped = zip(chain(spec), steps(level, after), strict=True)
    return max(updater.settling_time if steps_now else 0.0 for updater, steps_now in stepped)


def apply_level(
    updaters: Sequence[SceneUpdater], level: Level, *, after: Level | None = None
) -> None:
    """Step to ``level``, the outermost updater first.

    Args:
        updaters: bound, outermost first.
        level: what begins.
        after: the level before it in the same simulation, if any; see `steps`.
    """
    stepped = zip(updaters, level.values, steps(level, after), strict=True)
    for updater, (_, value), steps_now in stepped:
        if steps_now:
            updater.apply(value)


def begin_level(updaters: Sequence[SceneUpdater], level: Level) -> None:
    """Begin the first level of a sequence, the outermost updater first."""
    for updater, (_, value) in zip(updaters, level.values, strict=True):
        updater.begin(value)


def ramp_level(updaters: Sequence[SceneUpdater], level: Level) -> None:
    """Bring the scene to values outside of any level, the outermost updater first."""
    for updater, (_, value) in zip(updaters, level.values, strict=True):
        updater.ramp(value)
