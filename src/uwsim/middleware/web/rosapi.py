"""The services of ``rosapi``, with which clients of rosbridge list topics, services and types.

Requests may name types as in ROS 1 or ROS 2; answers name them as in ROS 2. The simulation is one
node, `NODE`; the publications and subscriptions of a client are listed under the client's name.
There are no parameters: requests for parameters are answered as if none was set.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rosbags.interfaces import Nodetype

from ...errors import BadMessage, UnknownName, UwsimError
from ..stamps import clock_time
from ..types import PLACEHOLDER, full_name, message_class, ros2_store, service, wire_type
from .graph import WebGraph

NODE = "/uwsim"
"""The name of the simulation's node."""
ROSOUT = "rosout"
"""The topic whose type makes viewers recognize ROS 2."""
ROSOUT_TYPE = "rcl_interfaces/msg/Log"
"""The type of this topic in ROS 2."""


def _topic_types(graph: WebGraph) -> dict[str, str]:
    return {ROSOUT: ROSOUT_TYPE, **graph.types()}


def _topics(graph: WebGraph, args: Any) -> dict[str, Any]:
    types = _topic_types(graph)
    return {"topics": [f"/{name}" for name in types], "types": list(types.values())}


def _topics_and_raw_types(graph: WebGraph, args: Any) -> dict[str, Any]:
    answer = _topics(graph, args)
    wires = [wire_type(message_class(name)) for name in answer["types"]]
    texts = [wire.ros2_definition if wire else "" for wire in wires]
    return {**answer, "typedefs_full_text": texts}


def _topic_type(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"type": _topic_types(graph).get(_name(args, "topic"), "")}


def _topics_for_type(graph: WebGraph, args: Any) -> dict[str, Any]:
    type_name = full_name(_text(args, "type"))
    types = _topic_types(graph).items()
    return {"topics": [f"/{name}" for name, type in types if type == type_name]}


def _services(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"services": [f"/{name}" for name in (*sorted(graph.services), *sorted(SERVICES))]}


def _service_type(graph: WebGraph, args: Any) -> dict[str, Any]:
    service_type = graph.services.get(_name(args, "service"))
    return {"type": service_type.name if service_type else ""}


def _services_for_type(graph: WebGraph, args: Any) -> dict[str, Any]:
    requested_kind = None
    with suppress(UnknownName):
        requested_kind = service(_text(args, "type"))
    names = sorted(name for name, kind in graph.services.items() if kind is requested_kind)
    return {"services": [f"/{name}" for name in names]}


def _service_node(graph: WebGraph, args: Any) -> dict[str, Any]:
    name = _name(args, "service")
    return {"node": NODE if name in graph.services or name in SERVICES else ""}


def _service_providers(graph: WebGraph, args: Any) -> dict[str, Any]:
    node = _service_node(graph, args)["node"]
    return {"providers": [node] if node else []}


def _service_host(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"host": "localhost" if _service_node(graph, args)["node"] else ""}


def _publishers(graph: WebGraph, args: Any) -> dict[str, Any]:
    name = _name(args, "topic")
    nodes = [NODE] if graph.is_published(name) or name == ROSOUT else []
    return {"publishers": [*nodes, *graph.clients_publishing(name)]}


def _subscribers(graph: WebGraph, args: Any) -> dict[str, Any]:
    name = _name(args, "topic")
    nodes = [NODE] if graph.is_subscribed(name) else []
    return {"subscribers": [*nodes, *graph.clients_reading(name)]}


def _nodes(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"nodes": [NODE]}


def _node_details(graph: WebGraph, args: Any) -> dict[str, Any]:
    if _text(args, "node").strip("/") != NODE.strip("/"):
        return {"subscribing": [], "publishing": [], "services": []}
    names = graph.types()
    return {
        "subscribing": [f"/{name}" for name in names if graph.is_subscribed(name)],
        "publishing": [f"/{ROSOUT}", *(f"/{n}" for n in names if graph.is_published(n))],
        "services": _services(graph, args)["services"],
    }


def _message_details(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"typedefs": typedefs(full_name(_text(args, "type")))}


def _service_details(half: str) -> Callable[[WebGraph, Any], dict[str, Any]]:
    def answer(graph: WebGraph, args: Any) -> dict[str, Any]:
        return {"typedefs": typedefs(f"{service(_text(args, 'type')).name}_{half}")}

    return answer


