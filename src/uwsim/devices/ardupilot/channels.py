"""The servo outputs of an autopilot: what each channel drives.

.. code-block:: xml

    <channel> <number>1</number> <thruster>bow</thruster> <reversed>1</reversed> </channel>
    <channel> <number>9</number> <lamp>lights_port</lamp> </channel>
    <channel> <number>11</number> <joint>jaw</joint> <speed>0.5</speed> </channel>
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...autopilots.ardupilot import PwmCurve, read_pwm_curve
from ...autopilots.ardupilot.pwm import DEFAULT_CURVE
from ...base.geometry import Array
from ...errors import SceneError, UnknownName, UwsimError
from ...messages import Float64
from ...schema import Numbers, Spec, diagnostic_at, element
from ...vehicle import JointIndices, Servos, Vehicle
from ...world import DeviceWorld
from ..device import DeviceVehicle

MAX_CURVE_NUMBERS = 64
"""The greatest count of numbers of a curve."""


@dataclass(frozen=True, kw_only=True)
class ChannelSpec(Spec):
    """A ``<channel>``: a servo output, and the one thruster, lamp or joint that it drives."""

    number: int = element(minimum=1, maximum=32)
    """The number of the channel, from 1; that of ``SERVOn_FUNCTION``."""
    thruster: str | None = None
    """The name of the thruster in the hydrodynamics file."""
    lamp: str | None = None
    """The name of the lamp: command -1 is dark, command 1 its whole intensity."""
    joint: str | None = None
    """The name of the joint, of a vehicle with dynamics."""
    reversed: bool = False
    """True if the command has the opposite sign."""
    curve: Numbers = element(default=DEFAULT_CURVE, max_count=MAX_CURVE_NUMBERS)
    """The pulse width [us] and the command [-1..1] of each point of the curve between them, which
    is straight from point to point."""
    lower: float = 0.0
    """The position of the joint at command -1 [rad or m]."""
    upper: float = 0.0
    """The position of the joint at command 1 [rad or m]."""
    speed: float | None = element(default=None, minimum=0.0, maximum=100.0)
    """The velocity of the joint at command 1, instead of positions [rad/s or m/s]."""

    def pwm_curve(self) -> PwmCurve:
        """Return the curve; raise SceneError if it is invalid."""
        try:
            curve = read_pwm_curve(self.curve)
        except UwsimError as error:
            raise SceneError([diagnostic_at(self, str(error), "curve")]) from None
        return curve.negate() if self.reversed else curve


@dataclass(frozen=True, eq=False)
class ThrusterOutput:
    """A channel that drives a thruster."""

    channel: int
    """The index of the channel, from 0."""
    thruster: int
    """The index of the thruster."""
    curve: PwmCurve
    """The curve from pulse width to command."""


@dataclass(frozen=True, eq=False)
class HoldingOutput:
    """A channel that drives a lamp or a joint, which keep their last command."""

    channel: int
    """The index of the channel, from 0."""
    curve: PwmCurve
    """The curve from pulse width to command."""
    apply: Callable[[float, bool], None]
    """The function that applies a command; its second argument is False without a signal."""


class ServoOutputs:
    """The channels of an autopilot that drive something.

    Args:
        vehicle: the vehicle.
        thrusters: the channels that drive thrusters.
        holding_outputs: the channels that drive lamps and joints.
        publish: the function that publishes the applied command of each thruster; None: none does.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        thrusters: Sequence[ThrusterOutput],
        holding_outputs: Sequence[HoldingOutput],
        publish: Callable[[Array], None] | None = None,
    ) -> None:
        self._publish = publish
        self._vehicle, self._thrusters = vehicle, tuple(thrusters)
        self._holding_outputs = tuple(holding_outputs)
        self._n_thrusters = len(vehicle.thrusters)

    def apply(self, pwm: Sequence[int], last_pwm: Sequence[int]) -> None:
        """Apply the pulse widths of a packet [us]; channels beyond the packet have no signal."""
        n = len(pwm)
        autopilot = self._vehicle.autopilot
        if self._thrusters and autopilot is not None:
            commands = np.zeros(self._n_thrusters)  # (n,) [1]
            for thruster in self._thrusters:
                if thruster.channel < n:
                    commands[thruster.thruster] = thruster.curve.command(pwm[thruster.channel])
            autopilot.set_thrusters(commands)
            if self._publish is not None:
                self._publish(commands)
        for output in self._holding_outputs:
            width = pwm[output.channel] if output.channel < n else 0
            is_known = output.channel < len(last_pwm)
            if not is_known or width != last_pwm[output.channel]:
                output.apply(output.curve.command(width), width != 0)


