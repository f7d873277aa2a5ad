r"""``operator-continuous``, ``operator-wait``, ``operator-predict``: models of human operators.

An operator drives a vehicle along a known route and holds it at its end, over a link with a delay.
He sees what the vehicle reports: the velocity of a DVL, attitude and depth, and the position that
follows from these since the known start. He knows the delay from the time stamps of the reports.
Each counters the current that he has recognised.

- *continuous*: he steers at all times by what he sees, as in the crossover model (McRuer and
  Krendel 1974): the velocity is proportional to the error with the gain ``kp``, after his
  ``reaction`` time :math:`\tau`. With the delay d in each direction, the loop is unstable above
  :math:`k_p (2 d + \tau) = \pi / 2`.
- *wait*: move and wait (Ferrell 1965): he commands a move of up to ``step``, waits until he has
  seen its end, and then commands the next one.
- *predict*: as the first, by a display that shows where the vehicle will be when the command
  arrives (`MotionModel`).

Not modelled: errors and noise of humans, fatigue, what is seen in images. The heading is not
controlled; the vehicle holds it.
"""

from __future__ import annotations

import abc
from collections import deque
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length, rotate_back
from ...bus import Node
from ...messages import Imu, TwistStamped, seconds
from ..navigation.navigator import Navigator
from ..parametric import ParametricAlgorithm, start_benchmark, velocity_command
from .motion_model import MotionModel
from .route import Route

PERIOD = 0.1
"""The time between two commands [s]."""
SMALL_MOVE = 0.05
"""The length below which a move is not worth a wait [m]."""


class Operator(ParametricAlgorithm, abc.ABC):
    """A model of an operator, who reads and writes the operator's topics of a link."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "route": "-4.5 0 -2.4 0.8 -0.6 0.8 1.1 -0.8 2.9 -0.8 4.6 0",
        "depth": 1.8,
        "speed": 0.4,
        "kp": 0.5,
        "look_ahead": 0.8,
        "reaction": 0.3,
        "lag": 0.5,
        "imu_topic": "/operator/imu",
        "dvl_topic": "/operator/dvl",
        "depth_topic": "/operator/depth",
        "twist_topic": "/operator/twist",
    }
    """The ``route``, north and east of its corners in L [m], from the known start to the place that
    is held; the ``depth`` [m]; the largest ``speed`` [m/s] and the gain ``kp`` [1/s]; the distance
    ``look_ahead`` of the point that the operator steers to [m]; the ``reaction`` time [s]; the time
    constant ``lag`` that he expects of the vehicle [s]; and topics."""

    def start(self, node: Node) -> None:
        """Subscribe to the reports, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        self._route = Route.parse(str(self._parameters["route"]))
        topics = {name: str(self._parameters[f"{name}_topic"]) for name in ("imu", "dvl", "depth")}
        node.subscribe(topics["imu"], Imu, self._on_imu)
        self._navigator = Navigator(node, {f"{name}_topic": topics[name] for name in topics})
        self.model = MotionModel(self.number("lag"))
        """The motion that the operator expects of the vehicle."""
        self._report_time = 0.0  # of the newest report [s]
        n_waiting = round(self.number("reaction") / PERIOD)
        self._intentions = deque([np.zeros(3)] * n_waiting)  # (3,) each [m/s]
        self._publish = node.publisher(str(self._parameters["twist_topic"]), TwistStamped)
        node.create_timer(PERIOD, self._command)
        start_benchmark(node)

    def number(self, name: str) -> float:
        """Return a parameter that is a number."""
        return self._number(name)

    def _on_imu(self, message: Imu) -> None:
        self._report_time = seconds(message.header.stamp)

    @property
    def delay(self) -> float:
        """The age of the newest report, which is taken for the delay in each direction [s]."""
        return self._node.now - self._report_time

    def predicted_position(self) -> Array:
        """Return where the vehicle is when a command arrives that is sent now, (3,) [m]."""
        position = self.reported_position()
        sent_time = self._report_time - self.delay
        return position + self.model.displacement_since(sent_time, 2.0 * self.delay)

    def reported_position(self) -> Array:
        """Return the position of the newest report, north, east, down, (3,) [m]."""
        position = self._navigator.pose.position
        position[:2] += self._route.start
        return position

    @abc.abstractmethod
    def choose_velocity(self, now: float) -> Array:
        """Return the intended velocity over ground at a time [s], navigation axes, (3,) [m/s]."""

    def steer_from(self, position: Array) -> Array:
        """Return the velocity towards a point ahead of a position on the route, (3,) [m/s]."""
        self._route.advance(position[:2])
        return self._limit(self.number("kp") * self.error_from(position, self.number("look_ahead")))

    def error_from(self, position: Array, distance: float) -> Array:
        """Return the vector from a position to the point at a distance [m] ahead, (3,) [m]."""
        goal = np.array([*self._route.point_ahead(distance), self.number("depth")])
        error: Array = goal - position
        return error

    def advance(self, position: Array) -> None:
        """Move the progress along the route on to a position, (3,) [m]."""
        self._route.advance(position[:2])

    def _limit(self, velocity: Array) -> Array:
        speed = length(velocity)
        return velocity * min(1.0, self.number("speed") / speed) if speed > 0.0 else velocity

    def _command(self) -> None:
        if not self._navigator.is_ready:
            return
        now = self._node.now
        sent_time = self._report_time - self.delay
        self.model.update_current(self._navigator.velocity, sent_time, PERIOD)
        self._intentions.append(self.choose_velocity(now) - self.model.current)
        velocity = self._intentions.popleft()
        self.model.add_command(now, velocity, PERIOD)
        command = rotate_back(self._navigator.pose.rotation, velocity)
        self._publish(velocity_command(command, 0.0, time=now))


class OperatorContinuous(Operator):
    """An operator who steers at all times by what he sees."""

    def choose_velocity(self, now: float) -> Array:
        """Return the velocity towards the point ahead of the reported position, (3,) [m/s]."""
        return self.steer_from(self.reported_position())


class OperatorPredict(Operator):
    """An operator with a display that predicts the vehicle over the delay."""

    def choose_velocity(self, now: float) -> Array:
        """Return the velocity towards the point ahead of the predicted position, (3,) [m/s]."""
        return self.steer_from(self.predicted_position())


class OperatorWait(Operator):
    """An operator who commands a move, and waits until he has seen its end."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Operator.PARAMETERS,
        "step": 1.5,
        "settling": 1.5,
    }
    """The parameters of `Operator`; the longest move ``step`` [m]; and the time until the vehicle
    has stopped, ``settling`` [s]."""

    def __init__(self) -> None:
        super().__init__()
        self._move = np.zeros(3)  # the velocity of the present move [m/s]
        self._end_time = 0.0  # of the present move [s]

    def choose_velocity(self, now: float) -> Array:
        """Return the velocity of the present move; zero while the operator waits, (3,) [m/s]."""
        if now < self._end_time:
            return self._move
        shows_end = self._report_time - self.delay - self.number("reaction")
        if shows_end < self._end_time + self.number("settling"):
            return np.zeros(3)
        position = self.reported_position()
        self.advance(position)
        error = self.error_from(position, self.number("step"))
        distance = length(error)
        if distance < SMALL_MOVE:
            return np.zeros(3)
        duration = max(PERIOD, round(distance / self.number("speed") / PERIOD) * PERIOD)
        self._move, self._end_time = error / duration, now + duration
        return self._move
