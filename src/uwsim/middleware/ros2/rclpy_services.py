"""Services of a node on rclpy: those that it offers, and calls of services of other nodes.

Requests and responses are converted between CDR bytes and objects of rclpy.
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
from ..stamps import to_ros_time, to_sim_time
from ..types import WireService, service_of, wire_service
from .node import Call, Endpoint
from .rclpy_endpoints import NullEndpoint, RclpyServer
from .rclpy_types import RclpyTypes

DISCOVERY_S = 10.0
"""The time limit for connecting to a service [s]."""
CHECK_INTERVAL_S = 0.005
"""The interval of checks of the connection [s]."""


class NoAnswer(Exception):
    """The exception with which a handler sends no answer; rclpy has no other way."""


class RclpyServices:
    """The services that a node offers and calls.

    Args:
        node: the node of rclpy.
        executor: the executor of the node.
        group: the callback group of the services.
        types: the message and service types that rclpy has.
        log: the log for calls without an answer.
    """

    def __init__(self, node: Any, executor: Any, group: Any, types: RclpyTypes, log: Log) -> None:
        self._node, self._executor, self._group = node, executor, group
        self._types, self._log = types, log
        self._clients: dict[str, Any] = {}

    def server(self, name: str, kind: WireService, call: Call) -> Endpoint:
        """Offer a service."""
        cls = self._types.service(kind, name)
        if cls is None:
            return NullEndpoint()
        service = self._node.create_service(
            cls, f"/{name}", self._make_handler(name, kind, cls, call), callback_group=self._group
        )
        return RclpyServer(self._drop, service)

    def _make_handler(self, name: str, kind: WireService, cls: Any, call: Call) -> Any:
        """Return the coroutine function that answers a request of rclpy."""

        async def answer(message: Any, _: Any) -> Any:
            try:
                request: object = to_sim_time(
                    from_cdr(kind.service.request, serialize_message(message))
                )
                response = await self._make_awaitable(call(request))
            except UwsimError as error:
                self._log.report(f"service /{name}: no answer: {error}", kind=name)
                raise NoAnswer from error
            return deserialize_message(bytes(to_cdr(to_ros_time(response))), cls.Response)

        return answer

    def _make_awaitable(self, response: Future[object]) -> Any:
        """Return an awaitable, for the thread of the node, of a response of the simulation."""
        future: Any = rclpy.task.Future()

        def copy_result(_: Future[object]) -> None:
            if response.exception() is None:
                future.set_result(response.result())
            else:
                future.set_exception(response.exception())
            self._executor.wake()

        response.add_done_callback(copy_result)
        return future

    def offers(self, name: str) -> bool:
        """Return whether a service is offered on the graph, by this node or another."""
        return f"/{name}" in dict(self._node.get_service_names_and_types())

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of another node.

        Raises:
            UwsimError: rclpy has no such type, or the server does not answer.
        """
        service = service_of(cast(Hashable, request.__class__))
        if service is None:
            raise UwsimError(f"Service /{name}: {type(request).__name__} has no definition.")
        kind = wire_service(service)
        client = self._client(name, kind)
        message = deserialize_message(bytes(to_cdr(to_ros_time(request))), client.srv_type.Request)
        future: Future[object] = Future()

        def copy_result(rclpy_future: Any) -> None:
            try:
                data = serialize_message(rclpy_future.result())
                future.set_result(to_sim_time(from_cdr(kind.service.response, data)))
            except (BadMessage, RuntimeError) as error:
                future.set_exception(UwsimError(f"Service /{name}: {error}"))

        client.call_async(message).add_done_callback(copy_result)
        return future

    def _client(self, name: str, kind: WireService) -> Any:
        if name not in self._clients:
            cls = self._types.service(kind, name)
            if cls is None:
                raise UwsimError(f"Service /{name}: rclpy has no type {kind.ros2_name}.")
            self._clients[name] = self._node.create_client(
                cls, f"/{name}", callback_group=self._group
            )
        client = self._clients[name]
        end = time.monotonic() + DISCOVERY_S
        while not client.service_is_ready():
            if time.monotonic() > end:
                raise UwsimError(f"Service /{name}: not connected within {DISCOVERY_S:g} s.")
            time.sleep(CHECK_INTERVAL_S)
        return client

    def _drop(self, service: Any) -> None:
        self._executor.create_task(self._node.destroy_service, service)
