"""The interface through which an algorithm under test uses topics and services."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol, TypeVar, runtime_checkable

import numpy as np

M = TypeVar("M")


@runtime_checkable
class Node(Protocol):
    """The interface that an algorithm under test uses: topics, services, timers, parameters."""

    @property
    def now(self) -> float:
        """The simulation time [s]."""

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The values of ``--set algorithm.name=value``; the algorithm has its own defaults."""

    @property
    def rng(self) -> np.random.Generator:
        """The random generator of the algorithm, which the seed of the run determines."""

    def subscribe(self, topic: str, type: type[M], callback: Callable[[M], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``."""

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service; ``type`` is the class of its request."""

    def call(self, name: str, request: object) -> object:
        """Call a service and return its response; raise UnknownName if it is not offered."""

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` of simulation time, from now on."""


class Algorithm(Protocol):
    """A program under test: it is started once; then only its callbacks are called."""

    def start(self, node: Node) -> None:
        """Subscribe, serve, create timers, call ``startBench``; then only callbacks are called."""
