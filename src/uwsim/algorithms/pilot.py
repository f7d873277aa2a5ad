"""``pilot``: a human at the live view, who is scored like an algorithm."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

import numpy as np

from ..bus import Node
from ..errors import UnknownName
from ..messages import (
    Empty,
    Float64,
    Float64MultiArray,
    JointState,
    MultiArrayLayout,
    Odometry,
    TwistStamped,
    header,
)
from .scripted import odometry, twist_of
from .tracker_node import chosen

TOPIC = "pilotInputs"
"""Topic on which a pilot's inputs come, one number an axis, -1..1; axes without one are at 0."""
N_JOINTS = 6
"""Joints that have an axis, beside the jaw."""
N_THRUSTERS = 12
"""Thrusters that have an axis."""
TWIST_AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
"""Of the vehicle: ahead, to starboard, up; starboard down, bow up, to starboard."""
THRUSTER_AXES = tuple(f"thruster{k}" for k in range(1, N_THRUSTERS + 1))
"""Of single thrusters, in the order of the vehicle's hydrodynamics file: their commands."""
AXES = (
    *TWIST_AXES,
    "jaw",
    *(f"joint{k}" for k in range(1, N_JOINTS + 1)),
    *THRUSTER_AXES,
    "lamps",
)
"""What the numbers are, new ones last: twist; jaw open; joints on; thrusters; brighter lamps."""
PERIOD = 0.05
"""Between two commands while no input changes [s]."""


