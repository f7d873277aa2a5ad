"""Run an algorithm written for uwsim as a node of ROS 2, in lock-step: the same class, with rclpy.

    uwsim bench visibility --ros2 --client tracker            # in another terminal
    python examples/ros2/run_algorithm.py uwsim.algorithms:Esm --name tracker

The rows are those of ``--algorithm esm``, to the last bit. It needs rclpy and uwsim in one
environment, and the ROS packages of the messages. Requests of services that the
simulation calls (autoInit) arrive on the topics of lock-step, so the node may use any DDS. The
algorithm can call services of std_srvs/Empty (startBench) with its next answer.
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
    """A `uwsim.bus.Node` over ROS 2, with messages in CDR."""

    def __init__(self, lockstep: LockStep, parameters: Mapping[str, float | str]) -> None:
        self._lockstep, self.parameters = lockstep, parameters
        self.rng = np.random.default_rng(0)

    @property
    def now(self) -> float:
        """The simulation time [s]."""
        return self._lockstep.now

    def subscribe(self, topic: str, type: type, callback: Callable[[Any], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""

        def receive(data: bytes) -> None:
            callback(to_sim_time(from_cdr(type, data)))

        self._lockstep.subscribe(_absolute_name(topic), _ros_class(type), receive, is_raw=True)

    def publisher(self, topic: str, type: type) -> Callable[[Any], None]:
        """Return ``publish(message)`` for ``topic``."""
        publish = self._lockstep.publisher(_absolute_name(topic), _ros_class(type))
        return lambda message: publish(bytes(to_cdr(to_ros_time(message))))

    def serve(self, name: str, type: type, handler: Callable[[Any], Any]) -> None:
        """Offer a service; ``type`` is the class of its request."""
        service = service_of(type)
        assert service is not None
        self._lockstep.serve(
            _absolute_name(name),
            service.name,
            lambda values: to_json(to_ros_time(handler(to_sim_time(from_json(type, values))))),
        )

    def call(self, name: str, request: Any) -> Any:
        """Call a service of std_srvs/Empty with the next answer."""
        if not isinstance(request, Empty):
            raise BadSetting(f"{name}: lock-step over ROS 2 calls services of std_srvs/Empty only.")
        self._lockstep.call(_absolute_name(name))
        return EmptyResponse()

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` of simulation time, from now on."""
        self._lockstep.create_timer(period_s, callback)


def _absolute_name(name: str) -> str:
    return f"/{name.strip().lstrip('/')}"


def _ros_class(cls: type) -> type:
    """Return the ROS 2 class of a message class of uwsim."""
    wire = wire_type(cls)
    assert wire is not None
    package, _, name = wire.ros2_name.split("/")
    ros_class: type = getattr(importlib.import_module(f"{package}.msg"), name)
    return ros_class


def _parse_pair(text: str) -> tuple[str, float | str]:
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        return name, value


def main() -> None:
    """Parse the command line, and take part in all trials."""
    parser = argparse.ArgumentParser(description="Run an algorithm of uwsim as a node of ROS 2.")
    parser.add_argument("algorithm", help="module:Class, with a method start(node)")
    parser.add_argument("--name", required=True, help="the name of --client")
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", type=_parse_pair
    )
    parser.add_argument("--patience", type=float, default=60.0, help="longest wait for a trial [s]")
    parser.add_argument("--delay", type=float, default=0.0, help="longest random delay [ms]")
    options = parser.parse_args()
    module, _, name = options.algorithm.partition(":")
    try:
        algorithm = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError, ValueError) as error:
        parser.error(f"{options.algorithm}: expected module:Class: {error}")

    def sleep_at_random() -> None:
        time.sleep(random.uniform(0.0, options.delay / 1000.0))

    def start(lockstep: LockStep) -> None:
        lockstep.before_answer = sleep_at_random
        algorithm().start(Node(lockstep, dict(options.set)))

    run(options.name, start, timeout=options.patience)


if __name__ == "__main__":
    main()
