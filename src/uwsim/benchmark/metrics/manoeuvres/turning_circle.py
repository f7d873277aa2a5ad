r"""The turning circle: how far a vehicle goes ahead and aside when its rudder is put over.

The rudder is put over at once and held until the heading has changed by 540° or more. After IMO
resolution MSC.137(76), with distances from the place at which the rudder is ordered:

- *advance*: along the original course, when the heading has changed by 90°;
- *transfer*: across the original course, when the heading has changed by 90°;
- *tactical diameter*: across the original course, when the heading has changed by 180°;
- *steady diameter*: :math:`2 U / |r|`, with the mean speed U and the mean yaw rate r of the last
  fifth of the time;
- *drift angle*: :math:`\beta = -\arctan(v / u)`, steady, positive if the bow points into the turn
  to starboard;
- *speed loss*: :math:`1 - U / U_0`, with the speed :math:`U_0` of the approach.

A turn to port has the same numbers: distances to port count as positive. Not included: the current,
which carries the track; manoeuvres are made in still water.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .track import ManoeuvreTrack, first_crossing, value_at


@dataclass(frozen=True, kw_only=True)
class TurningCircle:
    """The numbers of a turning circle; None where the vehicle did not turn far enough."""

    rudder: float
    """The ordered rudder angle, positive to starboard [rad]."""
    approach_speed: float
    """The speed when the rudder was ordered [m/s]."""
    advance: float | None
    """The advance at a change of heading of 90° [m]."""
    transfer: float | None
    """The transfer at a change of heading of 90° [m]."""
    tactical_diameter: float | None
    """The tactical diameter [m]."""
    steady_diameter: float | None
    """The diameter of the steady circle [m]; None without a steady turn."""
    time_90: float | None
    """The time to a change of heading of 90° [s]."""
    time_180: float | None
    """The time to a change of heading of 180° [s]."""
    speed_loss: float
    """The loss of speed in the steady turn, as a share of the speed of the approach [1]."""
    yaw_rate: float
    """The steady yaw rate, positive to starboard [rad/s]."""
    drift_angle: float
    """The steady drift angle [rad]."""
    depth_change: float
    """The greatest change of depth [m]."""


def measure_turning_circle(track: ManoeuvreTrack) -> TurningCircle:
    """Compute the numbers of a turning circle from its track."""
    rudder = float(track.rudders[-1])
    side = float(np.sign(track.heading_change[-1])) or 1.0
    advances, transfers = track.course[:, 0], side * track.course[:, 1]
    quarter = first_crossing(side * track.heading_change, 0.5 * math.pi)
    half = first_crossing(side * track.heading_change, math.pi)
    speed, rate = (
        track.compute_steady_mean(track.speeds),
        track.compute_steady_mean(track.yaw_rates),
    )
    drift = -math.atan2(
        track.compute_steady_mean(track.sway), track.compute_steady_mean(track.surge)
    )
    return TurningCircle(
        rudder=rudder,
        approach_speed=track.approach_speed,
        advance=None if quarter is None else value_at(advances, quarter),
        transfer=None if quarter is None else value_at(transfers, quarter),
        tactical_diameter=None if half is None else value_at(transfers, half),
        steady_diameter=2.0 * speed / abs(rate) if half is not None and rate != 0.0 else None,
        time_90=None if quarter is None else value_at(track.run_times, quarter),
        time_180=None if half is None else value_at(track.run_times, half),
        speed_loss=1.0 - speed / track.approach_speed if track.approach_speed > 0.0 else 0.0,
        yaw_rate=rate,
        drift_angle=drift,
        depth_change=track.depth_change,
    )
