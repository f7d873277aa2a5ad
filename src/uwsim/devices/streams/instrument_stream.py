"""A sensor that sends the bytes of a real instrument on a serial line or in the network.

.. code-block:: xml

    <vehicle> ...
      <u:instrumentStream>
        <name>gps_line</name> <topic>/rov/gps</topic> <format>GGA RMC</format>
        <address>udpout:127.0.0.1:9110</address>
      </u:instrumentStream>
      <u:instrumentStream>
        <name>dvl_line</name> <topic>/rov/dvl</topic> <format>PD4</format>
        <address>serial:/dev/ttyUSB0:115200</address> <bitRate>115200</bitRate>
      </u:instrumentStream>
      <u:instrumentStream>
        <name>usbl</name> <format>PSONLLD</format> <rate>0.5</rate> <std>0.3</std>
        <address>pty:/tmp/usbl</address>
      </u:instrumentStream>
    </vehicle>

Each message of the topic is sent once, at its time, with the topic's rate and the sensor's noise
and faults. The bytes are a function of the simulation: times are the simulation time after
``epoch``. A stream exists if the simulation has connections; ``bytesTopic`` exists always.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...autopilots.instruments.utc import parse_epoch
from ...base.record import Record
from ...errors import UnknownName
from ...messages import UInt8MultiArray
from ...schema import MAX_DISTANCE, element
from ...world import ByteStream, DeviceWorld, TerminalStream
from ..device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .endpoint import describe_endpoint_errors, raise_stream_errors
from .formats import BEACON_FORMATS, FORMATS, Format, Sample
from .measurements import InstrumentCarrier, is_base_z_down
from .observer import StreamObserver
from .serial_line import LineState, SerialLine

MAX_FORMATS = 8
"""The greatest number of formats of a stream."""


@dataclass(frozen=True, kw_only=True)
class InstrumentStreamSpec(DeviceSpec):
    """A ``<u:instrumentStream>``."""

    name: str
    """The name of the stream, for reports; for acoustic positioning, the name of the beacon."""
    format: str
    """The format, or several for one type of sensor: ``GGA``, ``RMC``, ``VTG``, ``GSA`` and ``ZDA``
    of a GPS; ``HDT``, ``PRDID`` and ``PASHR`` of an IMU; ``ISDPT`` of a pressure sensor; ``DBT``
    and ``DPT`` of a range sensor; ``PD4``, ``PD4EARTH``, ``PD6``, ``DVPDL`` and ``WRZ`` of a DVL;
    ``PSONLLD`` or ``PSIMSSB`` for the position of the vehicle by acoustics."""
    topic: str = ""
    """The topic of the sensor; acoustic positioning has none."""
    address: str = ""
    """The address of the other side: ``udpout:HOST:PORT``, ``tcpin:HOST:PORT``, ``tcp:HOST:PORT``,
    ``serial:PATH:BIT_RATE``, ``pty`` or ``pty:LINK``; empty: the bytes topic only."""
    bytes_topic: str = ""
    """The topic on which the bytes are published as well, for recordings; empty: none."""
    epoch: str = "2026-01-01T00:00:00Z"
    """The date and time at the start of the simulation."""
    bit_rate: int | None = element(default=None, minimum=50, maximum=10_000_000)
    """The bit rate at which a serial line delays messages [bit/s]; by default there is no delay."""
    buffer: int = element(default=4096, minimum=64, maximum=1_000_000)
    """The number of bytes that may wait for the line; a message that does not fit is lost
    [bytes]."""
    beam_angle: float = element(default=30.0, exclusive_minimum=0, maximum=60)
    """The angle from the axis of a DVL to its beams, for the vertical ranges of ``PD4`` [deg]."""
    measures_pressure: bool = False
    """True if the pressure sensor measures an absolute pressure instead of a depth."""
    rate: float = element(default=1.0, minimum=0.001, maximum=100.0)
    """The rate of acoustic positioning [Hz]; other streams have the rate of their topic."""
    std: float = element(default=0.0, minimum=0.0, maximum=1000.0)
    """The standard deviation of each coordinate of acoustic positioning [m]."""
    transceiver: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the transceiver in L, for ``PSIMSSB``; its bow points north [m]."""

    @property
    def formats(self) -> tuple[str, ...]:
        """The names of the formats."""
        return tuple(self.format.upper().split())

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic of the sensor, and that of the bytes."""
        topics = []
        if self.topic:
            types = [FORMATS[name].message_type for name in self.formats if name in FORMATS]
            sensor_topic = DeviceTopic(
                name=self.topic,
                is_subscribed=True,
                message_type=types[0] if types else None,
                element="topic",
            )
            topics.append(sensor_topic)
        if self.bytes_topic:
            bytes_topic = DeviceTopic(
                name=self.bytes_topic, message_type=UInt8MultiArray, element="bytesTopic"
            )
            topics.append(bytes_topic)
        return tuple(topics)

    def errors(self) -> list[str]:
        """Return the errors of formats, topic, epoch and address."""
        names, known_names = self.formats, (*FORMATS, *BEACON_FORMATS)
        errors = [
            str(UnknownName("format", name, known_names))
            for name in names
            if name not in known_names
        ]
        types = {FORMATS[name].message_type.__name__ for name in names if name in FORMATS}
        has_beacon = any(name in BEACON_FORMATS for name in names)
        if not 1 <= len(names) <= MAX_FORMATS:
            errors.append(f"<format> has {len(names)} names; expected 1 to {MAX_FORMATS}")
        if len(types) + has_beacon > 1:
            errors.append(
                f"<format> {self.format!r} needs several sensors; expected formats of one sensor"
            )
        if types and not self.topic:
            errors.append(f"<topic> is missing; expected the topic of a {min(types)}")
        if has_beacon and self.topic:
            errors.append(f"<topic> {self.topic!r} is not used by {self.format}; expected none")
        return errors + describe_endpoint_errors(self.epoch, self.address or "pty")

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> InstrumentStream:
        """Open the stream and subscribe to the topic; raise SceneError."""
        raise_stream_errors(self, "u:instrumentStream", self.errors())
        carrier = InstrumentCarrier(
            vehicle=vehicle,
            origin=world.ned_origin,
            world_from_localized=world.world_from_localized,
            epoch_us=parse_epoch(self.epoch),
            beam_angle=math.radians(self.beam_angle),
            is_z_down=is_base_z_down(vehicle),
        )
        connection = None
        if self.address and world.connections is not None:
            connection = world.connections.open(self.address)
        rng = world.stream(f"{vehicle.name}/{self.name}/position")
        stream = InstrumentStream(self, world, carrier, connection, rng)
        if connection is None and not self.bytes_topic:
            return stream
        if self.topic:
            message_type = FORMATS[self.formats[0]].message_type
            world.bus.subscribe(self.topic, message_type, stream.send_message)
        else:
            world.create_timer(self.rate, stream.send_position)
        return stream


@dataclass(slots=True)
class InstrumentStreamState(Record):
    """The state of an instrument stream."""

    line: LineState
    """The serial line."""
    rng: np.random.Generator
    """The generator of the noise of acoustic positioning."""
    last_time_us: int = -1
    """The time of the last message [us since 1970]; -1 before the first."""


class InstrumentStream(Device):
    """A stream that sends the bytes of an instrument."""

    def __init__(
        self,
        spec: InstrumentStreamSpec,
        world: DeviceWorld,
        carrier: InstrumentCarrier,
        connection: ByteStream | None,
        rng: np.random.Generator,
    ) -> None:
        self.name = spec.name
        """The name of the stream."""
        self.observer: StreamObserver | None = None
        """The observer of the stream, outside of the simulation."""
        self._spec, self._world, self._carrier = spec, world, carrier
        self._connection = connection
        self._formats: tuple[Format, ...] = tuple(
            FORMATS[name] for name in spec.formats if name in FORMATS
        )
        self._line = SerialLine(spec.bit_rate, spec.buffer)
        self.state: InstrumentStreamState = InstrumentStreamState(self._line.state, rng)
        publish = None
        if spec.bytes_topic:
            publish = world.bus.publisher(spec.bytes_topic, UInt8MultiArray)
        self._publish = publish

    @property
    def is_open(self) -> bool:
        """True if the stream can send bytes outside."""
        return self._connection is not None

    @property
    def has_reader(self) -> bool:
        """True if a program has read, or this is not known; only a pseudo-terminal shows it."""
        connection = self._connection
        return connection.has_reader if isinstance(connection, TerminalStream) else True

    @property
    def description(self) -> str:
        """The formats and the other side, for the user."""
        path = self._connection.path if isinstance(self._connection, TerminalStream) else ""
        target = " ".join(filter(None, (path, self._spec.address))) or self._spec.bytes_topic
        return f"{self.name}: {self._spec.format} to {target}"

    def send_message(self, message: object) -> None:
        """Send a message of the topic in all formats."""
        state, header = self.state, getattr(message, "header")  # noqa: B009
        time_us = self._carrier.to_time_us(header)
        interval_us = None if state.last_time_us < 0 else time_us - state.last_time_us
        state.last_time_us = time_us
        is_depth = not self._spec.measures_pressure
        sample = Sample(self._carrier, message, interval_us, is_depth)
        self._push(b"".join(format.write(sample) for format in self._formats))

    def send_position(self) -> None:
        """Send the position of the vehicle by acoustics."""
        spec, time = self._spec, self._world.time
        noise = spec.std * self.state.rng.standard_normal(3)
        beacon = self._carrier.measure_beacon(
            spec.name,
            self._carrier.epoch_us + round(1e6 * time),
            noise,
            spec.std,
            spec.transceiver,
        )
        writers = {"PSONLLD": beacon.psonlld, "PSIMSSB": beacon.psimssb}
        self._push(b"".join(writers[name]().to_bytes() for name in spec.formats))

    def _push(self, data: bytes) -> None:
        if not data:
            return
        time = self._world.time
        self._line.push(data, time)
        self._send_due(time)

    def _send_due(self, time: float) -> None:
        for data, value_time, due_time in self._line.pop_sent(time):
            if self._publish is not None:
                self._publish(UInt8MultiArray(data=np.frombuffer(data, np.uint8)))
            if self._connection is None:
                continue
            is_sent = self._connection.send(data)
            if self.observer is not None and is_sent:
                self.observer.note_sent(self.name, value_time, due_time)
            elif self.observer is not None:
                self.observer.note_unsent(self.name)

    def idle_until(self, time: float) -> float:
        """Return the time at which the next message has left the line."""
        return max(time, self._line.next_time)

    def step(self, time: float) -> None:
        """Send the messages that have left the line until ``time`` [s]."""
        self._send_due(time)
