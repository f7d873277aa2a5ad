r"""The zig-zag manoeuvre: how fast a vehicle answers its rudder, and how well it checks a turn.

In a zig-zag :math:`\delta / \psi` the rudder is put to :math:`\delta`; when the heading has changed
by :math:`\psi`, it is reversed, and so on (Kempf 1932; IMO resolution MSC.137(76)):

- *execution*: each order of the rudder; the first one begins the manoeuvre;
- *initial turning time*: from the first to the second execution, and the distance travelled in it;
- *overshoot*: the greatest change of heading after an execution, less :math:`\psi`. The first one
  is that after the second execution;
- *time to check yaw*: from an execution to the greatest change of heading;
- *period*: from the second to the fourth execution, a full cycle.

Changes of heading count from the heading of the approach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .track import ManoeuvreTrack


@dataclass(frozen=True, kw_only=True)
class Overshoot:
    """An overshoot of a zig-zag."""

    angle: float
    """The overshoot angle [rad]."""
    time_to_check: float
    """The time from the execution to the greatest change of heading [s]."""
    execution_time: float
    """The time of the execution, from the beginning on [s]."""
    peak_time: float
    """The time of the greatest change of heading, from the beginning on [s]."""
    peak: float
    """The greatest change of heading, positive to starboard [rad]."""


@dataclass(frozen=True, kw_only=True)
class ZigZag:
    """The numbers of a zig-zag; None where the vehicle did not get so far."""

    rudder: float
    """The rudder angle that was ordered first, positive to starboard [rad]."""
    heading: float
    """The change of heading at which the rudder is reversed [rad]."""
    approach_speed: float
    """The speed at the first execution [m/s]."""
    initial_turning_time: float | None
    """The time to the second execution [s]."""
    initial_turning_distance: float | None
    """The distance travelled to the second execution [m]."""
    overshoots: tuple[Overshoot, ...]
    """The overshoots, in the order of time."""
    period: float | None
    """The period, from the second to the fourth execution [s]."""
    depth_change: float
    """The greatest change of depth [m]."""


def measure_zigzag(track: ManoeuvreTrack, heading: float) -> ZigZag:
    """Compute the numbers of a zig-zag from its track.

    Args:
        track: the track, whose `rudders` change at each execution.
        heading: the change of heading at which the rudder was reversed [rad].
    """
    rudders = track.rudders[track.start :]
    times = track.run_times
    signs = np.sign(rudders)
    first = int(np.flatnonzero(signs)[0]) if signs.any() else 0
    switches = first + 1 + np.flatnonzero(np.diff(signs[first:]))
    executions = [int(k) for k in switches]
    ends = [*executions[1:], len(times)] if executions else []
    overshoots = []
    for begin, end in zip(executions, ends, strict=True):
        side = float(signs[begin - 1])
        heading_change = side * track.heading_change[begin:end]
        k = int(heading_change.argmax())
        if k == len(heading_change) - 1 and end == len(times):
            break  # the record ends before the turn is checked
        time, peak = refine_peak(times[begin:end], heading_change, k)
        overshoots.append(
            Overshoot(
                angle=peak - heading,
                time_to_check=time - float(times[begin]),
                execution_time=float(times[begin]),
                peak_time=time,
                peak=side * peak,
            )
        )
    second = executions[0] if executions else None
    return ZigZag(
        rudder=float(rudders[first]),
        heading=heading,
        approach_speed=track.approach_speed,
        initial_turning_time=None if second is None else float(times[second]),
        initial_turning_distance=None if second is None else float(track.path_lengths[second]),
        overshoots=tuple(overshoots),
        period=float(times[executions[2]] - times[executions[0]]) if len(executions) > 2 else None,
        depth_change=track.depth_change,
    )


def refine_peak(times: np.ndarray, values: np.ndarray, k: int) -> tuple[float, float]:
    """Return time and value of a peak near sample k, by a parabola through three samples."""
    if not 0 < k < len(values) - 1:
        return float(times[k]), float(values[k])
    first_value, peak, last_value = (float(values[i]) for i in (k - 1, k, k + 1))
    curvature = first_value - 2.0 * peak + last_value
    if curvature >= 0.0:
        return float(times[k]), peak
    shift = 0.5 * (first_value - last_value) / curvature
    step = 0.5 * float(times[k + 1] - times[k - 1])
    return float(times[k]) + shift * step, peak - 0.25 * (first_value - last_value) * shift
