"""Run an algorithm written for uwsim as a node of ROS 2, in lock-step: the same class, with rclpy.

    uwsim bench visibility --ros2 --client tracker            # in another terminal
    python examples/ros2/run_algorithm.py uwsim.algorithms:Esm --name tracker

The rows are those of ``--algorithm esm``, to the last bit. It needs rclpy and uwsim in one
environment, and the ROS packages of the messages. Services that the simulation calls (autoInit)
come by the topics of lock-step, so it does not matter which DDS the node uses; the algorithm
itself can call services of std_srvs/Empty (startBench), with its next answer.
"""

from __future__ import annotations

import argparse
import importlib
import random
import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from lockstep import LockStep, run

from uwsim.errors import BadSetting
from uwsim.messages import Empty, EmptyResponse
from uwsim.middleware.encodings import from_cdr, to_cdr
from uwsim.middleware.json_encoding import from_json, to_json
from uwsim.middleware.stamps import to_ros_time, to_sim_time
from uwsim.middleware.types import service_of, wire_type


class Node:
    """A `uwsim.bus.Node` outside: messages are CDR on their way."""

    def __init__(self, lockstep: LockStep, parameters: Mapping[str, float | str]) -> None:
        self._lockstep, self.parameters = lockstep, parameters
        self.rng = np.random.default_rng(0)

    @property
    def now(self) -> float:
        """Simulation time [s]."""
        return self._lockstep.now

    def subscribe(self, topic: str, type: type, callback: Callable[[Any], None]) -> None:
        """Have ``callback`` called with every message on ``topic``."""

        def receive(data: bytes) -> None:
            callback(to_sim_time(from_cdr(type, data)))

        self._lockstep.subscribe(_slashed(topic), _class_of_ros(type), receive, raw=True)

    def publisher(self, topic: str, type: type) -> Callable[[Any], None]:
        """Return ``publish(message)`` for ``topic``."""
        publish = self._lockstep.publisher(_slashed(topic), _class_of_ros(type))
        return lambda message: publish(bytes(to_cdr(to_ros_time(message))))

    def serve(self, name: str, type: type, handler: Callable[[Any], Any]) -> None:
        """Offer a service; ``type`` is the class of its request."""
        service = service_of(type)
        assert service is not None
        self._lockstep.serve(
            _slashed(name),
            service.name,
            lambda values: to_json(to_ros_time(handler(to_sim_time(from_json(type, values))))),
        )

    def call(self, name: str, request: Any) -> Any:
        """Have a service of std_srvs/Empty called with the next answer."""
        if not isinstance(request, Empty):
            raise BadSetting(f"{name}: in lock-step over ROS 2 only services of Empty are called.")
        self._lockstep.call(_slashed(name))
        return EmptyResponse()

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Have ``callback`` called every ``period_s`` of simulation time, from now on."""
        self._lockstep.every(period_s, callback)


def _slashed(name: str) -> str:
    return f"/{name.strip().lstrip('/')}"


def _class_of_ros(cls: type) -> type:
    """Return the class of rclpy for a message of uwsim."""
    wire = wire_type(cls)
    assert wire is not None
    package, _, name = wire.ros2_name.split("/")
    found: type = getattr(importlib.import_module(f"{package}.msg"), name)
    return found


def _pair(text: str) -> tuple[str, float | str]:
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        return name, value


def main() -> None:
    """Read the command line and take part in trial after trial, until none begins any more."""
    parser = argparse.ArgumentParser(description="An algorithm of uwsim as a node of ROS 2.")
    parser.add_argument("algorithm", help="module:Class, with a method start(node)")
    parser.add_argument("--name", required=True, help="that of --client")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", type=_pair)
    parser.add_argument("--patience", type=float, default=60.0, help="wait for a trial [s]")
    parser.add_argument("--delay", type=float, default=0.0, help="longest random delay [ms]")
    given = parser.parse_args()
    module, _, name = given.algorithm.partition(":")
    try:
        algorithm = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError, ValueError) as error:
        parser.error(f"{given.algorithm}: expected module:Class: {error}")

    def dawdle() -> None:
        time.sleep(random.uniform(0.0, given.delay / 1000.0))

    def start(lockstep: LockStep) -> None:
        lockstep.before_answer = dawdle
        algorithm().start(Node(lockstep, dict(given.set)))

    run(given.name, start, patience=given.patience)


if __name__ == "__main__":
    main()
