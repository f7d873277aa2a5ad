"""``pilot``: an algorithm that converts a person's inputs in the live view to commands."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..bus import Node
from ..errors import UnknownName
from ..messages import (
    Bool,
    Empty,
    Float64,
    Float64MultiArray,
    JointState,
    MultiArrayLayout,
    Odometry,
    String,
    TwistStamped,
    header,
)
from .scripted import odometry_message, parse_twist
from .tracker_node import merge_parameters

TOPIC = "pilotInputs"
"""The topic of the pilot's inputs: one number for each axis, -1..1; missing axes are 0."""
N_JOINTS = 6
"""The greatest number of joints with an input axis, not counting the jaw."""
N_THRUSTERS = 12
"""The greatest number of thrusters with an input axis."""
TWIST_AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
"""The input axes of the vehicle's motion.

Positive inputs move it forward, to starboard and up, and turn it with its starboard side down, its
bow up, and its bow to starboard."""
THRUSTER_AXES = tuple(f"thruster{k}" for k in range(1, N_THRUSTERS + 1))
"""The input axes of single thrusters, in the order of the vehicle's hydrodynamics file."""
MODE_AXES = {
    "mode1": "MANUAL",
    "mode2": "STABILIZE",
    "mode3": "ALT_HOLD",
    "mode4": "POSHOLD",
}
"""The input axes that change the flight mode of an autopilot, with its modes."""
SWITCH_AXES = ("arm", *MODE_AXES)
"""The input axes of which only the begin of an input counts."""
STICK_AXES = ("surge", "sway", "heave", "yaw", "pitch", "roll")
"""The input axes that are the sticks of an autopilot, in the order of its topic."""
AXES = (
    *TWIST_AXES,
    "jaw",
    *(f"joint{k}" for k in range(1, N_JOINTS + 1)),
    *THRUSTER_AXES,
    "lamps",
    "arm",
    *MODE_AXES,
)
"""The input axes, in the order of the numbers in a message; new axes are appended.

The groups are the twist, the jaw (positive opens it), the joints, the thrusters, the lamps, and of
an autopilot arming (negative: disarming) and modes."""
PERIOD = 0.05
"""The time between two commands while no input changes [s]."""


