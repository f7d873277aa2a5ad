"""A node for a part of an algorithm, with parameters of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

import numpy as np

from ...bus import Node

M = TypeVar("M")


class NodeView:
    """A `uwsim.bus.Node` that delegates to another node but has its own parameters."""

    def __init__(self, node: Node, parameters: Mapping[str, float | str]) -> None:
        self._node, self._parameters = node, dict(parameters)

    @property
    def now(self) -> float:
        """The simulation time [s]."""
        return self._node.now

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters of the part of the algorithm."""
        return self._parameters

    @property
    def rng(self) -> np.random.Generator:
        """The random generator of the whole algorithm."""
        return self._node.rng

    def subscribe(self, topic: str, type: type[M], callback: Callable[[M], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""
        self._node.subscribe(topic, type, callback)

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``."""
        return self._node.publisher(topic, type)

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service."""
        self._node.serve(name, type, handler)

    def call(self, name: str, request: object) -> object:
        """Call a service."""
        return self._node.call(name, request)

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` [s] of simulation time."""
        self._node.create_timer(period_s, callback)
