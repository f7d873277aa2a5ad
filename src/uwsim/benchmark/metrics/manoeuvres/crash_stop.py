r"""The crash stop: how far a vehicle goes until full thrust astern has stopped it.

The thrust is reversed at full speed ahead, with the rudder amidships, until the vehicle no longer
moves ahead. After IMO resolution MSC.137(76):

- *track reach*: the distance along the path;
- *head reach*: the distance along the original course;
- *lateral deviation*: the distance to starboard of the original course.

For a body of the mass m (with added mass) with quadratic drag :math:`c u^2` and a constant thrust T
astern, :math:`m \dot u = -c u^2 - T` gives the closed forms

.. math::
    s = \frac{m}{2 c} \ln\left(1 + \frac{c U^2}{T}\right) \qquad
    t = \frac{m}{\sqrt{c T}} \arctan\left(U \sqrt{c / T}\right)
"""

from __future__ import annotations

from dataclasses import dataclass

from .track import ManoeuvreTrack, first_crossing, value_at


@dataclass(frozen=True, kw_only=True)
class CrashStop:
    """The numbers of a crash stop; None if the vehicle did not stop."""

    approach_speed: float
    """The speed when the thrust was reversed [m/s]."""
    track_reach: float | None
    """The distance along the path [m]."""
    head_reach: float | None
    """The distance along the original course [m]."""
    lateral_deviation: float | None
    """The distance to starboard of the original course [m]."""
    time: float | None
    """The time until the vehicle no longer moves ahead [s]."""
    heading_change: float | None
    """The change of heading, positive to starboard [rad]."""


def measure_crash_stop(track: ManoeuvreTrack) -> CrashStop:
    """Compute the numbers of a crash stop from its track."""
    stop = first_crossing(-track.surge[track.start :], 0.0)
    if stop is None:
        return CrashStop(
            approach_speed=track.approach_speed, track_reach=None, head_reach=None,
            lateral_deviation=None, time=None, heading_change=None,
        )  # fmt: skip
    return CrashStop(
        approach_speed=track.approach_speed,
        track_reach=value_at(track.path_lengths, stop),
        head_reach=value_at(track.course[:, 0], stop),
        lateral_deviation=value_at(track.course[:, 1], stop),
        time=value_at(track.run_times, stop),
        heading_change=value_at(track.heading_change, stop),
    )
