r"""Visual station keeping over a tracked target.

The error in metres, in the camera's axes, of the tracked centroid c from the principal point o is

.. math:: e = (c - o) \, d / f

with a *parameter* d for the distance that the camera cannot measure. The command is

.. math:: u = K_p e + K_i \int e \, dt, \qquad |u_i| \le u_{max}

The integral stands still in an axis while its command is at the limit and the error would drive
it further (clamping). Time is that between two estimates. Not modelled: that d may be wrong, tilt.
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
from ..tracker_node import chosen
from .node_view import NodeView

PARAMETERS: Mapping[str, float | str] = {
    "kp": 0.4,
    "ki": 0.0,
    "distance": 2.2,
    "limit": 0.5,
    "info_topic": "/uwsim/camera1_info",
    "twist_topic": "/dataNavigator",
}
"""Gains [1/s, 1/s^2], distance d to the target [m], largest speed [m/s], topics."""


class Law(Protocol):
    """A control law: position errors in, speeds out."""

    def step(self, error: Array, dt: float) -> Array:
        """Return surge and sway (2,) [m/s] for the error forward and to starboard (2,) [m].

        ``dt`` is the time since the last call [s], 0 at the first. The node holds both speeds to
        its parameter ``limit``, whatever the law.
        """


def speeds_of(returned: object, law: str) -> Array:
    """Return the output of a control law, any two numbers, as speeds (2,) [m/s].

    Raises:
        ValueError: they are no two finite numbers.
    """
    try:
        speeds = np.asarray(returned, dtype=np.float64)
    except (TypeError, ValueError):
        speeds = np.empty(0)
    if speeds.shape != (2,) or not np.isfinite(speeds).all():
        shown = " ".join(repr(returned).split())[:60]
        raise ValueError(f"the law {law} returned {shown}; expected two finite speeds [m/s]")
    return speeds


class StationKeeper:
    """A PI control law with an anti-windup: position errors in, speeds out."""

    def __init__(self, *, kp: float, ki: float, limit: float) -> None:
        self._kp, self._ki, self._limit = kp, ki, limit
        self._integral = np.zeros(2)  # [m s]

    def step(self, error: Array, dt: float) -> Array:
        """Return the speeds (2,) [m/s] for an error (2,) [m], ``dt`` [s] after the last one."""
        integral = self._integral + error * dt
        wanted = self._kp * error + self._ki * integral
        pushes_on = (np.abs(wanted) > self._limit) & (wanted * error > 0.0)
        self._integral = np.where(pushes_on, self._integral, integral)
        command: Array = np.clip(
            self._kp * error + self._ki * self._integral, -self._limit, self._limit
        )
        return command


class ControllerNode:
    """A station keeper on the bus, with an ESM tracker of its own.

    The camera looks down and the top of its image points to the bow: what is right of the centre
    calls for sway to starboard, what is above it for surge. The twist is held by the vehicle until
    the next one; when the tracker is lost, it is zero. Each time the tracker is given its
    target is (``autoInit``) the law begins anew: what it summed up was about another place.
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**Esm.PARAMETERS, **PARAMETERS}

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._info: CameraInfo | None = None
        self._last: float | None = None
        self._is_over = False
        self._tracker = Esm()

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    def start(self, node: Node) -> None:
        """Read the parameters, connect to the bus, start the tracker."""
        self._parameters = chosen(self.PARAMETERS, node.parameters)
        self._node = node
        self._law = self.law()
        self._say = node.publisher(str(self._parameters["twist_topic"]), TwistStamped)
        node.subscribe(str(self._parameters["info_topic"]), CameraInfo, self._on_info)
        node.subscribe("centroidTopic", Float32MultiArray, self._on_centroid)
        node.subscribe("algorithmStatus", String, self._on_status)
        tracking = {name: self._parameters[name] for name in Esm.PARAMETERS}
        self._tracker.start(NodeView(node, tracking))

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Refuse what the tracker cannot use, with BadSetting."""
        Esm.check_parameters(parameters)

    def law(self) -> Law:
        """Return the law that turns errors into speeds; one of your own goes here."""
        return StationKeeper(
            kp=self._number("kp"), ki=self._number("ki"), limit=self._number("limit")
        )

    def _number(self, name: str) -> float:
        return float(self._parameters[name])

    def _on_info(self, info: CameraInfo) -> None:
        self._info = info

    def _on_centroid(self, centroid: Float32MultiArray) -> None:
        if self._info is None or self._is_over:
            return
        fx, cx, fy, cy = (float(self._info.k[i]) for i in (0, 2, 4, 5))
        u, v = (float(x) for x in centroid.data[:2])
        distance = self._number("distance")
        right, up = (u - cx) * distance / fx, (cy - v) * distance / fy  # [m]
        dt = 0.0 if self._last is None else self._node.now - self._last
        self._last = self._node.now
        speeds = speeds_of(self._law.step(np.array([up, right]), dt), type(self._law).__name__)
        limit = self._number("limit")
        self._command(*np.clip(speeds, -limit, limit).tolist())

    def _on_status(self, status: String) -> None:
        if status.data.startswith(("lost", "failed")):
            self._is_over = True
            self._command(0.0, 0.0)
        elif status.data == "tracking":
            self._law, self._last, self._is_over = self.law(), None, False

    def _command(self, surge: float, sway: float) -> None:
        self._say(
            TwistStamped(
                header=header(self._node.now),
                twist=Twist(
                    linear=Vector3(x=surge, y=sway, z=0.0), angular=Vector3(x=0.0, y=0.0, z=0.0)
                ),
            )
        )
