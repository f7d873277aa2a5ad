r"""The poses of a real vehicle as they arrive: checks, prediction, delays and silences.

A pose that was measured a delay :math:`d` before its arrival, and arrived an age :math:`a` ago, is
moved on by the twist :math:`(v, \omega)` in base axes:

.. math::
    \tau = \min(d + a, h), \qquad
    p' = p + R\, v\, \tau, \qquad R' = R\, \exp(\omega\, \tau)

with the horizon :math:`h`. Without a twist in the message it is the difference from the last pose.
Not modelled: acceleration during the prediction, and the noise of the poses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from ...base.geometry import Array, Pose, quaternion_from_rotation, rotation_about
from ...base.numerics.elementwise import arccos
from ...base.numerics.linear import length, product, rotate, rotate_back
from ...base.record import Record

MAX_POSES_PER_STEP = 100
"""The greatest number of poses that are used in one step; more are counted and left out."""
JUMP_MARGIN = 0.5
"""The distance that a pose may be away beyond the greatest speed [m]."""
N_CONSISTENT_JUMPS = 5
"""The number of consecutive poses at a new place after which the vehicle is moved there."""
MAX_TURN_RATE = 20.0
"""The greatest angular velocity that is used for prediction [rad/s]."""
MAX_STAMP = 1e10
"""The greatest time that is taken for a stamp [s]: the year 2286 after 1970."""
MIN_INTERVAL = 1e-3
"""The shortest interval from which a velocity is computed [s]."""
DELAY_BIN = 0.001
"""The width of a bin of delays [s]."""
N_DELAY_BINS = 2001
"""The number of bins of delays; the middle one is the delay of the first pose."""


@dataclass(frozen=True, kw_only=True)
class FilterSettings:
    """The settings of a filter of poses."""

    delay: float = 0.0
    """The time between the measurement of a pose and its arrival [s]."""
    horizon: float = 0.3
    """The longest time over which a pose is predicted [s]."""
    timeout: float = 0.5
    """The time without a pose after which the last one is stale [s]."""
    max_speed: float = 10.0
    """The greatest speed of the vehicle [m/s]."""


@dataclass(frozen=True, eq=False)
class MeasuredPose:
    """A pose that arrived."""

    pose: Pose
    """The pose of the base in W."""
    arrival_time: float
    """The simulation time of its arrival [s]."""
    stamp: float | None = None
    """The time of the measurement on the sender's clock [s]; None: it has none."""
    twist: tuple[float, ...] | None = None
    """The linear and angular velocity in base axes (6,) [m/s, rad/s]; None: it has none."""


@dataclass(slots=True)
class PoseFilterState(Record):
    """The state of a filter of poses."""

    last_pose: MeasuredPose | None = None
    """The newest accepted pose."""
    last_jump: MeasuredPose | None = None
    """The newest pose that was rejected as a jump; None after an accepted one."""
    n_consecutive_jumps: int = 0
    """The number of consecutive poses at the new place."""
    n_received: int = 0
    """The number of poses received."""
    n_invalid: int = 0
    """The number of poses that were not finite, or too far away."""
    n_jumps: int = 0
    """The number of poses that were rejected as jumps."""
    n_excess: int = 0
    """The number of poses left out because too many arrived in one step."""
    n_relocations: int = 0
    """The number of times that the vehicle was moved to a new place."""
    n_invalid_stamps: int = 0
    """The number of poses whose stamp was 0, negative or after `MAX_STAMP`; they have no delay."""
    n_timeouts: int = 0
    """The number of times that the poses became stale."""
    longest_silence: float = 0.0
    """The longest time between two accepted poses [s]."""
    first_delay: float | None = None
    """The arrival time minus the stamp of the first pose [s]; None: no pose had a stamp."""
    delay_counts: list[int] = field(default_factory=lambda: [0] * N_DELAY_BINS)
    """The number of poses by the difference of their delay from the first one."""
    step_time: float = -1.0
    """The time of the step in which poses are counted [s]."""
    n_in_step: int = 0
    """The number of poses in this step."""
    has_relocated: bool = False
    """True if the vehicle has not been placed since it was moved to a new place."""


