r"""``position-p`` and ``position-pi``: controllers of position with the true position error.

They read the ``positionError`` e of an environment's observation, in the axes of the vehicle, and
command a velocity through the water, which the vehicle's velocity loops keep:

.. math:: u = K_p e + K_i \int e \, dt, \qquad |u_i| \le u_{max}

In a steady current c, without an integral, the vehicle stays :math:`c / K_p` from its place. The
integral of an axis is held while its command is at the limit. The heading stays as it is: the
commanded turn rates are 0. The velocity of a moving place is not used.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..bus import Node
from ..errors import BadSetting, UnknownName
from ..messages import Empty, Float64MultiArray, Twist, TwistStamped, Vector3, header
from .policy import OBSERVATION, START_SERVICE, slices_of
from .tracker_node import merge_parameters

CHANNEL = "positionError"
"""The part of the observation that is used."""


class PositionPI:
    """A proportional-integral controller of position: no offset in a steady current."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 0.8,
        "ki": 0.1,
        "limit": 0.6,
        "twist_topic": "/bluerov2/twist",
    }
    """The gains ``kp`` [1/s] and ``ki`` [1/s^2], the speed ``limit`` of an axis [m/s], and the
    topic of the commands."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._integral = np.zeros(3)  # [m s]
        self._time: float | None = None

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    def start(self, node: Node) -> None:
        """Read the parameters, subscribe to the observations, and start the benchmark."""
        self._parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._node = node
        self._publish = node.publisher(str(self._parameters["twist_topic"]), TwistStamped)
        node.subscribe(OBSERVATION, Float64MultiArray, self._on_observation)
        with suppress(UnknownName):
            node.call(START_SERVICE, Empty())

    def _number(self, name: str) -> float:
        return float(self._parameters.get(name, 0.0))

    def _on_observation(self, message: Float64MultiArray) -> None:
        part = slices_of(message).get(CHANNEL)
        if part is None:
            raise BadSetting(f"The observation has no {CHANNEL}, which this controller needs.")
        speeds = self._command(message.data[part])
        x, y, z = speeds.tolist()
        twist = Twist(linear=Vector3(x=x, y=y, z=z), angular=Vector3(x=0.0, y=0.0, z=0.0))
        self._publish(TwistStamped(header=header(self._node.now), twist=twist))

    def _command(self, error: Array) -> Array:
        """Return the commanded velocity in the axes of the vehicle, (3,) [m/s]."""
        dt = 0.0 if self._time is None else self._node.now - self._time
        self._time = self._node.now
        kp, ki, limit = (self._number(name) for name in ("kp", "ki", "limit"))
        integral = self._integral + error * dt
        speeds = kp * error + ki * integral
        is_winding_up = (np.abs(speeds) > limit) & (speeds * error > 0.0)
        self._integral = np.where(is_winding_up, self._integral, integral)
        command: Array = np.clip(kp * error + ki * self._integral, -limit, limit)
        return command


class PositionP(PositionPI):
    """A proportional controller of position: a steady current c leaves the offset c/kp."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        name: value for name, value in PositionPI.PARAMETERS.items() if name != "ki"
    }
    """The parameters of `PositionPI` without the integral."""
