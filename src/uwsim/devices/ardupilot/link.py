"""The live connection of a vehicle to ArduPilot."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...autopilots.ardupilot import Answer, encode_answer
from ...base.geodesy import Geodetic
from ...base.geometry import Array
from ...base.record import Record
from ...base.sampling import Sampler
from ...messages import BatteryState, Range
from ...vehicle import Vehicle
from ..device import Device
from .body_state import split_sample
from .channels import ServoOutputs
from .exchange import Exchange, ExchangeState


@dataclass(frozen=True, eq=False)
class Geography:
    """The position of the scene on Earth."""

    origin: Geodetic
    """The position of the origin of W."""
    home: Array
    """The position of home in W, (3,) [m]."""

    def geodetic_position(self, position: list[float]) -> tuple[float, float, float]:
        """Return latitude, longitude [deg], altitude [m] of a point north, east, down of home."""
        east, north, up = self.home.tolist()
        point = np.array([position[0] + north, position[1] + east, position[2] - up])
        geodetic = self.origin.position_at(point)
        return (
            math.degrees(geodetic.latitude),
            math.degrees(geodetic.longitude),
            geodetic.altitude,
        )


class StartPose:
    """The pose and the joints of a vehicle at its start.

    Args:
        vehicle: the vehicle, at its start.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self._world_from_base, self._joints = vehicle.world_from_base, vehicle.joints

    def restore(self) -> None:
        """Set the vehicle back to its start, at rest."""
        self._vehicle.place(self._world_from_base)
        if len(self._joints):
            self._vehicle.set_joints(self._joints)


@dataclass(slots=True)
class LinkState(Record):
    """The state of a connection to ArduPilot."""

    exchange: ExchangeState
    """The state of the exchange of packets."""
    ranges: list[float | None]
    """The last distance of each rangefinder [m]; None before its first measurement."""
    battery: tuple[float, float] | None = None
    """The voltage [V] and the current [A] of the battery; None before its first message."""
    n_resets: int = 0
    """The number of new starts of ArduPilot whose effect was applied."""


class ArduPilotLink(Device):
    """A connection to ArduPilot, in lock-step.

    At the beginning of a step that is due, `step` waits for ArduPilot's packet and applies it. At
    the end of the step before the next one that is due, `animate` sends the answer. So the
    programs of several vehicles compute at the same time, and each has answered before simulation
    time advances.

    Args:
        outputs: the servo outputs.
        sampler: the sampler of the vehicle's motion (`body_sampler`).
        exchange: the exchange of packets.
        geography: the position on Earth, to send latitude and longitude; None: metres from home.
        n_steps: the number of steps between exchanges.
        timestep: the length of a step [s].
        wind: the wind that is sent, NED [m/s]; None: none.
        n_ranges: the number of rangefinders.
        reset: the function that sets the vehicle back after a new start of ArduPilot; None: none.
    """

    def __init__(
        self,
        outputs: ServoOutputs,
        sampler: Sampler,
        exchange: Exchange,
        *,
        geography: Geography | None,
        n_steps: int,
        timestep: float,
        wind: tuple[float, float, float] | None,
        n_ranges: int,
        reset: Callable[[], None] | None = None,
    ) -> None:
        self._outputs, self._sampler, self._exchange = outputs, sampler, exchange
        self._geography, self._n_steps, self._timestep = geography, n_steps, timestep
        self._wind, self._reset = wind, reset
        self.state: LinkState = LinkState(exchange.state, [None] * n_ranges)

    def _is_due(self, time: float) -> bool:
        return round(time / self._timestep) % self._n_steps == 0

    def idle_until(self, time: float) -> float:
        """Return the time of the next exchange after the step at ``time`` [s]."""
        n_exchanges = round(time / self._timestep) // self._n_steps
        return (n_exchanges + 1) * self._n_steps * self._timestep

    def step(self, time: float) -> None:
        """Wait for the packet that is due, and apply its pulse widths.

        Raises:
            ClientLost: ArduPilot is silent, or was started again.
        """
        if not self._is_due(time):
            return
        last_pwm = self.state.exchange.pwm
        self._exchange.wait_for_packet(time)
        if self.state.n_resets < self.state.exchange.n_restarts:
            self.state.n_resets = self.state.exchange.n_restarts
            if self._reset is not None:
                self._reset()
        self._outputs.apply(self.state.exchange.pwm, last_pwm)

    def animate(self, time: float) -> None:
        """Send the answer that is due at ``time`` [s]."""
        if self.state.exchange.is_pending and self._is_due(time):
            self._exchange.send_answer(encode_answer(self._make_answer(time)))

    def _make_answer(self, time: float) -> Answer:
        position, quaternion, velocity, gyro, force = split_sample(self._sampler.take(time))
        if self._geography is not None:
            position = self._geography.geodetic_position(list(position))
        return Answer(
            timestamp=time,
            gyro=gyro,
            specific_force=force,
            position=position,
            quaternion=quaternion,
            velocity=velocity,
            is_geodetic=self._geography is not None,
            ranges=self.state.ranges,
            battery=self.state.battery,
            wind=self._wind,
        )

    def set_range(self, index: int, message: Range) -> None:
        """Store the distance of a rangefinder."""
        self.state.ranges[index] = float(message.range)

    def set_battery(self, message: BatteryState) -> None:
        """Store the voltage and the current of the battery; a current that is drawn is positive."""
        self.state.battery = float(message.voltage), -float(message.current)

    def describe(self) -> str:
        """Return a sentence about the exchange."""
        return self._exchange.describe()
