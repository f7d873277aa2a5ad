"""The connection of a vehicle to its autopilot by MAVLink; an extension of the dialect.

.. code-block:: xml

    <u:mavlink>
      <name>bluerov2/mavlink</name> <address>tcp:127.0.0.1:5762</address>
      <dvl>/bluerov2/dvl</dvl> <odometry>/bluerov2/odom</odometry> <range>/bluerov2/altitude</range>
    </u:mavlink>

It sends sensors that the autopilot's own physics interface lacks, each at the rate of its topic,
and the commands of programs and pilots; it publishes what the autopilot reports. The bytes go to a
program outside, so a run with this device is repeatable as far as that program is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...autopilots.mavlink import Codec, Identity, Message, commands
from ...autopilots.mavlink.status import (
    ACK_RESULTS,
    AutopilotStatus,
    apply_heartbeat,
    describe_command,
    describe_result,
    is_autopilot_heartbeat,
    read_text,
)
from ...base.geometry import Triple, quaternion_from_rotation, rotation_from_rpy
from ...base.record import Record
from ...base.terminal import report, warn
from ...errors import MissingExtra
from ...messages import DVL, Bool, Odometry, Point, PoseStamped, Quaternion, Range, String, header
from ...messages import Pose as PoseMessage
from ...schema import MAX_DISTANCE, element
from ...world import DeviceWorld
from ..ardupilot import ArduPilotSpec
from ..device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .axes import BodyAxes, HomeFrame
from .command_topics import CommandState, CommandTopics, command_topics
from .link import Link, LinkState
from .navigation import NavigationSensors, NavigationState, PositionNoise
from .start_watch import StartWatch

GROUND_STATION, ONBOARD_COMPUTER = 6, 18
"""The MAV_TYPE of the two components as which the device sends."""
STATION = Identity(255, 190)
"""The sender of commands: the system from which ArduPilot takes them (``SYSID_MYGCS``)."""
SENSOR_COMPONENT = 197
"""The component that sends navigation, MAV_COMP_ID_VISUAL_INERTIAL_ODOMETRY."""
HEARTBEAT_PERIOD = 1.0
"""The time between two heartbeats [s]."""
POLL_PERIOD = 0.02
"""The time between two looks at what has arrived [s]."""
STICKS_PERIOD = 0.04
"""The time between two messages of the sticks [s]; without them ArduPilot's failsafe acts."""
LOST_TIME = 5.0
"""The age of the last heartbeat at which the autopilot counts as silent [s]."""
MAX_NOTES = 200
"""The greatest number of lines on the terminal; later texts are only published."""
N_LAST_NOTES = 8
"""The number of lines on the terminal that are not repeated."""
MAVLINK_PORT, PORTS_PER_INSTANCE = 5762, 10
"""The TCP port of ArduPilot's second serial port, and the distance to that of the next instance."""
LOCAL_POSITION_NUMBER, ATTITUDE_NUMBER = 32, 30
"""The numbers of LOCAL_POSITION_NED and ATTITUDE."""


