"""The base of algorithms with parameters, and what most of them send."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

from ..base.geometry import Array
from ..bus import Node
from ..errors import UnknownName
from ..messages import Empty, Twist, TwistStamped, Vector3, header
from .policy import START_SERVICE
from .tracker_node import merge_parameters


class ParametricAlgorithm:
    """An algorithm with parameters."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {}
    """The parameters with their defaults."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    def _read_parameters(self, parameters: Mapping[str, float | str]) -> None:
        self._parameters = merge_parameters(self.PARAMETERS, parameters)

    def _number(self, name: str) -> float:
        return float(self._parameters[name])

    def _text(self, name: str) -> str:
        return str(self._parameters[name])


def start_benchmark(node: Node) -> None:
    """Call the service that starts the benchmark, if there is one."""
    with suppress(UnknownName):
        node.call(START_SERVICE, Empty())


def velocity_command(velocity: Array, turn_rate: float, *, time: float) -> TwistStamped:
    """Return the message of a commanded velocity, in the axes of the vehicle.

    Args:
        velocity: the velocity, (3,) [m/s].
        turn_rate: the rate of turn about the z axis of the vehicle [rad/s].
        time: the time of the stamp [s].
    """
    x, y, z = velocity.tolist()
    twist = Twist(linear=Vector3(x=x, y=y, z=z), angular=Vector3(x=0.0, y=0.0, z=turn_rate))
    return TwistStamped(header=header(time), twist=twist)