def _time(graph: WebGraph, args: Any) -> dict[str, Any]:
    now = clock_time(graph.clock())
    return {"time": {"sec": now.sec, "nanosec": now.nanosec}}


def _version(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"version": 2, "distro": "jazzy"}


def _no_parameters(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"names": []}


def _no_parameter(graph: WebGraph, args: Any) -> dict[str, Any]:
    default = args.get("default", "") if isinstance(args, dict) else ""
    return {"value": str(default)}


def _has_no_parameter(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"exists": False}


def _refuse_parameter(graph: WebGraph, args: Any) -> dict[str, Any]:
    raise BadMessage("The simulation has no parameters; --set changes values of a scene.")


def _no_action_servers(graph: WebGraph, args: Any) -> dict[str, Any]:
    return {"action_servers": []}


def typedefs(name: str) -> list[dict[str, Any]]:
    """Return the definitions of a type and of all types of its fields, the type itself first.

    Raises:
        BadMessage: there is no such type.
    """
    definitions = ros2_store().fielddefs
    if name not in definitions:
        raise BadMessage(f"There is no message type {name!r:.100}.")
    definitions_by_name: dict[str, dict[str, Any]] = {}
    type_names = [name]
    while type_names:
        current = type_names.pop(0)
        if current in definitions_by_name:
            continue
        constants, members = definitions[current]
        fields = [_field(*member) for member in members if member[0] != PLACEHOLDER]
        definitions_by_name[current] = {
            "type": current,
            "fieldnames": [field for field, _, _ in fields],
            "fieldtypes": [type for _, type, _ in fields],
            "fieldarraylen": [length for _, _, length in fields],
            "examples": ["[]" if n >= 0 else _example(type) for _, type, n in fields],
            "constnames": [constant for constant, _, _ in constants],
            "constvalues": [str(value) for _, _, value in constants],
        }
        type_names += [type for _, type, _ in fields if type in definitions]
    return list(definitions_by_name.values())


def _field(name: str, description: Any) -> tuple[str, str, int]:
    """Return name, type and array length of a field: 0 is any length, -1 is no array."""
    node, content = description
    length = -1
    if node in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        length = int(content[1]) if node == Nodetype.ARRAY else 0
        node, content = content[0]
    return name, str(content) if node == Nodetype.NAME else str(content[0]), length


def _example(type: str) -> str:
    """Return an example of a value of a type as text, in the form of rosapi."""
    if "/" in type:
        return "{}"
    if type in ("string", "wstring"):
        return ""
    return "False" if type == "bool" else "0.0" if type.startswith("float") else "0"


def _text(args: Any, key: str) -> str:
    if isinstance(args, list):
        args = {key: args[0]} if args else {}
    return str(args.get(key, "")) if isinstance(args, dict) else ""


def _name(args: Any, key: str) -> str:
    return _text(args, key).strip().lstrip("/")


def answer(graph: WebGraph, name: str, args: Any) -> tuple[bool, Any]:
    """Answer a request of `SERVICES`: return True and the values, or False and the reason."""
    try:
        return True, SERVICES[name](graph, args)
    except UwsimError as error:
        return False, str(error)


SERVICES: dict[str, Callable[[Any, Any], dict[str, Any]]] = {
    "rosapi/action_servers": _no_action_servers,
    "rosapi/get_param": _no_parameter,
    "rosapi/get_param_names": _no_parameters,
    "rosapi/get_ros_version": _version,
    "rosapi/get_time": _time,
    "rosapi/has_param": _has_no_parameter,
    "rosapi/message_details": _message_details,
    "rosapi/node_details": _node_details,
    "rosapi/nodes": _nodes,
    "rosapi/publishers": _publishers,
    "rosapi/service_host": _service_host,
    "rosapi/service_node": _service_node,
    "rosapi/service_providers": _service_providers,
    "rosapi/service_request_details": _service_details("Request"),
    "rosapi/service_response_details": _service_details("Response"),
    "rosapi/service_type": _service_type,
    "rosapi/services": _services,
    "rosapi/services_for_type": _services_for_type,
    "rosapi/set_param": _refuse_parameter,
    "rosapi/subscribers": _subscribers,
    "rosapi/topic_type": _topic_type,
    "rosapi/topics": _topics,
    "rosapi/topics_and_raw_types": _topics_and_raw_types,
    "rosapi/topics_for_type": _topics_for_type,
}
"""The functions that answer requests, given the graph and the arguments, by service name."""
