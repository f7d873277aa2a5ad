"""The bases of controllers that read the observation of a benchmark."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

from ...base.geometry import Array
from ...bus import Node
from ...errors import BadSetting, UnknownName
from ...messages import Empty, Float64MultiArray, Twist, TwistStamped, Vector3, header
from ..policy import OBSERVATION, START_SERVICE, slices_of
from ..tracker_node import merge_parameters


class ObservationReader(abc.ABC):
    """An algorithm that acts on each observation of a benchmark."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {}
    """The parameters with their defaults."""
    CHANNELS: ClassVar[tuple[str, ...]] = ("positionError",)
    """The parts of the observation that are needed."""
    KIND: ClassVar[str] = "controller"
    """The kind of the algorithm in messages."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._time: float | None = None

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    def start(self, node: Node) -> None:
        """Read the parameters, subscribe to the observations, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        self._open_topic(node)
        node.subscribe(OBSERVATION, Float64MultiArray, self._on_observation)
        with suppress(UnknownName):
            node.call(START_SERVICE, Empty())

    @property
    def channels(self) -> tuple[str, ...]:
        """The parts of the observation that are needed."""
        return self.CHANNELS

    @abc.abstractmethod
    def _open_topic(self, node: Node) -> None:
        """Open the topic of the commands."""

    @abc.abstractmethod
    def _act(self, parts: Mapping[str, Array], dt: float) -> None:
        """Publish a command.

        Args:
            parts: the parts of the observation by name.
            dt: the time since the last observation, 0 at the first one [s].
        """

    def _read_parameters(self, parameters: Mapping[str, float | str]) -> None:
        self._parameters = merge_parameters(self.PARAMETERS, parameters)

    def _number(self, name: str) -> float:
        return float(self._parameters[name])

    def _on_observation(self, message: Float64MultiArray) -> None:
        parts = {name: message.data[part] for name, part in slices_of(message).items()}
        for channel in self.channels:
            if channel not in parts:
                raise BadSetting(f"The observation has no {channel}, which this {self.KIND} needs.")
        dt = 0.0 if self._time is None else self._node.now - self._time
        self._time = self._node.now
        self._act(parts, dt)


class ObservationController(ObservationReader):
    """A controller of a vehicle whose velocity loops keep the commanded velocity."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {"twist_topic": "/bluerov2/twist"}
    """The parameters with their defaults; ``twist_topic`` is the topic of the commands."""

    @abc.abstractmethod
    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the commanded velocity in the axes of the vehicle, and the turn rate.

        Args:
            parts: the parts of the observation by name.
            dt: the time since the last observation, 0 at the first one [s].

        Returns:
            The velocity (3,) [m/s] and the rate of turn about the z axis of the vehicle [rad/s].
        """

    def _open_topic(self, node: Node) -> None:
        self._publish = node.publisher(str(self._parameters["twist_topic"]), TwistStamped)

    def _act(self, parts: Mapping[str, Array], dt: float) -> None:
        velocity, turn_rate = self.command(parts, dt)
        x, y, z = velocity.tolist()
        twist = Twist(linear=Vector3(x=x, y=y, z=z), angular=Vector3(x=0.0, y=0.0, z=turn_rate))
        self._publish(TwistStamped(header=header(self._node.now), twist=twist))
