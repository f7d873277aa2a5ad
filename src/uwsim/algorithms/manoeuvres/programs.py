"""The programs of standard manoeuvres: which rudder angle and thrust they order, and when.

A program is a law without knowledge of topics or vehicles. Angles are positive to starboard: a
positive rudder turns the bow to starboard.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

TURNED_AT_END = 4.0 * math.pi
"""The change of heading at which a turning circle ends: two circles, the second is steady [rad]."""
N_EXECUTIONS = 5
"""The number of executions of a zig-zag; its last overshoot is not measured to the end."""
STOP_SHARE = 0.05
"""The share of the first speed that a vehicle goes astern at the end of a crash stop [1]."""


@dataclass(frozen=True, kw_only=True)
class Motion:
    """The motion that a program reads."""

    time: float
    """The time since the beginning of the program [s]."""
    heading_change: float
    """The change of heading since the beginning, without jumps [rad]."""
    yaw_rate: float
    """The yaw rate [rad/s]."""
    speed: float
    """The speed along the heading [m/s]."""


@dataclass(frozen=True, kw_only=True)
class Order:
    """An order of a program."""

    rudder: float
    """The rudder angle [rad]."""
    thrust: float = 1.0
    """The thrust: 1 ahead, as in the approach; -1 full astern; 0 none."""


@dataclass(frozen=True, kw_only=True)
class Hold:
    """A time in which a program held a rudder angle or a yaw rate."""

    begin: float
    """The beginning [s]."""
    end: float
    """The end [s]."""


class Program(Protocol):
    """A manoeuvre: orders as a function of the motion."""

    @property
    def is_finished(self) -> bool:
        """The state of the program: True after its last order."""

    @property
    def hold_intervals(self) -> Sequence[Hold]:
        """The times of steady states, finished ones only."""

    def step(self, motion: Motion) -> Order:
        """Return the order at a time; times rise from call to call."""


class TurningCircle:
    """A turning circle: the rudder is put over and held for two circles.

    Args:
        rudder: the rudder angle [rad].
    """

    def __init__(self, rudder: float) -> None:
        self._rudder = rudder
        self.is_finished = False
        self.hold_intervals: tuple[Hold, ...] = ()

    def step(self, motion: Motion) -> Order:
        """Return the order; see `Program`."""
        self.is_finished = abs(motion.heading_change) >= TURNED_AT_END
        return Order(rudder=self._rudder)


class ZigZag:
    """A zig-zag: the rudder is reversed whenever the heading has changed by an angle.

    Args:
        rudder: the rudder angle of the first execution [rad].
        heading: the change of heading at which the rudder is reversed [rad].
    """

    def __init__(self, rudder: float, heading: float) -> None:
        self._rudder, self._heading = rudder, heading
        self._n_executions = 1
        self._peak = 0.0
        self.is_finished = False
        self.hold_intervals: tuple[Hold, ...] = ()

    def step(self, motion: Motion) -> Order:
        """Return the order; see `Program`."""
        side = math.copysign(1.0, self._rudder)
        if self._n_executions < N_EXECUTIONS:
            if side * motion.heading_change >= self._heading:
                self._rudder = -self._rudder
                self._n_executions += 1
        else:
            self._peak = max(self._peak, -side * motion.heading_change)
            self.is_finished = -side * motion.heading_change < self._peak - 0.2 * self._heading
        return Order(rudder=self._rudder)


class Spiral:
    """A direct spiral: rudder angles one after the other, each held for a time.

    Args:
        rudders: the rudder angles, from one side to the other and back [rad].
        hold_time: the time for each angle [s].
    """

    def __init__(self, rudders: Sequence[float], hold_time: float) -> None:
        self._rudders, self._hold_time = tuple(rudders), hold_time
        self.is_finished = False
        self.hold_intervals: tuple[Hold, ...] = ()

    def step(self, motion: Motion) -> Order:
        """Return the order; see `Program`."""
        index = int(motion.time / self._hold_time + 1e-9)
        self.hold_intervals = make_holds(min(index, len(self._rudders)), self._hold_time)
        self.is_finished = index >= len(self._rudders)
        return Order(rudder=self._rudders[min(index, len(self._rudders) - 1)])


class ReverseSpiral:
    r"""A reverse spiral: yaw rates one after the other, each held by a helmsman for a time.

    The helmsman is a proportional-integral law on the yaw rate,
    :math:`\delta = k (e + \int e \, dt / T)` with the error e.

    Args:
        rates: the yaw rates [rad/s].
        hold_time: the time for each rate [s].
        gain: the gain k [s].
        integral_time: the time T [s].
        limit: the greatest rudder angle [rad].
    """

    def __init__(
        self,
        rates: Sequence[float],
        hold_time: float,
        *,
        gain: float,
        integral_time: float,
        limit: float,
    ) -> None:
        self._rates, self._hold_time = tuple(rates), hold_time
        self._gain, self._integral_time, self._limit = gain, integral_time, limit
        self._integral = 0.0  # [rad]
        self._last_time = 0.0  # [s]
        self.is_finished = False
        self.hold_intervals: tuple[Hold, ...] = ()

    def step(self, motion: Motion) -> Order:
        """Return the order; see `Program`."""
        index = int(motion.time / self._hold_time + 1e-9)
        self.hold_intervals = make_holds(min(index, len(self._rates)), self._hold_time)
        self.is_finished = index >= len(self._rates)
        error = self._rates[min(index, len(self._rates) - 1)] - motion.yaw_rate
        integral = self._integral + error * (motion.time - self._last_time)
        self._last_time = motion.time
        rudder = self._gain * (error + integral / self._integral_time)
        if abs(rudder) <= self._limit or rudder * error < 0.0:
            self._integral = integral
        return Order(rudder=min(max(rudder, -self._limit), self._limit))


class PullOut:
    """A pull-out: a steady turn, then the rudder is put to its neutral angle.

    The second hold begins with the neutral angle.

    Args:
        rudder: the rudder angle of the turn [rad].
        neutral: the neutral rudder angle [rad].
        hold_time: the time of the turn, and that after it [s].
    """

    def __init__(self, rudder: float, neutral_angle: float, hold_time: float) -> None:
        self._rudder, self._neutral_angle, self._hold_time = rudder, neutral_angle, hold_time
        self.is_finished = False
        self.hold_intervals: tuple[Hold, ...] = ()

    def step(self, motion: Motion) -> Order:
        """Return the order; see `Program`."""
        index = int(motion.time / self._hold_time + 1e-9)
        self.hold_intervals = make_holds(min(index, 2), self._hold_time)
        self.is_finished = index >= 2
        return Order(rudder=self._rudder if index == 0 else self._neutral_angle)


class CrashStop:
    """A crash stop: full thrust astern, the rudder amidships, until the vehicle goes astern."""

    def __init__(self) -> None:
        self._first_speed: float | None = None
        self.is_finished = False
        self.hold_intervals: tuple[Hold, ...] = ()

    def step(self, motion: Motion) -> Order:
        """Return the order; see `Program`."""
        if self._first_speed is None:
            self._first_speed = motion.speed
        self.is_finished = motion.speed < -STOP_SHARE * self._first_speed
        return Order(rudder=0.0, thrust=-1.0)


def make_holds(n: int, hold_time: float) -> tuple[Hold, ...]:
    """Return the first n holds of equal duration [s]."""
    return tuple(Hold(begin=k * hold_time, end=(k + 1) * hold_time) for k in range(n))
