"""ardupilot: the connection of a vehicle to ArduPilot (ArduSub, ArduRover), which steers it.

.. code-block:: xml

    <u:ardupilot>
      <channel> <number>1</number> <thruster>bow_starboard</thruster> </channel>
      <channel> <number>9</number> <lamp>headlight</lamp> </channel>
      <rangefinder>/bluerov2/altitude</rangefinder>
      <battery>/bluerov2/battery</battery>
    </u:ardupilot>

ArduPilot runs as its own program, with ``--model JSON:127.0.0.1``. It is connected only in a run
with ``--ardupilot`` (or ``udp_address`` in Python); in all other runs the element has no effect.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from ...base.geometry import ZERO, Triple
from ...messages import BatteryState, Range
from ...schema import MAX_DISTANCE, element
from ...world import DeviceWorld, MovingBody
from ..applied_commands import AppliedCommands
from ..device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .body_state import body_sampler, is_base_z_down
from .channels import ChannelSpec, bind_channels
from .exchange import Exchange
from .link import ArduPilotLink, Geography, StartPose

FIRST_PORT, PORTS_PER_INSTANCE = 9002, 10
"""The port of instance 0, and the distance to that of the next instance: ArduPilot's defaults."""
HINT = "sim_vehicle.py -v ArduSub -f vectored_6dof --model JSON:127.0.0.1"
"""The example of a command that starts ArduPilot."""


@dataclass(frozen=True, kw_only=True)
class ArduPilotSpec(DeviceSpec):
    """A ``<u:ardupilot>``.

    In lock-step, simulation time waits for ArduPilot, and ArduPilot for the simulation. Without
    ``<channel>`` elements, channel n drives the n-th thruster of the hydrodynamics file. Each
    exchange publishes the applied commands on ``<vehicle>/autopilot/thrusters``.
    """

    instance: int = element(default=0, minimum=0, maximum=99)
    """The number of the ArduPilot instance (``-I``); the port is 9002 + 10 times this number."""
    port: int | None = element(default=None, minimum=1, maximum=65535)
    """The UDP port, instead of that of the instance."""
    rate: float = element(default=400.0, minimum=20.0, maximum=10000.0)
    """The rate of exchanges; the nearest one that is a whole number of steps applies [Hz]."""
    axes: Literal["start", "frd", "flu"] = "start"
    """The axes of the base: ``frd`` (x forward, y starboard, z down), ``flu`` (x forward, y port,
    z up), or those that point this way at the ``start``."""
    home: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The position in L that ArduPilot takes for its home, where depth is 0 [m]."""
    position: Literal["local", "geodetic"] = "local"
    """The form of the position: metres from home, or latitude, longitude and altitude (ArduPilot of
    2026 or later)."""
    timeout: float = element(default=60.0, exclusive_minimum=0.0, maximum=86400.0)
    """The longest silence of ArduPilot, after which the run ends as invalid [s of wall time]."""
    on_restart: Literal["continue", "reset", "end"] = "continue"
    """The effect of a new start of ArduPilot during a run: the simulation continues; the vehicle is
    set back to its start, at rest, and time continues; or the run ends as invalid."""
    wind: Triple | None = element(default=None, minimum=-100.0, maximum=100.0)
    """The velocity of the wind that ArduPilot is sent: north, east, down; no force [m/s]."""
    channels: tuple[ChannelSpec, ...] = element("channel", default=())
    """The channels."""
    rangefinders: tuple[str, ...] = element("rangefinder", default=())
    """The topics of up to six range sensors, sensor_msgs/Range, for rng_1, rng_2, ..."""
    battery: str | None = None
    """The topic of the battery, sensor_msgs/BatteryState."""

    @property
    def udp_port(self) -> int:
        """The UDP port."""
        return self.port or FIRST_PORT + PORTS_PER_INSTANCE * self.instance

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of the rangefinders and the battery."""
        topics: list[tuple[str, type, str]] = [
            (name, Range, "rangefinder") for name in self.rangefinders
        ]
        if self.battery is not None:
            topics.append((self.battery, BatteryState, "battery"))
        return tuple(
            DeviceTopic(name=name, is_subscribed=True, message_type=type_, element=element_name)
            for name, type_, element_name in topics
        )

    def count_steps(self, timestep: float) -> int:
        """Return the number of steps between exchanges."""
        return max(1, round(1.0 / (self.rate * timestep)))

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Device:
        """Resolve the channels, and open the port if the simulation has connections.

        Raises:
            UnknownName: a thruster or a joint is unknown.
            SceneError: a channel is invalid.
            UwsimError: the port is not free.
        """
        publish = None
        if world.connections is not None and vehicle.autopilot is not None:
            publish = AppliedCommands(world.bus, vehicle).publish
        outputs = bind_channels(self.channels, world, vehicle, publish)
        home = world.world_from_localized.transform(np.array(self.home))
        start = vehicle.world_from_base.rotation
        is_z_down = is_base_z_down(start) if self.axes == "start" else self.axes == "frd"
        if world.connections is None:
            return Device()
        exchange = Exchange(
            world.connections.open_port(self.udp_port),
            timeout=self.timeout,
            on_restart=self.on_restart,
            hint=HINT if self.instance == 0 else f"{HINT} -I{self.instance}",
        )
        link = ArduPilotLink(
            outputs,
            body_sampler(_base_of(vehicle), home, is_z_down=is_z_down),
            exchange,
            geography=Geography(world.ned_origin, home) if self.position == "geodetic" else None,
            n_steps=self.count_steps(world.timestep),
            timestep=world.timestep,
            wind=self.wind,
            n_ranges=len(self.rangefinders),
            reset=StartPose(vehicle).restore if self.on_restart == "reset" else None,
        )
        for i, topic in enumerate(self.rangefinders):
            world.bus.subscribe(topic, Range, partial(link.set_range, i))
        if self.battery is not None:
            world.bus.subscribe(self.battery, BatteryState, link.set_battery)
        return link


@dataclass(frozen=True)
class _BasePart:
    """A part at the origin of the base."""

    relative_to: str
    position: Triple = ZERO
    orientation: Triple = ZERO


def _base_of(vehicle: DeviceVehicle) -> MovingBody:
    """Return the base frame of a vehicle with its motion."""
    base_name = vehicle.compiled_vehicle.base_mount().name
    return vehicle.moving_mount(_BasePart(base_name.removeprefix(f"{vehicle.name}/")))


def thrusters_of(devices: Iterable[ArduPilotSpec]) -> Mapping[int, tuple[str, float]]:
    """Return the thruster and the sign of its command, by number of the channel."""
    return {
        channel.number: (channel.thruster, -1.0 if channel.reversed else 1.0)
        for device in devices
        for channel in device.channels
        if channel.thruster is not None
    }