@dataclass(frozen=True, kw_only=True)
class MavlinkSpec(DeviceSpec):
    """A ``<u:mavlink>``: the connection to an autopilot; without one it does nothing.

    Topics to which it subscribes: ``<name>/arm`` (std_msgs/Bool), ``/mode`` (std_msgs/String, such
    as POSHOLD), ``/sticks`` (std_msgs/Float64MultiArray: surge, sway, heave, yaw, pitch, roll),
    ``/setpoint_position`` (geometry_msgs/PoseStamped in L) and ``/setpoint_velocity``
    (geometry_msgs/TwistStamped in the axes of L). It publishes ``/is_armed``, ``/flight_mode``,
    ``/status_text`` and ``/estimate`` (geometry_msgs/PoseStamped in L, the autopilot's own).
    """

    name: str = "mavlink"
    """The name of the device, which begins its topics; it must be unique in the scene."""
    address: str = ""
    """The address of the autopilot: ``tcp:HOST:PORT`` of a server, ``udpin:`` or ``udpout:``.
    ArduPilot's simulation n (from 0) listens at the TCP ports 5760 + 10 n, which MAVProxy takes if
    ``sim_vehicle.py`` starts it, and 5762 + 10 n, its second serial port. By default it is
    ``tcp:127.0.0.1:5762`` + 10 n, with n the ``<instance>`` of the vehicle's ``<u:ardupilot>``."""
    dvl: str = ""
    """The topic of a DVL (underwater_sensor_msgs/DVL), sent as VISION_POSITION_DELTA."""
    odometry: str = ""
    """The topic of a pose and velocity (nav_msgs/Odometry), sent as ODOMETRY."""
    range: str = ""
    """The topic of an altimeter (sensor_msgs/Range), sent as DISTANCE_SENSOR."""
    position_std: float = element(default=0.0, minimum=0.0, maximum=1000.0)
    """The standard deviation of the noise that is added to positions of ``odometry`` [m]."""
    attitude_std: float = element(default=0.0, minimum=0.0, maximum=3.2)
    """The standard deviation of the noise that is added to its roll, pitch and heading [rad]."""
    velocity_std: float = element(default=0.0, minimum=0.0, maximum=10.0)
    """The standard deviation of the noise that is added to its velocities [m/s]."""
    system: int = element(default=1, minimum=1, maximum=254)
    """The MAVLink system of the sensors, that of the vehicle."""
    home: Triple | None = element(default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The origin of the autopilot's local positions, in L [m]; by default the position of the
    vehicle at the start, where ArduSub sets its depth to 0."""
    sets_origin: bool = True
    """True if the scene's ``<nedOrigin>`` is sent as the origin of the autopilot's local
    positions."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of commands and reports, and of the sensors."""
        sensors: tuple[tuple[str, str, type], ...] = (
            ("dvl", self.dvl, DVL),
            ("odometry", self.odometry, Odometry),
            ("range", self.range, Range),
        )
        return command_topics(self.name) + tuple(
            DeviceTopic(name=topic, is_subscribed=True, message_type=type_, element=element_name)
            for element_name, topic, type_ in sensors
            if topic
        )

    def complete(self, parts: Sequence[object]) -> MavlinkSpec:
        """Return the spec with an address: by default that of the vehicle's ArduPilot."""
        if self.address:
            return self
        instances = [part.instance for part in parts if isinstance(part, ArduPilotSpec)]
        return replace(self, address=second_serial_port(*instances[:1]))

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> MavlinkDevice:
        """Open the connection, if the simulation has any, and subscribe to the topics."""
        connections = world.connections
        try:
            codec = None if connections is None else Codec()
        except MissingExtra as error:
            codec = None
            warn(f"<u:mavlink> of {vehicle.name} does nothing. {error}")
        link = Link()
        if connections is not None and codec is not None:
            link = Link(connections.open(self.address or second_serial_port()), codec)
        return MavlinkDevice(self, world, vehicle, link)


def second_serial_port(instance: int = 0) -> str:
    """Return the address of the second serial port of an ArduPilot instance."""
    return f"tcp:127.0.0.1:{MAVLINK_PORT + PORTS_PER_INSTANCE * instance}"


@dataclass(slots=True)
class MavlinkState(Record):
    """The state of a connection by MAVLink."""

    link: LinkState
    """The counters of the connection."""
    navigation: NavigationState
    """The state of the navigation sensors."""
    commands: CommandState
    """The commands that are repeated."""
    status: AutopilotStatus = field(default_factory=AutopilotStatus)
    """The reports of the autopilot."""
    poll_time: float = -math.inf
    """The time of the next look at what has arrived [s]."""
    heartbeat_time: float = -math.inf
    """The time of the next heartbeat [s]."""
    sticks_time: float = -math.inf
    """The time of the next message of the sticks [s]."""
    is_silent: bool = False
    """True if the autopilot has been silent for `LOST_TIME`."""
    has_begun: bool = False
    """True if the origin was sent over the present connection."""
    yaw: float = 0.0
    """The heading that the autopilot estimates [rad]."""
    roll: float = 0.0
    """The roll that the autopilot estimates [rad]."""
    pitch: float = 0.0
    """The pitch that the autopilot estimates [rad]."""
    last_notes: tuple[str, ...] = ()
    """The last different lines on the terminal, the newest last."""
    n_notes: int = 0
    """The number of lines on the terminal so far."""
    n_invalid_bytes: int = 0
    """The number of invalid bytes when they were last reported."""


class MavlinkDevice(Device):
    """The connection of a vehicle to its autopilot."""

    def __init__(
        self, spec: MavlinkSpec, world: DeviceWorld, vehicle: DeviceVehicle, link: Link
    ) -> None:
        self._spec, self._world, self._link = spec, world, link
        self._watch = StartWatch(spec.address or second_serial_port())
        self.name = spec.name
        """The name of the device, with which its topics begin."""
        self.vehicle_name = vehicle.name
        """The name of the vehicle."""
        self._sensor = Identity(spec.system, SENSOR_COMPONENT)
        noise = PositionNoise(
            position=spec.position_std, attitude=spec.attitude_std, velocity=spec.velocity_std
        )
        start = world.world_from_localized.inverse() @ vehicle.world_from_base
        home = start.position if spec.home is None else np.array(spec.home)
        self._home = HomeFrame(world.world_from_localized, home)
        self._sensors = NavigationSensors(
            BodyAxes(vehicle),
            self._home,
            noise,
            world.stream(f"{vehicle.name}/{spec.name}/noise"),
            self._send_sensor,
        )
        status = AutopilotStatus()
        self._commands = CommandTopics(
            world.bus,
            spec.name,
            home=self._home,
            status=status,
            clock=lambda: world.time,
            send=self._send_command,
        )
        self.state: MavlinkState = MavlinkState(
            link.state, self._sensors.state, self._commands.state, status
        )
        self._subscribe()
        self._publish_armed = world.bus.publisher(f"{spec.name}/is_armed", Bool)
        self._publish_mode = world.bus.publisher(f"{spec.name}/flight_mode", String)
        self._publish_text = world.bus.publisher(f"{spec.name}/status_text", String)
        self._publish_estimate = world.bus.publisher(f"{spec.name}/estimate", PoseStamped)

    @property
    def is_open(self) -> bool:
        """True if the simulation has connections; the autopilot may still be absent."""
        return self._link.is_open

    def _subscribe(self) -> None:
        """Subscribe to the sensors, unless nothing can be sent."""
        if not self._link.is_open:
            return
        bus, spec = self._world.bus, self._spec
        if spec.dvl:
            bus.subscribe(spec.dvl, DVL, self._sensors.send_dvl)
        if spec.odometry:
            bus.subscribe(spec.odometry, Odometry, self._sensors.send_position)
        if spec.range:
            bus.subscribe(spec.range, Range, self._sensors.send_range)

    def idle_until(self, time: float) -> float:
        """Return the time of the next look at what has arrived; never without a connection."""
        if self._link.has_outbox:
            return time
        return self.state.poll_time if self._link.is_open else math.inf

    def step(self, time: float) -> None:
        """Read what has arrived, and send heartbeats and sticks that are due."""
        self._exchange(time)
        self._link.flush()

    def _exchange(self, time: float) -> None:
        state = self.state
        if not self._link.is_open or time < state.poll_time - 1e-9:
            return
        state.poll_time = time + POLL_PERIOD
        for message in self._link.receive():
            self._handle(message, time)
        if not self._link.is_connected:
            state.has_begun = False  # an autopilot that starts again has forgotten its origin
        self._report_invalid_bytes()
        if time >= state.heartbeat_time - 1e-9:
            state.heartbeat_time = time + HEARTBEAT_PERIOD
            self._send_command(commands.heartbeat(type=GROUND_STATION))
            self._send_sensor(commands.heartbeat(type=ONBOARD_COMPUTER))
            self._check_silence(time)
        if time >= state.sticks_time - 1e-9:
            state.sticks_time = time + STICKS_PERIOD
            self._commands.send_sticks()

    def _send_sensor(self, message: Message) -> None:
        self._link.send(message, self._sensor)

    def _send_command(self, message: Message) -> None:
        self._link.send(message, STATION)

    def _handle(self, message: Message, time: float) -> None:
        """Use a message of the autopilot; those of other systems are ignored."""
        status = self.state.status
        if is_autopilot_heartbeat(message):
            if status.system in (0, message.system):
                self._handle_heartbeat(message, time)
            return
        if message.system != status.system:
            return
        if message.name == "STATUSTEXT":
            text = read_text(status, message)
            if text is not None:
                self._publish_text(String(data=text))
                self._note(text)
        elif message.name == "COMMAND_ACK" and describe_result(message) != ACK_RESULTS[0]:
            self._note(f"{describe_command(message)}: {describe_result(message)}")
        elif message.name == "ATTITUDE":
            state = self.state
            state.roll, state.pitch, state.yaw = map(message.number, ("roll", "pitch", "yaw"))
        elif message.name == "LOCAL_POSITION_NED":
            self._publish_position(message, time)

    def _handle_heartbeat(self, message: Message, time: float) -> None:
        status = self.state.status
        is_first = status.system == 0 or not self.state.has_begun
        was_silent = self.state.is_silent
        is_changed = apply_heartbeat(status, message, time)
        self.state.is_silent = False
        if is_first or was_silent:
            self._begin()
        if is_changed:
            is_armed = "armed" if status.is_armed else "disarmed"
            self._note(f"{status.mode_name}, {is_armed}")
        self._publish_armed(Bool(data=status.is_armed))
        self._publish_mode(String(data=status.mode_name))

    def _begin(self) -> None:
        """Send what an autopilot needs once: its origin, and the messages that are read."""
        self.state.has_begun = True
        target = self._commands.target
        for number in (LOCAL_POSITION_NUMBER, ATTITUDE_NUMBER):
            self._send_command(commands.set_message_interval(target, number, 0.1))
        if self._spec.sets_origin:
            origin = self._world.ned_origin.position_at(self._home.origin)
            self._send_command(
                commands.set_origin(
                    target,
                    latitude=origin.latitude,
                    longitude=origin.longitude,
                    altitude=origin.altitude,
                )
            )

    def _publish_position(self, message: Message, time: float) -> None:
        """Publish the pose that the autopilot estimates, of a base with z down, in L."""
        x, y, z = map(message.number, "xyz")
        state = self.state
        pose = self._home.localized_pose(
            np.array([x, y, z]), rotation_from_rpy(state.roll, state.pitch, state.yaw)
        )
        w, qx, qy, qz = quaternion_from_rotation(pose.rotation).tolist()
        px, py, pz = pose.position.tolist()
        content = PoseMessage(Point(px, py, pz), Quaternion(qx, qy, qz, w))
        self._publish_estimate(PoseStamped(header=header(time), pose=content))

    def _check_silence(self, time: float) -> None:
        """Report once that the autopilot sends no more heartbeats."""
        state = self.state
        last_time = state.status.heartbeat_time
        if last_time < 0.0 and time > 0.0:
            self._watch.check()
        if last_time >= 0.0 and time - last_time > LOST_TIME and not state.is_silent:
            state.is_silent = True
            self._note(f"no heartbeat for {LOST_TIME:g} s")

    def describe(self) -> str:
        """Return a sentence with the numbers of the connection."""
        link = self.state.link
        if self.state.status.heartbeat_time < 0.0:
            return f"MAVLink of {self.vehicle_name}: {self._watch.describe()}"
        counts = {
            "unsent": link.n_unsent,
            "bytes of no MAVLink": link.reader.n_invalid_bytes,
        }
        events = ", ".join(f"{n} {name}" for name, n in counts.items() if n)
        return (
            f"MAVLink of {self.vehicle_name}: {link.reader.n_messages} messages received, "
            f"{link.n_sent} sent" + (f"; {events}" if events else "")
        )

    def _report_invalid_bytes(self) -> None:
        """Report the first invalid bytes, and whenever there are ten times as many."""
        state, n_bytes = self.state, self.state.link.reader.n_invalid_bytes
        if n_bytes > 10 * state.n_invalid_bytes:
            state.n_invalid_bytes = n_bytes
            self._note(f"{n_bytes} bytes at {self._spec.address} are no MAVLink; they are skipped")

    def _note(self, text: str) -> None:
        """Print a line with the name of the vehicle; no more than `MAX_NOTES`.

        ArduPilot repeats some texts every second: a line that is one of the last is not printed.
        """
        state = self.state
        if text in state.last_notes:
            return
        state.last_notes = (*state.last_notes, text)[-N_LAST_NOTES:]
        state.n_notes += 1
        if state.n_notes < MAX_NOTES:
            report(f"autopilot of {self.vehicle_name}: {text}")
        elif state.n_notes == MAX_NOTES:
            report(f"autopilot of {self.vehicle_name}: later texts are not shown")
