"""Run an algorithm written for uwsim in its own process: the same class, over WebSocket.

    uwsim bench visibility --client tracker --web 9090        # in another terminal
    python examples/websocket/run_algorithm.py uwsim.algorithms:Esm --name tracker

The rows are those of ``--algorithm esm``, to the last bit. Each trial has its own connection
and a new object of the class.
"""

from __future__ import annotations

import argparse
import importlib
import random
import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from lockstep import Client, open_connection

from uwsim.errors import UnknownName
from uwsim.middleware.json_encoding import from_json, to_json
from uwsim.middleware.stamps import to_ros_time, to_sim_time
from uwsim.middleware.types import service_of, wire_type


class Node:
    """A `uwsim.bus.Node` over WebSocket, with messages as JSON."""

    def __init__(self, client: Client, parameters: Mapping[str, float | str]) -> None:
        self._client, self.parameters = client, parameters
        self.rng = np.random.default_rng(0)

    @property
    def now(self) -> float:
        """The simulation time [s]."""
        return self._client.now

    def subscribe(self, topic: str, type: type, callback: Callable[[Any], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""
        self._client.subscribe(
            _absolute_name(topic), lambda values: callback(to_sim_time(from_json(type, values)))
        )

    def publisher(self, topic: str, type: type) -> Callable[[Any], None]:
        """Return ``publish(message)`` for ``topic``."""
        publish = self._client.publisher(_absolute_name(topic), _ros2_name(type))
        return lambda message: publish(to_json(to_ros_time(message)))

    def serve(self, name: str, type: type, handler: Callable[[Any], Any]) -> None:
        """Offer a service; ``type`` is the class of its request."""
        service = service_of(type)
        assert service is not None
        self._client.serve(
            _absolute_name(name),
            service.name,
            lambda values: to_json(to_ros_time(handler(to_sim_time(from_json(type, values))))),
        )

    def call(self, name: str, request: Any) -> Any:
        """Call a service and return its response; UnknownName if it is not offered."""
        service = service_of(type(request))
        assert service is not None
        try:
            values = self._client.call(_absolute_name(name), to_json(to_ros_time(request)))
        except LookupError as error:
            raise UnknownName("service", name, []) from error
        return to_sim_time(from_json(service.response, values))

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` of simulation time, from now on."""
        self._client.create_timer(period_s, callback)


def _absolute_name(name: str) -> str:
    return f"/{name.strip().lstrip('/')}"


def _ros2_name(cls: type) -> str:
    wire = wire_type(cls)
    assert wire is not None
    return wire.ros2_name


def _parse_pair(text: str) -> tuple[str, float | str]:
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        return name, value


def main() -> None:
    """Parse the command line, and take part until the last trial is over."""
    parser = argparse.ArgumentParser(description="Run an algorithm of uwsim in its own process.")
    parser.add_argument("algorithm", help="module:Class, with a method start(node)")
    parser.add_argument("--name", required=True, help="the name of --client")
    parser.add_argument("--uri", default="ws://127.0.0.1:9090")
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", type=_parse_pair
    )
    parser.add_argument("--trials", type=int, default=1, help="number of trials [1]")
    parser.add_argument("--delay", type=float, default=0.0, help="longest random delay [ms]")
    options = parser.parse_args()
    module, _, name = options.algorithm.partition(":")
    try:
        algorithm = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError, ValueError) as error:
        parser.error(f"{options.algorithm}: expected module:Class: {error}")

    def sleep_at_random() -> None:
        time.sleep(random.uniform(0.0, options.delay / 1000.0))

    for _ in range(options.trials):
        with open_connection(options.uri) as socket:
            client = Client(socket, options.name, sleep_at_random)
            algorithm().start(Node(client, dict(options.set)))
            client.run()


if __name__ == "__main__":
    main()
