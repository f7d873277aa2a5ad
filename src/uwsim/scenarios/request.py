"""The request of a scenario: the log of a mission, and what becomes of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from ..devices.motion.pose_track import GapPolicy
from ..errors import BadSetting

DEFAULT_SCENE = "bluerov2-scene"
"""The scene of a scenario without a scene of its own."""
MAX_DURATION = 600.0
"""The longest mission of a scenario, which is that of a level [s]."""
MAX_LEVELS = 1000
"""The greatest number of levels."""


@dataclass(frozen=True)
class Levels:
    """The levels of a scenario: fog densities [1/m], or factors on the coefficients of a water."""

    start: float
    """The value of the first level."""
    end: float
    """The greatest value."""
    step: float
    """The increment from level to level."""

    @classmethod
    def parse(cls, text: str) -> Levels:
        """Read levels such as ``0:0.5:0.1``; raise BadSetting if they are invalid."""
        try:
            numbers = [float(part) for part in text.split(":")]
        except ValueError:
            numbers = []
        if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
            raise BadSetting(f"Levels {text!r}: expected START:END:STEP, as 0:0.5:0.1.")
        start, end, step = numbers
        if start < 0.0 or end < start or step <= 0.0 or (end - start) / step > MAX_LEVELS:
            raise BadSetting(
                f"Levels {text!r}: expected 0 <= START <= END, a STEP above 0, and at most "
                f"{MAX_LEVELS} levels."
            )
        return cls(start, end, step)


@dataclass(frozen=True, kw_only=True)
class ScenarioRequest:
    """The inputs and the options of a scenario."""

    log: Path
    """The log of the mission."""
    out: Path
    """The new folder."""
    scene: str = DEFAULT_SCENE
    """The scene file or the bundled name of the mission's surroundings."""
    water: Path | None = None
    """The water file of ``uwsim calibrate``, or a scene file with a water; None: the scene's."""
    images: str = ""
    """The topic of the recorded images; empty: views are rendered."""
    camera: str | None = None
    """The camera of the scene at the place of the real one; None: the only one."""
    target: str | None = None
    """The object that trackers follow; None: estimates of the vehicle's position are scored."""
    vehicle: str | None = None
    """The vehicle of the scene; None: that of the log's name, or the first."""
    mapping: Path | None = None
    """The mapping file of the log."""
    start: float = 0.0
    """The time in the log at which the scenario begins [s]."""
    end: float | None = None
    """The time in the log at which it ends [s]; None: that of the last pose."""
    levels: Levels | None = None
    """The levels; None: fog of 0 to 0.5 1/m by 0.1, or one to four times the water."""
    gaps: GapPolicy = "hold"
    """The treatment of gaps in the poses."""
    max_gap: float = 1.0
    """The longest time between two poses that is no gap [s]."""
    seed: int = 0
    """The seed of the scene's variations, which are drawn once."""
    folders: tuple[Path, ...] = ()
    """The folders in which files are searched."""
