"""The bases of controllers that read the observation of a benchmark."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from typing import ClassVar

from ...base.geometry import Array
from ...bus import Node
from ...errors import BadSetting
from ...messages import Float64MultiArray, TwistStamped
from ..parametric import ParametricAlgorithm, start_benchmark, velocity_command
from ..policy import OBSERVATION, slices_of


class ObservationReader(ParametricAlgorithm, abc.ABC):
    """An algorithm that acts on each observation of a benchmark."""

    CHANNELS: ClassVar[tuple[str, ...]] = ("positionError",)
    """The parts of the observation that are needed."""
    KIND: ClassVar[str] = "controller"
    """The kind of the algorithm in messages."""

    def __init__(self) -> None:
        super().__init__()
        self._time: float | None = None

    def start(self, node: Node) -> None:
        """Read the parameters, subscribe to the observations, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        self._open_topic(node)
        node.subscribe(OBSERVATION, Float64MultiArray, self._on_observation)
        start_benchmark(node)

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
        self._publish(velocity_command(velocity, turn_rate, time=self._node.now))