class Pilot:
    """A human pilot: inputs of the live view become commands of a vehicle and its joints.

    An input within the dead zone counts as none; what is commanded follows the input at a limited
    rate: an input that changes is followed at once, as far as it may be in `PERIOD` after a rest.
    Before the first input nothing is commanded. A vehicle that takes twists and commands of
    single thrusters gets those whose axes were moved last; at first twists. All lamps are dimmed
    together, from full brightness on. Services and topics are named with blanks between them;
    those of the scene are found without being given.
    """

    IS_PILOTED: ClassVar[bool] = True
    """Inputs come from outside, and are kept with the result."""
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
        "z_is_down": 1.0,
        "speed": 0.4,
        "turn": 0.3,
        "thrust": 1.0,
        "joint_speed": 0.3,
        "dim_rate": 0.5,
        "rate": 2.0,
        "dead_zone": 0.05,
    }

    def start(self, node: Node) -> None:
        """Listen to the inputs, and command from then on."""
        self._node = node
        self.parameters = chosen(self.PARAMETERS, node.parameters)
        self._wanted = np.zeros(len(AXES))
        self._given = np.zeros(len(AXES))
        self._changed = self._commanded = -math.inf  # when what is given changed, and was sent [s]
        self._has_begun = self._was_moving_joints = False
        twist, odom = (str(self.parameters[name]) for name in ("twist_topic", "odom_topic"))
        joints = str(self.parameters["joints_topic"])
        self._say_twist = node.publisher(twist, TwistStamped) if twist else None
        self._say_odom = None if twist or not odom else node.publisher(odom, Odometry)
        self._say_joints = node.publisher(joints, JointState) if joints else None
        thrusters = str(self.parameters["thrusters_topic"])
        self._say_thrusters = node.publisher(thrusters, Float64MultiArray) if thrusters else None
        lamps = str(self.parameters["lamp_topics"]).split()
        self._say_lamps = [node.publisher(topic, Float64) for topic in lamps]
        self._brightness = 1.0
        self._by_thrusters = bool(thrusters) and not twist and not odom
        names = str(self.parameters["joints"]).split()[:N_JOINTS]
        jaw = str(self.parameters["jaw"]).split()
        self._joints = [(f"joint{k}", name) for k, name in enumerate(names, start=1)]
        self._joints += [("jaw", name) for name in jaw]
        node.subscribe(TOPIC, Float64MultiArray, self._on_input)
        node.create_timer(PERIOD, self._go_on)

    def _on_input(self, message: Float64MultiArray) -> None:
        values = np.asarray(message.data, dtype=np.float64)
        if values.ndim != 1 or len(values) > len(AXES) or not np.isfinite(values).all():
            return
        dead = float(self.parameters["dead_zone"])
        values = np.clip(values, -1.0, 1.0)
        wanted = np.zeros(len(AXES))
        wanted[: len(values)] = np.where(np.abs(values) <= dead, 0.0, values)
        is_news = not self._has_begun or not np.array_equal(wanted, self._wanted)
        self._wanted, self._has_begun = wanted, True
        if is_news:
            self._command()

    def _go_on(self) -> None:
        for service in str(self.parameters["start"]).split():
            with suppress(UnknownName):  # nobody waits for it just now
                self._node.call(service, Empty())
        if self._has_begun:
            self._command()

    def _command(self) -> None:
        now = self._node.now
        passed, self._commanded = min(PERIOD, now - self._commanded), now
        step = float(self.parameters["rate"]) * min(PERIOD, now - self._changed)
        change = np.clip(self._wanted - self._given, -step, step)
        if change.any():
            self._given, self._changed = self._given + change, now
        given = dict(zip(AXES, self._given.tolist(), strict=True))
        if self._takes_thrusters(given):
            self._thrust(given)
        else:
            self._drive(given)
        self._move_joints(given)
        self._dim(given["lamps"] * passed)

    def _takes_thrusters(self, given: Mapping[str, float]) -> bool:
        """Whether single thrusters are commanded now, and no twist."""
        if self._say_thrusters is None or (self._say_twist is None and self._say_odom is None):
            return self._by_thrusters
        thrusts = any(given[axis] for axis in THRUSTER_AXES)
        if thrusts != any(given[axis] for axis in TWIST_AXES):  # both at once: as before
            self._by_thrusters = thrusts
        return self._by_thrusters

    def _thrust(self, given: Mapping[str, float]) -> None:
        """Command all thrusters; those without an axis stand still."""
        assert self._say_thrusters is not None
        commands = np.zeros(int(float(self.parameters["n_thrusters"])))
        axes = THRUSTER_AXES[: len(commands)]
        commands[: len(axes)] = [float(self.parameters["thrust"]) * given[axis] for axis in axes]
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._say_thrusters(Float64MultiArray(layout=layout, data=commands))

    def _drive(self, given: Mapping[str, float]) -> None:
        speed, turn = float(self.parameters["speed"]), float(self.parameters["turn"])
        down = 1.0 if float(self.parameters["z_is_down"]) > 0.0 else -1.0
        numbers = (
            speed * given["surge"],
            speed * down * given["sway"],
            -speed * down * given["heave"],
            turn * given["roll"],
            turn * down * given["pitch"],
            turn * down * given["yaw"],
        )
        twist = twist_of(" ".join(f"{number:.9g}" for number in numbers))
        now = self._node.now
        if self._say_twist is not None:
            self._say_twist(TwistStamped(header=header(now), twist=twist))
        if self._say_odom is not None:
            self._say_odom(odometry(now, twist))

    def _move_joints(self, given: Mapping[str, float]) -> None:
        """Command speeds of the joints while one is moved, and once more when they stop."""
        speeds = np.array([given[axis] for axis, _ in self._joints])
        moves = bool(speeds.any())
        if self._say_joints is None or not (moves or self._was_moving_joints):
            return
        self._was_moving_joints = moves
        self._say_joints(
            JointState(
                header=header(self._node.now),
                name=[name for _, name in self._joints],
                position=np.zeros(0),
                velocity=float(self.parameters["joint_speed"]) * speeds,
                effort=np.zeros(0),
            )
        )

    def _dim(self, moved: float) -> None:
        """Command the brightness of all lamps when it changes; ``moved``: the axis times time."""
        change = float(self.parameters["dim_rate"]) * moved
        brightness = min(1.0, max(0.0, self._brightness + change))
        if brightness != self._brightness:
            self._brightness = brightness
            for say in self._say_lamps:
                say(Float64(data=brightness))