class PoseFilter:
    """A filter of the poses of a real vehicle."""

    def __init__(self, settings: FilterSettings) -> None:
        self._settings = settings
        self.state = PoseFilterState()
        """The state: the newest pose, and the counts for the report."""

    def reject_invalid(self) -> None:
        """Count a pose that is not finite."""
        self.state.n_received += 1
        self.state.n_invalid += 1

    def accept(self, pose: MeasuredPose) -> bool:
        """Check a pose and store it; return False if it is rejected."""
        state = self.state
        state.n_received += 1
        if state.step_time != pose.arrival_time:
            state.step_time, state.n_in_step = pose.arrival_time, 0
        state.n_in_step += 1
        if state.n_in_step > MAX_POSES_PER_STEP:
            state.n_excess += 1
            return False
        if pose.stamp is not None and not 0.0 < pose.stamp <= MAX_STAMP:
            state.n_invalid_stamps += 1
            pose = replace(pose, stamp=None)
        self._count_delay(pose)
        last_pose = state.last_pose
        if last_pose is not None and not self._is_reachable(last_pose, pose):
            state.n_jumps += 1
            is_consistent = state.last_jump is not None and self._is_reachable(
                state.last_jump, pose
            )
            state.n_consecutive_jumps = state.n_consecutive_jumps + 1 if is_consistent else 1
            state.last_jump = pose
            if state.n_consecutive_jumps < N_CONSISTENT_JUMPS:
                return False
            state.n_relocations += 1
            state.has_relocated = True
            last_pose = None
        elif last_pose is not None:
            silence = pose.arrival_time - last_pose.arrival_time
            state.longest_silence = max(state.longest_silence, silence)
            state.n_timeouts += silence > self._settings.timeout
        state.last_jump, state.n_consecutive_jumps = None, 0
        state.last_pose = self._add_twist(last_pose, pose)
        return True

    def is_stale(self, time: float) -> bool:
        """Return whether no pose has arrived for longer than the timeout at a time [s]."""
        last_pose = self.state.last_pose
        return last_pose is None or time - last_pose.arrival_time > self._settings.timeout

    def predict(self, time: float) -> Pose | None:
        """Return the pose in W at a time [s]; None before the first pose."""
        measurement = self.state.last_pose
        if measurement is None:
            return None
        age = max(time - measurement.arrival_time, 0.0)
        interval = min(self._settings.delay + age, self._settings.horizon)
        if measurement.twist is None or interval <= 0.0:
            return measurement.pose
        linear, angular = np.array(measurement.twist[:3]), np.array(measurement.twist[3:])
        position = measurement.pose.position + rotate(measurement.pose.rotation, linear) * interval
        rate = length(angular)
        if rate * interval < 1e-12:
            return Pose(position, measurement.pose.rotation)
        turn = rotation_about(angular / rate, rate * interval)
        return Pose(position, product(measurement.pose.rotation, turn))

    def _is_reachable(self, start: MeasuredPose, end: MeasuredPose) -> bool:
        interval = end.arrival_time - start.arrival_time
        distance = length(end.pose.position - start.pose.position)
        return distance <= self._settings.max_speed * interval + JUMP_MARGIN

    def _add_twist(self, last_pose: MeasuredPose | None, pose: MeasuredPose) -> MeasuredPose:
        """Return the pose with a twist: that of its message, or of the last two poses."""
        twist = pose.twist
        if twist is not None and self._is_plausible(np.array(twist)):
            return pose
        without_twist = MeasuredPose(pose.pose, pose.arrival_time, pose.stamp)
        if last_pose is None:
            return without_twist
        interval = pose.arrival_time - last_pose.arrival_time
        if pose.stamp is not None and last_pose.stamp is not None:
            interval = pose.stamp - last_pose.stamp
        if interval < MIN_INTERVAL:
            return MeasuredPose(pose.pose, pose.arrival_time, pose.stamp, last_pose.twist)
        numbers = compute_twist(last_pose.pose, pose.pose, interval)
        if not self._is_plausible(numbers):
            return without_twist
        return MeasuredPose(pose.pose, pose.arrival_time, pose.stamp, tuple(numbers.tolist()))

    def _is_plausible(self, twist: Array) -> bool:
        return bool(
            np.isfinite(twist).all()
            and length(twist[:3]) <= self._settings.max_speed
            and length(twist[3:]) <= MAX_TURN_RATE
        )

    def _count_delay(self, pose: MeasuredPose) -> None:
        if pose.stamp is None:
            return
        delay = pose.arrival_time - pose.stamp
        if self.state.first_delay is None:
            self.state.first_delay = delay
        middle = N_DELAY_BINS // 2
        offset = (delay - self.state.first_delay) / DELAY_BIN
        index = middle + round(max(min(offset, middle), -middle))
        self.state.delay_counts[index] += 1


