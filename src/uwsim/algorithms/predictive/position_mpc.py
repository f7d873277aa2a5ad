r"""``mpc`` and ``dob-mpc``: model-predictive control of position by the wrench of all thrusters.

They read ``positionError``, ``referenceVelocity`` (0 if the environment has none),
``linearVelocity``, ``angularVelocity``, ``gravity`` and ``heading`` of an observation, and command
a wrench. The force is the first one of a plan (`planner`), whose model has the numbers of the
vehicle. The torque keeps the vehicle level and at its first heading:

.. math:: \tau = -J (\omega^2 \theta + 2 \omega \dot\theta)

``dob-mpc`` observes the disturbance d, the force that explains the velocity: with the velocity
:math:`\hat v` that the model predicts for the next observation after the time h, and the fraction
:math:`\gamma`,

.. math:: d \leftarrow d + \gamma \, m (v - \hat v) / h

so that it finds the drag of a current. ``mpc`` has d = 0. A wave is a disturbance that the plan
regards as constant.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ...bus import Node
from ...errors import BadSetting
from ...messages import Vector3, Wrench, WrenchStamped, header
from ..control.observation_controller import ObservationReader
from .planner import AxisModel, Planner

VECTORS = ("mass", "linear_drag", "quadratic_drag", "force_limit", "inertia")
"""The parameters that are three numbers, separated by blanks."""


class Mpc(ObservationReader):
    """A model-predictive controller of position, without an observer of disturbances."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "mass": "19.86 20.62 32.18",
        "linear_drag": "13.7 0 33",
        "quadratic_drag": "141 217 190",
        "weight": 0.98,
        "inertia": "0.449 0.365 0.592",
        "force_limit": "60 60 120",
        "force_weight": 0.02,
        "change_weight": 0.02,
        "attitude_rate": 3.0,
        "wrench_topic": "/bluerov2/wrench",
    }
    """The parameters with the numbers of ``bluerov2_heavy``: ``mass`` with added mass [kg],
    ``linear_drag`` [N s/m], ``quadratic_drag`` [N s2/m2], the ``weight`` in water [N], the moments
    of ``inertia`` with added ones [kg m2], ``force_limit`` [N], the weights of forces and changes
    [s2], and ``attitude_rate`` [rad/s]."""
    CHANNELS: ClassVar[tuple[str, ...]] = (
        "positionError", "linearVelocity", "angularVelocity", "gravity", "heading",
    )  # fmt: skip
    """The parts of the observation that are needed."""

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting for a vector that is not three numbers."""
        for name in VECTORS:
            if name in parameters:
                read_vector(name, parameters[name])

    def _read_parameters(self, parameters: Mapping[str, float | str]) -> None:
        super()._read_parameters(parameters)
        mass, linear, quadratic, limit, inertia = (
            read_vector(name, self._parameters[name]) for name in VECTORS
        )
        self._model = AxisModel(mass=mass, linear=linear, quadratic=quadratic, limit=limit)
        self._planner = Planner(
            self._model,
            force_weight=self._number("force_weight"),
            change_weight=self._number("change_weight"),
        )
        self._inertia, self._observer_gain = inertia, float(self._parameters.get("observer", 0.0))
        self._disturbance = np.zeros(3)  # [N]
        self._force = np.zeros(3)  # of thrusters and weight [N]
        self._velocity: Array | None = None  # at the last observation [m/s]
        self._yaw: float | None = None  # to hold [rad]

    def _open_topic(self, node: Node) -> None:
        self._publish = node.publisher(str(self._parameters["wrench_topic"]), WrenchStamped)

    def _act(self, parts: Mapping[str, Array], dt: float) -> None:
        velocity = np.array(parts["linearVelocity"])
        self._observe(velocity, dt)
        reference = parts.get("referenceVelocity", np.zeros(3))
        weight = self._number("weight") * parts["gravity"]
        force = self._planner.improve(
            parts["positionError"], velocity, reference, weight + self._disturbance
        )
        self._velocity, self._force = velocity, force + weight
        x, y, z = force.tolist()
        roll, pitch, yaw = self._torque(parts).tolist()
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=Vector3(x=roll, y=pitch, z=yaw))
        self._publish(WrenchStamped(header=header(self._node.now), wrench=wrench))

    def _observe(self, velocity: Array, dt: float) -> None:
        """Correct the disturbance by the error of the predicted velocity."""
        if self._velocity is None or dt <= 0.0 or not self._observer_gain:
            return
        acceleration = self._model.acceleration(self._velocity, self._force + self._disturbance)
        error = velocity - self._velocity - dt * acceleration
        self._disturbance = self._disturbance + self._observer_gain * self._model.mass * error / dt

    def _torque(self, parts: Mapping[str, Array]) -> Array:
        """Return the torque that keeps the attitude, (3,) [N m]."""
        (bow_x, bow_y), (gx, gy, gz) = parts["heading"].tolist(), parts["gravity"].tolist()
        yaw = math.atan2(bow_y, bow_x)
        self._yaw = yaw if self._yaw is None else self._yaw
        turn = math.remainder(yaw - self._yaw, 2.0 * math.pi)
        angles = np.array([math.atan2(gy, gz), -math.asin(max(-1.0, min(1.0, gx))), turn])
        rate = self._number("attitude_rate")
        torque: Array = -self._inertia * (
            rate * rate * angles + 2.0 * rate * parts["angularVelocity"]
        )
        return torque


class DobMpc(Mpc):
    """A model-predictive controller of position with an observer of disturbances."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**Mpc.PARAMETERS, "observer": 0.2}
    """The parameters of `Mpc`, and the fraction ``observer`` of the error of the velocity [1]."""


def read_vector(name: str, value: float | str) -> Array:
    """Return a parameter of three numbers as an array (3,).

    Raises:
        BadSetting: it is something else.
    """
    try:
        numbers = [float(word) for word in str(value).split()]
    except ValueError:
        numbers = []
    if len(numbers) != 3 or not all(0.0 <= number < math.inf for number in numbers):
        raise BadSetting(f"algorithm.{name} is {value!r}; expected three numbers of at least 0.")
    return np.array(numbers)