def bind_channels(
    channels: Sequence[ChannelSpec],
    world: DeviceWorld,
    vehicle: DeviceVehicle,
    publish: Callable[[Array], None] | None = None,
) -> ServoOutputs:
    """Resolve the names of the channels; without channels, the n-th drives the n-th thruster.

    Args:
        channels: the channels.
        world: the scene.
        vehicle: the vehicle.
        publish: the function that publishes the applied command of each thruster.

    Raises:
        UnknownName: the vehicle has no such thruster, or no such joint.
        SceneError: a channel drives nothing, or several things, or has an invalid curve.
    """
    curve = read_pwm_curve(DEFAULT_CURVE)
    if not channels:
        outputs = [ThrusterOutput(i, i, curve) for i in range(len(vehicle.thrusters))]
        return ServoOutputs(vehicle, outputs, (), publish)
    thrusters: list[ThrusterOutput] = []
    holding_outputs: list[HoldingOutput] = []
    for spec in channels:
        targets = [spec.thruster, spec.lamp, spec.joint]
        if len(targets) - targets.count(None) != 1:
            message = "<channel>: expected one of <thruster>, <lamp> and <joint>."
            raise SceneError([diagnostic_at(spec, message)])
        index, curve = spec.number - 1, spec.pwm_curve()
        if spec.thruster is not None:
            if spec.thruster not in vehicle.thrusters:
                raise UnknownName("thruster", spec.thruster, vehicle.thrusters)
            output = ThrusterOutput(index, vehicle.thrusters.index(spec.thruster), curve)
            thrusters.append(output)
        elif spec.lamp is not None:
            holding_outputs.append(HoldingOutput(index, curve, _lamp_command(spec.lamp, world)))
        else:
            holding_outputs.append(HoldingOutput(index, curve, _joint_command(spec, vehicle)))
    return ServoOutputs(vehicle, thrusters, holding_outputs, publish)


def _lamp_command(lamp: str, world: DeviceWorld) -> Callable[[float, bool], None]:
    """Return the function that dims a lamp; without a signal it is dark."""
    publish = world.bus.publisher(f"{lamp}/brightness", Float64)

    def dim(command: float, has_signal: bool) -> None:
        publish(Float64(data=0.5 * (1.0 + command) if has_signal else 0.0))

    return dim


def _joint_command(spec: ChannelSpec, vehicle: DeviceVehicle) -> Callable[[float, bool], None]:
    """Return the function that moves a joint; without a signal it holds its position."""
    joint, servos = spec.joint or "", vehicle.servos
    if joint not in vehicle.joint_names:
        raise UnknownName("joint", joint, vehicle.joint_names)
    if servos is None:
        message = f"<channel>: the joint {joint!r} has no servo: the vehicle is kinematic."
        raise SceneError([diagnostic_at(spec, message)])
    indices = np.array([vehicle.joint_names.index(joint)])
    if spec.speed is not None:
        return _velocity_command(servos, indices, spec.speed)
    middle, half = 0.5 * (spec.lower + spec.upper), 0.5 * (spec.upper - spec.lower)

    def move(command: float, has_signal: bool) -> None:
        if has_signal:
            servos.set_position_targets(indices, np.array([middle + half * command]))

    return move


def _velocity_command(
    servos: Servos, indices: JointIndices, speed: float
) -> Callable[[float, bool], None]:
    def turn(command: float, has_signal: bool) -> None:
        servos.set_velocity_targets(indices, np.array([speed * command if has_signal else 0.0]))

    return turn