def compute_twist(start: Pose, end: Pose, interval: float) -> Array:
    """Return the constant twist in base axes from one pose to another, (6,) [m/s, rad/s].

    Args:
        start: the pose at the begin.
        end: the pose at the end, in whose axes the twist is.
        interval: the time between them [s].
    """
    linear = rotate_back(end.rotation, end.position - start.position) / interval
    turn = product(start.rotation.T, end.rotation)
    w, *vector = quaternion_from_rotation(turn).tolist()
    sine = length(vector)
    if sine < 1e-9:
        return np.concatenate([linear, np.zeros(3)])
    angle = 2.0 * float(arccos(max(min(w, 1.0), -1.0)))
    return np.concatenate([linear, np.array(vector) / sine * angle / interval])


@dataclass(frozen=True, kw_only=True)
class DelayStatistics:
    """The delays of poses above the smallest one, from the measurement to the arrival."""

    n: int
    """The number of poses with a stamp."""
    min_delay: float
    """The arrival time minus the stamp of the fastest pose [s]; it includes the difference of the
    clocks."""
    median_delay: float
    """The median delay above the smallest [s]."""
    high_delay: float
    """The 95th percentile of the delay above the smallest [s]."""
    max_delay: float
    """The greatest delay above the smallest [s]."""
    is_bounded: bool
    """True if all delays differ from the first one by less than the bins cover."""


def summarize_delays(state: PoseFilterState) -> DelayStatistics | None:
    """Return the statistics of the delays; None if no pose had a stamp."""
    counts = np.array(state.delay_counts)
    n = int(counts.sum())
    if state.first_delay is None or n == 0:
        return None
    bins = np.flatnonzero(counts)
    cumulative = np.cumsum(counts)
    first = int(bins[0])

    def quantile(share: float) -> float:
        return (int(np.searchsorted(cumulative, math.ceil(share * n))) - first) * DELAY_BIN

    return DelayStatistics(
        n=n,
        min_delay=state.first_delay + (first - N_DELAY_BINS // 2) * DELAY_BIN,
        median_delay=quantile(0.5),
        high_delay=quantile(0.95),
        max_delay=(int(bins[-1]) - first) * DELAY_BIN,
        is_bounded=first > 0 and int(bins[-1]) < N_DELAY_BINS - 1,
    )


def format_report(name: str, state: PoseFilterState) -> list[str]:
    """Return the lines of the report about the poses of a vehicle."""
    lines = [
        f"{name}: {state.n_received} poses received; {state.n_invalid} invalid, {state.n_jumps} "
        f"jumps, {state.n_excess} too many in one step left out; {state.n_relocations} changes of "
        "place",
        f"{name}: stale {state.n_timeouts} times; longest silence {state.longest_silence:.3f} s",
    ]
    if state.n_invalid_stamps:
        lines.append(
            f"{name}: {state.n_invalid_stamps} poses with an invalid stamp, 0 or after the year "
            "2286, used as if they had none"
        )
    delays = summarize_delays(state)
    if delays is not None:
        limit_note = "" if delays.is_bounded else ", or more: stamps differ by more than 1 s"
        lines.append(
            f"{name}: delay above the smallest ({delays.min_delay:.3f} s by both clocks): median "
            f"{1e3 * delays.median_delay:.0f} ms, 95 % {1e3 * delays.high_delay:.0f} ms, greatest "
            f"{1e3 * delays.max_delay:.0f} ms{limit_note}"
        )
    return lines
