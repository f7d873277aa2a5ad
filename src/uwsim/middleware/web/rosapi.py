"""The services of ``rosapi`` that clients of rosbridge ask what there is with."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..stamps import clock_time

if TYPE_CHECKING:
    from .server import WebBridge

NODE = "/uwsim"


def _topics(bridge: WebBridge, args: Any) -> dict[str, Any]:
    types = bridge.types()
    return {"topics": [f"/{name}" for name in types], "types": list(types.values())}


def _topic_type(bridge: WebBridge, args: Any) -> dict[str, Any]:
    return {"type": bridge.types().get(_text(args, "topic").lstrip("/"), "")}


def _topics_for_type(bridge: WebBridge, args: Any) -> dict[str, Any]:
    wanted = _text(args, "type")
    return {"topics": [f"/{name}" for name, type in bridge.types().items() if type == wanted]}


def _services(bridge: WebBridge, args: Any) -> dict[str, Any]:
    return {"services": [f"/{name}" for name in (*sorted(bridge.services), *sorted(SERVICES))]}


def _service_type(bridge: WebBridge, args: Any) -> dict[str, Any]:
    found = bridge.services.get(_text(args, "service").lstrip("/"))
    return {"type": found.name if found else ""}


def _nodes(bridge: WebBridge, args: Any) -> dict[str, Any]:
    return {"nodes": [NODE]}


def _time(bridge: WebBridge, args: Any) -> dict[str, Any]:
    now = clock_time(bridge.clock())
    return {"time": {"sec": now.sec, "nanosec": now.nanosec}}


def _text(args: Any, key: str) -> str:
    if isinstance(args, list):
        args = {key: args[0]} if args else {}
    return str(args.get(key, "")) if isinstance(args, dict) else ""


SERVICES: dict[str, Callable[[Any, Any], dict[str, Any]]] = {
    "rosapi/get_time": _time,
    "rosapi/nodes": _nodes,
    "rosapi/service_type": _service_type,
    "rosapi/services": _services,
    "rosapi/topic_type": _topic_type,
    "rosapi/topics": _topics,
    "rosapi/topics_for_type": _topics_for_type,
}
"""Name -> what answers, with the bridge and the arguments."""
