"""The criteria of IMO's standards for ship manoeuvrability, resolution MSC.137(76), section 5.3.

They are written for ships of 100 m and more, at 90 % of the speed of 85 % of the engine's power, in
deep still water, with L / V of 10 to 40 s. AUVs have L / V of about 1 s: the limits of L / V < 10 s
apply. Nothing obliges an underwater vehicle to meet them. They compare vehicles with a known scale:
L is the length of the vehicle, V the speed of its approach. Where a fin turns less than the 35° of
a ship's rudder, "hard over" is its limit. Then a zig-zag 20/20 has the rudder at this limit.

The loop of a spiral has no limit in the standards. The explanatory notes, MSC/Circ.1053, allow
none for L / V < 9 s.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .crash_stop import CrashStop
from .turning_circle import TurningCircle
from .zigzag import ZigZag

MAX_ADVANCE = 4.5  # [L]
MAX_TACTICAL_DIAMETER = 5.0  # [L]
MAX_INITIAL_TURNING = 2.5  # [L]
MAX_OVERSHOOT_20 = 25.0  # [deg]
MAX_TRACK_REACH = 15.0  # [L]


@dataclass(frozen=True, kw_only=True)
class Criterion:
    """A criterion of the standards, with the value of the vehicle."""

    name: str
    """The name of the quantity."""
    value: float | None
    """The value; None if it was not reached."""
    limit: float
    """The greatest permitted value."""
    unit: str
    """The unit of both: ``L`` (lengths of the vehicle) or ``deg``."""

    @property
    def is_met(self) -> bool:
        """True if there is a value, and it does not exceed the limit."""
        return self.value is not None and self.value <= self.limit


def first_overshoot_limit(length_over_speed: float) -> float:
    """Return the greatest first overshoot of a zig-zag 10/10 [deg], for L / V [s]."""
    return 10.0 if length_over_speed < 10.0 else min(5.0 + 0.5 * length_over_speed, 20.0)


def second_overshoot_limit(length_over_speed: float) -> float:
    """Return the greatest second overshoot of a zig-zag 10/10 [deg], for L / V [s]."""
    return 25.0 if length_over_speed < 10.0 else min(17.5 + 0.75 * length_over_speed, 40.0)


def judge(
    length: float,
    *,
    turns: tuple[TurningCircle, ...] = (),
    zigzag_10: ZigZag | None = None,
    zigzag_20: ZigZag | None = None,
    stop: CrashStop | None = None,
) -> tuple[Criterion, ...]:
    """Compare the numbers of manoeuvres with the criteria; of two turns the worse one counts.

    Args:
        length: the length of the vehicle [m].
        turns: the turning circles to both sides.
        zigzag_10: the zig-zag 10/10.
        zigzag_20: the zig-zag 20/20.
        stop: the crash stop.
    """
    criteria: list[Criterion] = []
    if turns:
        advances = [turn.advance for turn in turns]
        diameters = [turn.tactical_diameter for turn in turns]
        for name, values, limit in (
            ("advance", advances, MAX_ADVANCE),
            ("tactical diameter", diameters, MAX_TACTICAL_DIAMETER),
        ):
            ratios = [value / length for value in values if value is not None]
            greatest_ratio = max(ratios) if len(ratios) == len(values) else None
            criteria.append(Criterion(name=name, value=greatest_ratio, limit=limit, unit="L"))
    if zigzag_10 is not None:
        ratio = length / zigzag_10.approach_speed
        distance = zigzag_10.initial_turning_distance
        criteria += [
            Criterion(
                name="initial turning, distance to 10°",
                value=None if distance is None else distance / length,
                limit=MAX_INITIAL_TURNING,
                unit="L",
            ),
            Criterion(
                name="first overshoot 10/10",
                value=_overshoot(zigzag_10, 0),
                limit=first_overshoot_limit(ratio),
                unit="deg",
            ),
            Criterion(
                name="second overshoot 10/10",
                value=_overshoot(zigzag_10, 1),
                limit=second_overshoot_limit(ratio),
                unit="deg",
            ),
        ]
    if zigzag_20 is not None:
        value = _overshoot(zigzag_20, 0)
        criteria.append(
            Criterion(name="first overshoot 20/20", value=value, limit=MAX_OVERSHOOT_20, unit="deg")
        )
    if stop is not None:
        reach = None if stop.track_reach is None else stop.track_reach / length
        criteria.append(Criterion(name="track reach", value=reach, limit=MAX_TRACK_REACH, unit="L"))
    return tuple(criteria)


def _overshoot(zigzag: ZigZag, index: int) -> float | None:
    overshoots = zigzag.overshoots
    return math.degrees(overshoots[index].angle) if index < len(overshoots) else None
