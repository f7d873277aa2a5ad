"""Services of a node of rclpy: those it offers, and calls of others'.

Requests and responses are objects of rclpy on their way; they come from, and become, CDR bytes.
"""

from __future__ import annotations

import time
from collections.abc import Hashable
from concurrent.futures import Future
from typing import Any, cast

import rclpy.task
from rclpy.serialization import deserialize_message, serialize_message

from ...errors import BadMessage, UwsimError
from ..encodings import from_cdr, to_cdr
from ..log import Log
from ..stamps import to_ros_clock, to_simulation_time
from ..types import WireService, service_of, wire_service
from .node import Call, Endpoint
from .rclpy_endpoints import Nowhere, RclpyServer
from .rclpy_types import RclpyTypes

DISCOVERY_S = 10.0
"""How long a service that is called may take to be connected [s]."""
GLANCE_S = 0.005
"""How often it is looked whether it is [s]."""


class Unanswered(Exception):
    """A call of a service has no answer; rclpy has no other way to send none."""


class RclpyServices:
    """Services that a node offers and calls.

    Args:
        node: of rclpy.
        executor: that spins it.
        group: of callbacks that may wait.
        types: that rclpy has.
        log: where calls that have no answer are reported.
    """

    def __init__(self, node: Any, executor: Any, group: Any, types: RclpyTypes, log: Log) -> None:
        self._node, self._executor, self._group = node, executor, group
        self._types, self._log = types, log
        self._clients: dict[str, Any] = {}

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""
        found = self._types.service(kind, name)
        if found is None:
            return Nowhere()
        service = self._node.create_service(
            found, f"/{name}", self._answering(name, kind, found, call), callback_group=self._group
        )
        return RclpyServer(self._drop, service)

    def _answering(self, name: str, kind: WireService, found: Any, call: Call) -> Any:
        """Return what answers a request of rclpy once the simulation has."""

        async def answer(asked: Any, _: Any) -> Any:
            try:
                request: object = to_simulation_time(
                    from_cdr(kind.service.request, serialize_message(asked))
                )
                response = await self._answered(call(request))
            except UwsimError as error:
                self._log.report(f"service /{name}: no answer: {error}", kind=name)
                raise Unanswered from error
            return deserialize_message(bytes(to_cdr(to_ros_clock(response))), found.Response)

        return answer

    def _answered(self, response: Future[object]) -> Any:
        """Return what can be awaited in the node's thread for a response of the simulation."""
        waiting: Any = rclpy.task.Future()

        def pass_on(_: Future[object]) -> None:
            if response.exception() is None:
                waiting.set_result(response.result())
            else:
                waiting.set_exception(response.exception())
            self._executor.wake()

        response.add_done_callback(pass_on)
        return waiting

    def offers(self, name: str) -> bool:
        """Whether a service is offered on the graph, by this node or another."""
        return any(found == f"/{name}" for found, _ in self._node.get_service_names_and_types())

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node.

        Raises:
            UwsimError: rclpy has no such type, or nobody answers at the other end.
        """
        service = service_of(cast(Hashable, request.__class__))
        if service is None:
            raise UwsimError(f"Service /{name}: {type(request).__name__} has no definition.")
        kind = wire_service(service)
        client = self._client(name, kind)
        asked = deserialize_message(bytes(to_cdr(to_ros_clock(request))), client.srv_type.Request)
        future: Future[object] = Future()

        def pass_on(answered: Any) -> None:
            try:
                found = serialize_message(answered.result())
                future.set_result(to_simulation_time(from_cdr(kind.service.response, found)))
            except (BadMessage, RuntimeError) as error:
                future.set_exception(UwsimError(f"Service /{name}: {error}"))

        client.call_async(asked).add_done_callback(pass_on)
        return future

    def _client(self, name: str, kind: WireService) -> Any:
        if name not in self._clients:
            found = self._types.service(kind, name)
            if found is None:
                raise UwsimError(f"Service /{name}: rclpy has no type {kind.ros2_name}.")
            self._clients[name] = self._node.create_client(
                found, f"/{name}", callback_group=self._group
            )
        client = self._clients[name]
        end = time.monotonic() + DISCOVERY_S
        while not client.service_is_ready():
            if time.monotonic() > end:
                raise UwsimError(f"Service /{name}: not connected within {DISCOVERY_S:g} s.")
            time.sleep(GLANCE_S)
        return client

    def _drop(self, service: Any) -> None:
        self._executor.create_task(self._node.destroy_service, service)
