"""Run an algorithm written for uwsim as a node of ROS 1: the same class, with rospy, in lock-step.

    uwsim bench currents --ros1 --client station &
    python examples/ros1/run_algorithm.py uwsim.algorithms:P --name station

The rows are those of ``--algorithm p``, to the last bit. The Python of uwsim must have the
version of Debian's rospy (3.11). Messages pass through rospy as bytes.
"""

import argparse
import importlib
import random
import sys
import time

sys.path.append(
    "/usr/lib/python3/dist-packages"
)  # rospy; packages of this environment take precedence

import genpy
import numpy as np
import rospy
from lockstep import LockStep, run

from uwsim.errors import UnknownName
from uwsim.middleware.encodings import from_ros1, to_ros1
from uwsim.middleware.stamps import to_ros_time, to_sim_time
from uwsim.middleware.types import service_of, wire_service, wire_type

SERVICE_TIMEOUT = 10.0
"""The longest wait for a service [s]."""


class SerializedMessage(genpy.Message):
    """A message of any type, as its bytes."""

    __slots__ = ("data",)

    def __init__(self, data=b"") -> None:
        self.data = data

    def serialize(self, buff) -> None:
        """Write the bytes."""
        buff.write(self.data)

    def deserialize(self, data):
        """Store the bytes."""
        self.data = bytes(data)
        return self


def make_message_class(kind: type) -> type:
    """Return a rospy class for a message class of the bus."""
    wire = wire_type(kind)
    names = {"_type": wire.ros1_name, "_md5sum": wire.md5, "_full_text": wire.ros1_definition}
    return type("Raw" + kind.__name__, (SerializedMessage,), {"__slots__": (), **names})


def make_service_class(request: type) -> type:
    """Return a rospy service class for the class of a request."""
    service = wire_service(service_of(request))
    return type(
        "RawService",
        (),
        {
            "_type": service.ros1_name,
            "_md5sum": service.md5,
            "_request_class": make_message_class(service.service.request),
            "_response_class": make_message_class(service.service.response),
        },
    )


class Node:
    """A `uwsim.bus.Node` over ROS 1."""

    def __init__(self, lockstep: LockStep, parameters: dict) -> None:
        self._lockstep, self.parameters = lockstep, parameters
        self.rng = np.random.default_rng(0)

    @property
    def now(self) -> float:
        """The simulation time [s]."""
        return self._lockstep.now

    def subscribe(self, topic: str, kind: type, callback) -> None:
        """Call ``callback`` with every message on ``topic``."""
        self._lockstep.subscribe(
            absolute_name(topic),
            make_message_class(kind),
            lambda message: callback(to_sim_time(from_ros1(kind, message.data))),
        )

    def publisher(self, topic: str, kind: type):
        """Return ``publish(message)`` for ``topic``."""
        message_class = make_message_class(kind)
        publish = self._lockstep.publisher(absolute_name(topic), message_class)
        return lambda message: publish(message_class(bytes(to_ros1(to_ros_time(message)))))

    def serve(self, name: str, kind: type, handler) -> None:
        """Offer a service; ``kind`` is the class of its request."""
        service = make_service_class(kind)

        def answer(request: SerializedMessage) -> SerializedMessage:
            response = handler(to_sim_time(from_ros1(kind, request.data)))
            return service._response_class(bytes(to_ros1(to_ros_time(response))))

        self._lockstep.serve(absolute_name(name), service, answer)

    def call(self, name: str, request: object) -> object:
        """Call a service and return its response; UnknownName if it is not offered."""
        service = make_service_class(type(request))
        try:
            rospy.wait_for_service(absolute_name(name), timeout=SERVICE_TIMEOUT)
            proxy = rospy.ServiceProxy(absolute_name(name), service)
            response = proxy(service._request_class(bytes(to_ros1(to_ros_time(request)))))
        except rospy.ROSException as error:
            raise UnknownName("service", name, []) from error
        return to_sim_time(from_ros1(service_of(type(request)).response, response.data))

    def create_timer(self, period_s: float, callback) -> None:
        """Call ``callback`` every ``period_s`` of simulation time, from now on."""
        self._lockstep.create_timer(period_s, callback)


def absolute_name(name: str) -> str:
    """Return a name with a leading slash."""
    return "/" + name.strip().lstrip("/")


def parse_pair(text: str):
    """Parse ``NAME=VALUE`` as a name, and a number or a text."""
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        return name, value


def main() -> None:
    parser = argparse.ArgumentParser(description="Run an algorithm of uwsim as a node of ROS 1.")
    parser.add_argument("algorithm", help="module:Class, with a method start(node)")
    parser.add_argument("--name", required=True, help="the name of --client")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", type=parse_pair)
    parser.add_argument("--trials", type=int, default=1, help="number of trials [1]")
    parser.add_argument("--delay", type=float, default=0.0, help="longest random delay [ms]")
    options = parser.parse_args()
    module, _, name = options.algorithm.partition(":")
    try:
        algorithm = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError, ValueError) as error:
        parser.error(f"{options.algorithm}: expected module:Class: {error}")
    run(
        options.name,
        lambda lockstep: algorithm().start(Node(lockstep, dict(options.set))),
        lambda: time.sleep(random.uniform(0.0, options.delay / 1000.0)),
        options.trials,
    )


if __name__ == "__main__":
    main()
