"""The content of a suite file, as `uwsim.suites.suite` reads it."""

from __future__ import annotations

from dataclasses import dataclass

from ..runs.tracks.track import Track
from ..schema import Spec, element

MAX_SEED = 2**31 - 1
"""The greatest seed of a split."""


@dataclass(frozen=True, kw_only=True)
class SplitSpec(Spec):
    """A ``<split>``: consecutive public seeds."""

    name: str
    """The name of the split, such as validation."""
    first: int = element(default=0, minimum=0, maximum=MAX_SEED)
    """The first seed."""
    count: int = element(default=10, minimum=1, maximum=10_000)
    """The number of seeds."""

    @property
    def seeds(self) -> range:
        """The seeds of the split."""
        return range(self.first, self.first + self.count)


@dataclass(frozen=True, kw_only=True)
class TrackSpec(Spec):
    """A ``<track>``: the sensors and devices whose messages an algorithm may receive."""

    name: str
    """The name of the track, such as a."""
    description: str = ""
    """The sensors in words."""
    sources: tuple[str, ...] = element("source", default=())
    """The elements of sensors and devices, such as virtualCamera, or of interfaces of a vehicle,
    such as ArmToROSJointState; none: the track permits all topics, those with the truth, too."""

    @property
    def rule(self) -> Track | None:
        """The rule for topics; None for a track that permits all topics."""
        return Track(name=self.name, sources=self.sources) if self.sources else None


@dataclass(frozen=True, kw_only=True)
class TaskSpec(Spec):
    """A ``<task>``: a benchmark with a version, and the algorithms of its reference scores."""

    name: str
    """The name with the version, such as station-v1."""
    benchmark: str
    """The benchmark: a file relative to the suite, or a bundled name."""
    description: str = ""
    """The goal, in one sentence."""
    levels: tuple[str, ...] = element("level", default=())
    """Levels of the sweep as NAME=VALUE, such as current=0.2; none: all levels."""
    failures: tuple[str, ...] = element("failure", default=())
    """The statuses of failed trials."""
    baselines: tuple[str, ...] = element("baseline", default=())
    """The algorithms of the reference scores, the simplest first."""
    control: str | None = None
    """The algorithm of the control condition, which does not act."""
    expert: str | None = None
    """The scripted expert, which may use the truth; None without one."""
    hash: str | None = None
    """The hash of the task's files at this version (`task_hash`); None if it is not recorded."""


@dataclass(frozen=True, kw_only=True)
class SuiteSpec(Spec):
    """The content of a suite file."""

    name: str
    """The name of the suite."""
    description: str = ""
    """A sentence about the tasks."""
    splits: tuple[SplitSpec, ...] = element("split")
    """The public seeds; the first split is the default."""
    tracks: tuple[TrackSpec, ...] = element("track")
    """The tracks by sensors."""
    tasks: tuple[TaskSpec, ...] = element("task")
    """The tasks, in their order in tables."""
