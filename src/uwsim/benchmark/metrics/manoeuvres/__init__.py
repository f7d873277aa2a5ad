"""The numbers of standard manoeuvres and tank experiments, from tracks and records."""

from __future__ import annotations

from .crash_stop import CrashStop, measure_crash_stop
from .criteria import Criterion, judge
from .decay import Decay, fit_decay
from .pull_out import PullOut, measure_pull_out
from .resistance import Resistance, fit_resistance
from .spiral import Spiral, SpiralPoint, measure_spiral
from .track import ManoeuvreTrack, unwrap
from .turning_circle import TurningCircle, measure_turning_circle
from .zigzag import Overshoot, ZigZag, measure_zigzag

__all__ = [
    "CrashStop",
    "Criterion",
    "Decay",
    "ManoeuvreTrack",
    "Overshoot",
    "PullOut",
    "Resistance",
    "Spiral",
    "SpiralPoint",
    "TurningCircle",
    "ZigZag",
    "fit_decay",
    "fit_resistance",
    "judge",
    "measure_crash_stop",
    "measure_pull_out",
    "measure_spiral",
    "measure_turning_circle",
    "measure_zigzag",
    "unwrap",
]
