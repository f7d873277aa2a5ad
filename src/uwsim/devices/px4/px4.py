"""PX4 as the autopilot of a vehicle, in lock-step over its HIL messages (``docs/px4.md``).

.. code-block:: xml

    <u:px4>
      <name>px4</name> <relativeTo>base_link</relativeTo>
      <port>4560</port> <rate>250</rate>
      <motor>bow_starboard</motor> <motor>bow_port</motor>
      <motor>stern_starboard</motor> <motor>stern_port</motor>
      <motor>-down_bow_starboard</motor> <motor>down_bow_port</motor>
      <motor>down_stern_starboard</motor> <motor>-down_stern_port</motor>
    </u:px4>

PX4 connects to the TCP port. Its output n commands the n-th ``<motor>``; with a ``-``, the sign is
reversed. Without ``<motor>`` a BlueROV2 Heavy has those above, which fit PX4's airframe 60002.

The axes of ``relativeTo`` must be x forward, y to starboard, z down; otherwise ``<orientation>``
turns the board. W must be east, north, up, with ``<nedOrigin>`` as its place on Earth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...autopilots.px4 import ACTUATOR_CHANNELS, ActuatorControls, HilMessage
from ...base.geometry import Array
from ...base.record import Record
from ...errors import BadSetting, UnknownName
from ...schema import MAX_DISTANCE, element
from ...vehicle import Autopilot
from ...world import DeviceWorld, MovingBody
from ..applied_commands import AppliedCommands
from ..device import Device, DeviceSpec, DeviceVehicle
from .board import Board, BoardNoise, Due
from .lock_step import LockStep, LockStepState

BLUEROV2_MOTORS = (
    "bow_starboard",
    "bow_port",
    "stern_starboard",
    "stern_port",
    "-down_bow_starboard",
    "down_bow_port",
    "down_stern_starboard",
    "-down_stern_port",
)
"""The thrusters of ``bluerov2_heavy`` in the order of PX4's airframe 60002, with the signs of its
parameters ``CA_ROTORn_AX``, ``AY`` and ``AZ``."""
TRUTH_RATE = 50.0
"""The rate of HIL_STATE_QUATERNION [Hz]."""


@dataclass(frozen=True, kw_only=True)
class Px4Spec(DeviceSpec):
    """A ``<u:px4>``.

    In lock-step, simulation time waits for each answer of PX4. It is connected only in a run with
    ``--px4`` (or ``udp_address`` in Python); in all other runs the element has no effect. Each
    answer publishes the applied commands on ``<vehicle>/autopilot/thrusters``.
    """

    name: str = "px4"
    """The name of the autopilot."""
    relative_to: str | None = None
    """The link on which the board is mounted; without it the base."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the board in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the board's FRD axes in the link's frame, roll, pitch, yaw [rad]."""
    host: str = "127.0.0.1"
    """The address of this computer at which PX4 connects."""
    port: int = element(default=4560, minimum=1, maximum=65535)
    """The TCP port; PX4 connects to 4560 plus the number of its instance."""
    rate: float = element(default=250.0, exclusive_minimum=0.0, maximum=1000.0)
    """The rate of HIL_SENSOR and of PX4's answers [Hz]."""
    motor: tuple[str, ...] = ()
    """The thruster of each output of PX4, with a ``-`` if its sign is reversed."""
    satellite_rate: float = element(default=5.0, minimum=0.0, maximum=50.0)
    """The rate of HIL_GPS, also under water [Hz]; 0: none."""
    odometry_rate: float = element(default=0.0, minimum=0.0, maximum=250.0)
    """The rate of ODOMETRY with position and velocity, as of a DVL and an INS [Hz]; 0: none."""
    accelerometer_noise: float = element(default=2e-3, exclusive_minimum=0.0, maximum=10.0)
    """The noise density of the accelerometer [m/s2/sqrt(Hz)]."""
    gyro_noise: float = element(default=2e-4, exclusive_minimum=0.0, maximum=1.0)
    """The noise density of the gyro [rad/s/sqrt(Hz)]."""
    magnetometer_noise: float = element(default=4e-8, exclusive_minimum=0.0, maximum=1e-4)
    """The noise density of the magnetometer [T/sqrt(Hz)]."""
    depth_noise: float = element(default=0.01, exclusive_minimum=0.0, maximum=100.0)
    """The standard deviation of the barometer, as a depth [m]."""
    satellite_noise: float = element(default=0.3, minimum=0.0, maximum=1000.0)
    """The standard deviation of each coordinate of HIL_GPS [m]."""
    odometry_noise: float = element(default=0.02, minimum=0.0, maximum=1000.0)
    """The standard deviation of the position [m] and the velocity [m/s] of ODOMETRY."""
    limit: float = element(default=60.0, exclusive_minimum=0.0, maximum=86400.0)
    """The greatest wall time to wait for PX4's start, and for each answer [s]."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Px4:
        """Find the thrusters, and open the port if the simulation has connections.

        Raises:
            UnknownName: the vehicle has no such link or thruster.
            BadSetting: the rate does not fit the step, the outputs do not fit the vehicle, or the
                board has another axis than z down.
        """
        if vehicle.autopilot is None:
            raise BadSetting(f"<u:px4>: {vehicle.name} has no dynamics, so PX4 cannot drive it.")
        motors = Motors(self.motor, vehicle.thrusters)
        schedule = Schedule(self, world.timestep)
        board = Board(self._mount(vehicle), world.ned_origin, self._noise)
        prefix = f"{vehicle.name}/{self.name}"
        state = Px4State(
            LockStepState(), world.stream(f"{prefix}/noise"), world.stream(f"{prefix}/start_noise")
        )
        lock_step, applied_commands = None, None
        if world.connections is not None:
            applied_commands = AppliedCommands(world.bus, vehicle)
            stream = world.connections.open(f"tcpin:{self.host}:{self.port}")
            place = f"TCP {self.host}:{self.port}"
            lock_step = LockStep(stream, place, self.limit, state.lock_step)
        thrusters = Thrusters(vehicle.autopilot, motors, applied_commands)
        return Px4(world, thrusters, board, schedule, lock_step, state)

    def _mount(self, vehicle: DeviceVehicle) -> MovingBody:
        """Return the frame of the board; raise BadSetting if its z axis does not point down."""
        base = vehicle.compiled_vehicle.base_mount().name.removeprefix(f"{vehicle.name}/")
        link = self.relative_to or base
        body = vehicle.moving_mount(_BoardPart(link, self.position, self.orientation))
        if body.world_from_body.rotation[2, 2] > 0.5:
            raise BadSetting(
                f"<u:px4>: the z axis of the board on {link} points up at the start; expected down "
                "(FRD). <orientation> <r>M_PI</r> <p>0</p> <y>0</y> turns it."
            )
        return body

    @property
    def _noise(self) -> BoardNoise:
        scale = math.sqrt(self.rate)
        return BoardNoise(
            specific_force=scale * self.accelerometer_noise,
            angular_velocity=scale * self.gyro_noise,
            magnetic_field=scale * self.magnetometer_noise,
            depth=self.depth_noise,
            satellites=self.satellite_noise,
            odometry=self.odometry_noise,
        )


@dataclass(frozen=True)
class _BoardPart:
    """The place of the board on a link."""

    relative_to: str
    position: tuple[float, float, float]
    orientation: tuple[float, float, float]


class Motors:
    """The thrusters that the outputs of PX4 command.

    Args:
        names: the thruster of each output, with a ``-`` if its sign is reversed; empty: those of a
            BlueROV2 Heavy.
        thrusters: the thrusters of the vehicle.

    Raises:
        UnknownName: the vehicle has no such thruster.
        BadSetting: there are too many outputs, or none that are known.
    """

    def __init__(self, names: Sequence[str], thrusters: Sequence[str]) -> None:
        if not names:
            names = BLUEROV2_MOTORS
            if {name.lstrip("-") for name in names} != set(thrusters):
                raise BadSetting(
                    "<u:px4> needs a <motor> for each output of PX4; only the thrusters of "
                    f"bluerov2_heavy have known ones. The thrusters are {', '.join(thrusters)}."
                )
        if len(names) > ACTUATOR_CHANNELS:
            raise BadSetting(
                f"<u:px4> has {len(names)} <motor>; expected at most {ACTUATOR_CHANNELS}."
            )
        self._gains = np.zeros((len(thrusters), len(names)))  # command of a thruster by an output
        for output, name in enumerate(names):
            thruster = name.removeprefix("-")
            if thruster not in thrusters:
                raise UnknownName("thruster", thruster, thrusters)
            self._gains[thrusters.index(thruster), output] = -1.0 if name != thruster else 1.0

    def commands(self, controls: Sequence[float]) -> Array:
        """Return the command of each thruster, (n,) [-1..1], for the outputs of PX4."""
        commands = np.zeros(len(self._gains))
        for output in range(self._gains.shape[1]):
            commands += self._gains[:, output] * controls[output]
        limited_commands: Array = np.clip(commands, -1.0, 1.0)
        return limited_commands


class Thrusters:
    """The thrusters of a vehicle, as the outputs of PX4 drive them.

    Args:
        autopilot: the vehicle's thrusters.
        motors: the thrusters of the outputs.
        applied_commands: the publisher of the commands; None: the simulation has no connections.
    """

    def __init__(
        self, autopilot: Autopilot, motors: Motors, applied_commands: AppliedCommands | None
    ) -> None:
        self._autopilot, self._motors = autopilot, motors
        self._applied_commands = applied_commands

    def apply(self, controls: Sequence[float]) -> None:
        """Apply and publish the commands of the outputs of PX4."""
        commands = self._motors.commands(controls)
        self._autopilot.set_thrusters(commands)
        if self._applied_commands is not None:
            self._applied_commands.publish(commands)


class Schedule:
    """The steps at which messages are due.

    Args:
        spec: the rates.
        timestep: the length of a step [s].

    Raises:
        BadSetting: the interval of HIL_SENSOR is not a whole number of steps.
    """

    def __init__(self, spec: Px4Spec, timestep: float) -> None:
        steps = 1.0 / (spec.rate * timestep)
        self.steps: int = max(1, round(steps))
        """The number of steps between two HIL_SENSOR messages."""
        if abs(steps - self.steps) > 1e-6:
            rates = [1.0 / (timestep * n) for n in (max(1, int(steps)), int(steps) + 1)]
            raise BadSetting(
                f"<u:px4>: a <rate> of {spec.rate:g} Hz is not possible with steps of {timestep:g} "
                f"s; expected {rates[0]:g} or {rates[1]:g} Hz."
            )
        self.period: int = round(1e6 * self.steps * timestep)
        """The interval of HIL_SENSOR [us]."""
        self._intervals = [
            max(1, round(spec.rate / rate)) if rate > 0.0 else 0
            for rate in (spec.satellite_rate, spec.odometry_rate, TRUTH_RATE)
        ]

    def due(self, count: int) -> Due:
        """Return what is due together with the HIL_SENSOR of a number."""
        satellites, odometry, truth = (
            interval > 0 and count % interval == 0 for interval in self._intervals
        )
        return Due(has_satellites=satellites, has_odometry=odometry, has_truth=truth)


@dataclass(slots=True)
class Px4State(Record):
    """The state of the device."""

    lock_step: LockStepState
    """The state of the exchange."""
    rng: np.random.Generator
    """The generator of the noise of the sensors."""
    start_rng: np.random.Generator
    """The generator of the noise while PX4 starts, which takes a different number of samples."""
    next_step: int = 0
    """The number of the step of the next HIL_SENSOR."""
    n_samples: int = 0
    """The number of HIL_SENSOR messages since PX4 has started."""
    is_started: bool = False
    """True if PX4 has answered."""
    is_armed: bool = False
    """True if PX4 was armed at its last answer."""


class Px4(Device):
    """The exchange with PX4 in each of its periods.

    Args:
        world: the clock of the simulation.
        thrusters: the vehicle's thrusters.
        board: the sensors on PX4's board.
        schedule: the steps at which messages are due.
        lock_step: the exchange; None: the simulation has no connections, and the device is idle.
        state: the state.
    """

    def __init__(
        self,
        world: DeviceWorld,
        thrusters: Thrusters,
        board: Board,
        schedule: Schedule,
        lock_step: LockStep | None,
        state: Px4State,
    ) -> None:
        self._world, self._thrusters, self._board = world, thrusters, board
        self._schedule, self._lock_step = schedule, lock_step
        self.state: Px4State = state

    def idle_until(self, time: float) -> float:
        """Return the time of the next HIL_SENSOR; never without a connection."""
        return math.inf if self._lock_step is None else self.state.next_step * self._world.timestep

    def step(self, time: float) -> None:
        """Send the sensors' readings if they are due, wait for the answer, and apply it.

        Raises:
            ClientLost: PX4 does not start, does not answer, or has left.
        """
        state, lock_step = self.state, self._lock_step
        if lock_step is None or self._world.step < state.next_step:
            return
        if not state.is_started:
            lock_step.start(self._measure_at_start, self._schedule.period, time)
            state.is_started = True
        clock = state.lock_step.clock_offset + round(1e6 * time)
        due = self._schedule.due(state.n_samples)
        answer = lock_step.exchange(self._board.measure(clock, due, state.rng), clock)
        state.n_samples += 1
        state.next_step = self._world.step + self._schedule.steps
        self._apply(answer)

    def describe(self) -> str:
        """Return a sentence about the exchange."""
        return "PX4: not connected" if self._lock_step is None else self._lock_step.describe()

    def _measure_at_start(self, clock: int) -> list[HilMessage]:
        due = self._schedule.due(clock // self._schedule.period)
        return self._board.measure(clock, due, self.state.start_rng)

    def _apply(self, answer: ActuatorControls) -> None:
        self.state.is_armed = answer.is_armed
        self._thrusters.apply(answer.controls)
