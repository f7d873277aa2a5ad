"""Timing of a run: wall time and CPU time, for its provenance."""

from __future__ import annotations

import datetime
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .run import Run


@dataclass(frozen=True, kw_only=True)
class Stopwatch:
    """When a command began, and how long it has taken since.

    The time of day may be set while a run lasts; durations are measured by a monotonic clock.
    """

    began: float = field(default_factory=time.time)
    """Time of day [s since 1970]."""
    start: float = field(default_factory=time.monotonic)
    """The same moment on the clock that only runs [s]."""

    def passed(self) -> float:
        """How long ago that was [s]."""
        return time.monotonic() - self.start


@dataclass(frozen=True, kw_only=True)
class Timing:
    """Timing of algorithms that run together."""

    began: float
    """When [s since 1970]."""
    wall: float
    """How long [s]."""
    workers: str
    """The executor, as the command names it."""
    command: Sequence[str]
    """What was typed behind ``uwsim``."""
    runs: Sequence[Run]
    """What was run, one for each algorithm."""

    def provenance(self, run: Run) -> dict[str, object]:
        """Return machine, date and timing; none of it enters a score."""
        from importlib.metadata import version

        from ..results.provenance import machine

        simulated = sum(each.simulated_s for each in self.runs)
        names = ("mujoco", "numpy", "numba", "moderngl", "opencv-python-headless", "rosbags")
        return {
            "began": datetime.datetime.fromtimestamp(self.began, datetime.UTC).isoformat(),
            "algorithms": [each.plan.algorithm.name for each in self.runs],
            "wall_s": self.wall,
            "simulated_s": simulated,
            "real_time_factor": simulated / self.wall if self.wall > 0.0 else None,
            "workers": int(self.workers) if self.workers.isdigit() else self.workers,
            "lost_workers": run.n_lost,
            "resumed": run.n_resumed,
            "command": list(self.command),
            **machine(),
            "packages": {name: version(name) for name in names},
        }