class Pilot:
    """A human pilot: converts inputs of the live view to commands of a vehicle and its joints.

    An input in the dead zone counts as 0. The command of each axis approaches the input at a
    limited rate. When an input changes, a command is published at once, which changes by at most
    the step of one `PERIOD`. Before the first input there are no commands. A vehicle may accept
    both twists and commands of single thrusters: the pilot publishes the kind whose axes were moved
    last, and twists at first. If an autopilot steers the vehicle (``<u:mavlink>``), the axes of the
    twist are its sticks, at rest before the first input, and no other commands of motion are
    published. All lamps have the same
    brightness, at first 1. Names of services, topics and joints in a parameter are separated by
    blanks; by default the run reads them from the scene.
    """

    IS_PILOTED: ClassVar[bool] = True
    """True if the inputs come from a person; the result then stores them."""
    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "start": "startBench",
        "twist_topic": "",
        "odom_topic": "",
        "joints_topic": "",
        "joints": "",
        "jaw": "",
        "thrusters_topic": "",
        "n_thrusters": 0.0,
        "lamp_topics": "",
        "autopilot": "",
        "z_is_down": 1.0,
        "speed": 0.4,
        "turn": 0.3,
        "thrust": 1.0,
        "joint_speed": 0.3,
        "dim_rate": 0.5,
        "rate": 2.0,
        "dead_zone": 0.05,
    }
    """The parameters with their defaults.

    Speeds at full input: ``speed`` [m/s], ``turn`` [rad/s], ``joint_speed`` [rad/s or m/s]; the
    thrust at full input ``thrust`` [fraction of full thrust]; the change of brightness ``dim_rate``
    [1/s]; the greatest change of an axis ``rate`` [1/s]; ``dead_zone`` [1]. ``z_is_down`` is 1 if
    the z axis of the vehicle points down, 0 if it points up.
    """

    def start(self, node: Node) -> None:
        """Subscribe to the inputs and start the timer of the commands."""
        self._node = node
        self.parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._inputs = np.zeros(len(AXES))
        self._commands = np.zeros(len(AXES))
        self._change_time = self._command_time = -math.inf  # [s]
        self._has_input = self._was_moving_joints = False
        twist, odom = (str(self.parameters[name]) for name in ("twist_topic", "odom_topic"))
        joints = str(self.parameters["joints_topic"])
        self._publish_twist = node.publisher(twist, TwistStamped) if twist else None
        self._publish_odom = None if twist or not odom else node.publisher(odom, Odometry)
        self._publish_joints = node.publisher(joints, JointState) if joints else None
        thrusters = str(self.parameters["thrusters_topic"])
        self._publish_thrusts = node.publisher(thrusters, Float64MultiArray) if thrusters else None
        lamps = str(self.parameters["lamp_topics"]).split()
        self._publish_lamps = [node.publisher(topic, Float64) for topic in lamps]
        self._brightness = 1.0
        self._uses_thrusters = bool(thrusters) and not twist and not odom
        self._open_autopilot(str(self.parameters["autopilot"]))
        names = str(self.parameters["joints"]).split()[:N_JOINTS]
        jaw = str(self.parameters["jaw"]).split()
        self._joints = [(f"joint{k}", name) for k, name in enumerate(names, start=1)]
        self._joints += [("jaw", name) for name in jaw]
        node.subscribe(TOPIC, Float64MultiArray, self._on_input)
        node.create_timer(PERIOD, self._on_timer)

    def _open_autopilot(self, name: str) -> None:
        """Open the topics of a ``<u:mavlink>`` of a name; none if it is empty."""
        publisher = self._node.publisher
        self._publish_sticks = publisher(f"{name}/sticks", Float64MultiArray) if name else None
        self._publish_arm = publisher(f"{name}/arm", Bool) if name else None
        self._publish_mode = publisher(f"{name}/mode", String) if name else None

    def _on_input(self, message: Float64MultiArray) -> None:
        values = np.asarray(message.data, dtype=np.float64)
        if values.ndim != 1 or len(values) > len(AXES) or not np.isfinite(values).all():
            return
        dead_zone = float(self.parameters["dead_zone"])
        values = np.clip(values, -1.0, 1.0)
        inputs = np.zeros(len(AXES))
        inputs[: len(values)] = np.where(np.abs(values) <= dead_zone, 0.0, values)
        is_changed = not self._has_input or not np.array_equal(inputs, self._inputs)
        self._publish_switches(self._inputs, inputs)
        self._inputs, self._has_input = inputs, True
        if is_changed:
            self._publish_commands()

    def _publish_switches(self, last_inputs: Array, inputs: Array) -> None:
        """Publish arming and modes whose inputs begin to be at their ends."""
        if self._publish_arm is None or self._publish_mode is None:
            return
        values = dict(
            zip(AXES, np.where(abs(last_inputs) > 0.5, 0.0, inputs).tolist(), strict=True)
        )
        if abs(values["arm"]) > 0.5:
            self._publish_arm(Bool(data=values["arm"] > 0.0))
        for axis, mode in MODE_AXES.items():
            if values[axis] > 0.5:
                self._publish_mode(String(data=mode))

    def _on_timer(self) -> None:
        for service in str(self.parameters["start"]).split():
            with suppress(UnknownName):  # the benchmark does not wait for it now
                self._node.call(service, Empty())
        if self._has_input or self._publish_sticks is not None:
            self._publish_commands()

    def _publish_commands(self) -> None:
        now = self._node.now
        dt, self._command_time = min(PERIOD, now - self._command_time), now
        step = float(self.parameters["rate"]) * min(PERIOD, now - self._change_time)
        change = np.clip(self._inputs - self._commands, -step, step)
        if change.any():
            self._commands, self._change_time = self._commands + change, now
        commands = dict(zip(AXES, self._commands.tolist(), strict=True))
        if self._publish_sticks is not None:
            sticks = np.array([commands[axis] for axis in STICK_AXES])
            layout = MultiArrayLayout(dim=[], data_offset=0)
            self._publish_sticks(Float64MultiArray(layout=layout, data=sticks))
        elif self._select_thrusters(commands):
            self._publish_thrust(commands)
        else:
            self._publish_twist_command(commands)
        self._publish_joint_speeds(commands)
        self._publish_brightness(commands["lamps"] * dt)

    def _select_thrusters(self, commands: Mapping[str, float]) -> bool:
        """Return whether to publish commands of single thrusters instead of a twist."""
        takes_twists = self._publish_twist is not None or self._publish_odom is not None
        if self._publish_thrusts is None or not takes_twists:
            return self._uses_thrusters
        has_thrust = any(commands[axis] for axis in THRUSTER_AXES)
        if has_thrust != any(commands[axis] for axis in TWIST_AXES):  # both or neither: no change
            self._uses_thrusters = has_thrust
        return self._uses_thrusters

    def _publish_thrust(self, commands: Mapping[str, float]) -> None:
        """Publish commands of all thrusters; those without an input axis get 0."""
        assert self._publish_thrusts is not None
        thrusts = np.zeros(int(float(self.parameters["n_thrusters"])))
        axes = THRUSTER_AXES[: len(thrusts)]
        thrusts[: len(axes)] = [float(self.parameters["thrust"]) * commands[axis] for axis in axes]
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._publish_thrusts(Float64MultiArray(layout=layout, data=thrusts))

    def _publish_twist_command(self, commands: Mapping[str, float]) -> None:
        speed, angular_speed = float(self.parameters["speed"]), float(self.parameters["turn"])
        z_sign = 1.0 if float(self.parameters["z_is_down"]) > 0.0 else -1.0
        components = (
            speed * commands["surge"],
            speed * z_sign * commands["sway"],
            -speed * z_sign * commands["heave"],
            angular_speed * commands["roll"],
            angular_speed * z_sign * commands["pitch"],
            angular_speed * z_sign * commands["yaw"],
        )
        twist = parse_twist(" ".join(f"{component:.9g}" for component in components))
        now = self._node.now
        if self._publish_twist is not None:
            self._publish_twist(TwistStamped(header=header(now), twist=twist))
        if self._publish_odom is not None:
            self._publish_odom(odometry_message(now, twist))

    def _publish_joint_speeds(self, commands: Mapping[str, float]) -> None:
        """Publish speeds of the joints while an axis is not 0, and then zeros once."""
        speeds = np.array([commands[axis] for axis, _ in self._joints])
        is_moving = bool(speeds.any())
        if self._publish_joints is None or not (is_moving or self._was_moving_joints):
            return
        self._was_moving_joints = is_moving
        self._publish_joints(
            JointState(
                header=header(self._node.now),
                name=[name for _, name in self._joints],
                position=np.zeros(0),
                velocity=float(self.parameters["joint_speed"]) * speeds,
                effort=np.zeros(0),
            )
        )

    def _publish_brightness(self, input_time: float) -> None:
        """Publish the brightness of all lamps if it changes.

        ``input_time`` is the command of the axis times the time for which it held [s].
        """
        change = float(self.parameters["dim_rate"]) * input_time
        brightness = min(1.0, max(0.0, self._brightness + change))
        if brightness != self._brightness:
            self._brightness = brightness
            for publish in self._publish_lamps:
                publish(Float64(data=brightness))
