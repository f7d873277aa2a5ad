r"""Visual station keeping: a vehicle stays over a target that it tracks with a camera.

With the tracked centroid c and the principal point o [px], the focal length f [px] and the distance
d to the target [m], the position error in the axes of the camera is [m]

.. math:: e = (c - o) \, d / f

The control law receives e forward and to starboard, which are up and right in the image. d is a
*parameter*, since a camera cannot measure it. The commanded velocity is

.. math:: u = K_p e + K_i \int e \, dt, \qquad |u_i| \le u_{max}

The integral of an axis is held constant while the command of the axis is at the limit and the error
would increase the integral further (anti-windup by clamping). dt is the time between two estimates.
The published twist has x forward and y to starboard, not to port as in REP 103. Errors in d and
tilt of the vehicle are not modelled.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Protocol

import numpy as np

from ...base.geometry import Array
from ...bus import Node
from ...messages import (
    CameraInfo,
    Float32MultiArray,
    String,
    Twist,
    TwistStamped,
    Vector3,
    header,
)
from ..direct import Esm
from ..tracker_node import merge_parameters
from .node_view import NodeView

PARAMETERS: Mapping[str, float | str] = {
    "kp": 0.4,
    "ki": 0.0,
    "distance": 2.2,
    "limit": 0.5,
    "info_topic": "/uwsim/camera1_info",
    "twist_topic": "/dataNavigator",
}
"""The parameters of the controllers, with their defaults.

The gains ``kp`` [1/s] and ``ki`` [1/s^2], the ``distance`` d to the target [m], the speed ``limit``
[m/s], and the topics of the camera's intrinsics and of the commands."""


class Law(Protocol):
    """A control law that computes speeds from position errors."""

    def step(self, error: Array, dt: float) -> Array:
        """Compute the commanded velocity, which the node then limits to its parameter ``limit``.

        Args:
            error: the position error, forward and to starboard, (2,) [m].
            dt: the time since the last call [s], 0 at the first call.

        Returns:
            Surge and sway, (2,) [m/s].
        """


def check_speeds(output: object, law_name: str) -> Array:
    """Convert the output of a control law to surge and sway, (2,) [m/s].

    Raises:
        ValueError: the output is not two finite numbers.
    """
    try:
        speeds = np.asarray(output, dtype=np.float64)
    except (TypeError, ValueError):
        speeds = np.empty(0)
    if speeds.shape != (2,) or not np.isfinite(speeds).all():
        text = " ".join(repr(output).split())[:60]
        raise ValueError(f"the law {law_name} returned {text}; expected two finite speeds [m/s]")
    return speeds


class StationKeeper:
    """A proportional-integral control law with anti-windup.

    Args:
        kp: the proportional gain [1/s].
        ki: the integral gain [1/s^2].
        limit: the greatest speed along an axis [m/s].
        n_axes: the number of axes n.
    """

    def __init__(self, *, kp: float, ki: float, limit: float, n_axes: int = 2) -> None:
        self._kp, self._ki, self._limit = kp, ki, limit
        self._integral = np.zeros(n_axes)  # [m s]

    def step(self, error: Array, dt: float) -> Array:
        """Compute the speeds along the axes, (n,) [m/s]; see `Law`."""
        integral = self._integral + error * dt
        speeds = self._kp * error + self._ki * integral
        is_winding_up = (np.abs(speeds) > self._limit) & (speeds * error > 0.0)
        self._integral = np.where(is_winding_up, self._integral, integral)
        command: Array = np.clip(
            self._kp * error + self._ki * self._integral, -self._limit, self._limit
        )
        return command


class ControllerNode:
    """A station-keeping algorithm that tracks its target with ESM.

    The camera points down, with the top of its image towards the bow. A target to the right of the
    image centre causes sway to starboard, a target above the centre causes surge forward. The
    vehicle keeps each commanded twist until the next one; a zero twist is published when the
    target is lost. Each call of ``autoInit`` sets a new target and makes a new law, as the integral
    belongs to the old target.
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**Esm.PARAMETERS, **PARAMETERS}
    """The parameters with their defaults."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._info: CameraInfo | None = None
        self._last_time: float | None = None
        self._is_lost = False
        self._tracker = Esm()

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the tracker."""
        self._parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._node = node
        self._law = self.law()
        self._publish_twist = node.publisher(str(self._parameters["twist_topic"]), TwistStamped)
        node.subscribe(str(self._parameters["info_topic"]), CameraInfo, self._on_info)
        node.subscribe("centroidTopic", Float32MultiArray, self._on_centroid)
        node.subscribe("algorithmStatus", String, self._on_status)
        tracking = {name: self._parameters[name] for name in Esm.PARAMETERS}
        self._tracker.start(NodeView(node, tracking))

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting if the tracker cannot use the parameters."""
        Esm.check_parameters(parameters)

    def law(self) -> Law:
        """Make the control law; a derived class may return its own."""
        return StationKeeper(
            kp=self._number("kp"), ki=self._number("ki"), limit=self._number("limit")
        )

    def _number(self, name: str) -> float:
        return float(self._parameters[name])

    def _on_info(self, info: CameraInfo) -> None:
        self._info = info

    def _on_centroid(self, centroid: Float32MultiArray) -> None:
        if self._info is None or self._is_lost:
            return
        fx, cx, fy, cy = (float(self._info.k[i]) for i in (0, 2, 4, 5))
        u, v = (float(x) for x in centroid.data[:2])
        distance = self._number("distance")
        right, up = (u - cx) * distance / fx, (cy - v) * distance / fy  # [m]
        dt = 0.0 if self._last_time is None else self._node.now - self._last_time
        self._last_time = self._node.now
        speeds = check_speeds(self._law.step(np.array([up, right]), dt), type(self._law).__name__)
        limit = self._number("limit")
        self._publish_command(*np.clip(speeds, -limit, limit).tolist())

    def _on_status(self, status: String) -> None:
        if status.data.startswith(("lost", "failed")):
            self._is_lost = True
            self._publish_command(0.0, 0.0)
        elif status.data == "tracking":
            self._law, self._last_time, self._is_lost = self.law(), None, False

    def _publish_command(self, surge: float, sway: float) -> None:
        self._publish_twist(
            TwistStamped(
                header=header(self._node.now),
                twist=Twist(
                    linear=Vector3(x=surge, y=sway, z=0.0), angular=Vector3(x=0.0, y=0.0, z=0.0)
                ),
            )
        )
