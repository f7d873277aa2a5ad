"""Checks of the arguments of calls to masters and nodes, with the answers of rosmaster."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .xmlrpc import Answer

NAME_PATTERN = re.compile(r"[~/A-Za-z][\w/]*")
"""The pattern of a legal name in a graph of ROS 1; it has no two slashes in a row."""
TYPE_PATTERN = re.compile(r"\*|[A-Za-z]\w*/[A-Za-z]\w*")
"""The pattern of a message type; ``*`` is any type."""
MAX_LENGTH = 1000
"""The maximum length of a name, type or address [characters]; ROS has no limit."""
ERROR_CODE, FAILURE_CODE = -1, 0
"""The codes of answers to an invalid call, and to a call that failed here."""
Check = Callable[[str, object], "str | None"]
"""A function that checks a parameter, by name and value, and returns the error or None."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a method, besides the name of the caller."""

    name: str
    """The name of the parameter in ROS."""
    check: Check
    """The check of its values."""
    is_optional: bool = False
    """True if the parameter, which is the last one, may be left out."""


@dataclass(frozen=True)
class Method:
    """The parameters of a remote method, and the value in its answer to an invalid call."""

    default_value: Any
    """The value in the answer to an invalid call."""
    parameters: tuple[Parameter, ...] = ()
    """The parameters of the method."""

    def find_error(self, arguments: tuple[Any, ...]) -> str | None:
        """Return the error in the arguments of a call, the caller first; None: they are valid."""
        if not arguments:
            return "missing required caller_id parameter"
        caller, *values = arguments
        if not isinstance(caller, str):
            return "caller_id must be a string"
        if (error := _length_error("caller_id", caller)) is not None:
            return error
        n_needed = sum(not spec.is_optional for spec in self.parameters)
        if not n_needed <= len(values) <= len(self.parameters):
            names = ", ".join(("caller_id", *(spec.name for spec in self.parameters)))
            return f"wrong number of arguments ({len(arguments)}); expected {names}"
        for parameter, value in zip(self.parameters, values, strict=False):
            if (error := parameter.check(parameter.name, value)) is not None:
                return error
        return None


def validate(method: Method, call: Callable[..., Answer]) -> Callable[..., Answer]:
    """Return a method that answers invalid and failed calls with a code and a text."""

    def answer(*arguments: Any) -> Answer:
        if (error := method.find_error(arguments)) is not None:
            return [ERROR_CODE, error, method.default_value]
        try:
            return call(*arguments)
        except Exception:  # the answer states the failure, but no details of this program
            return [FAILURE_CODE, "internal failure", method.default_value]

    return answer


def _length_error(name: str, text: str) -> str | None:
    return f"{name} has more than {MAX_LENGTH} characters" if len(text) > MAX_LENGTH else None


def _check_key(parameter: str, value: object) -> str | None:
    if not isinstance(value, str) or not value:
        return f"parameter [{parameter}] must be a non-empty string"
    return _length_error(f"parameter [{parameter}]", value)


def _check_name(parameter: str, value: object) -> str | None:
    if (error := _check_key(parameter, value)) is not None:
        return error
    assert isinstance(value, str)
    if not NAME_PATTERN.fullmatch(value) or "//" in value:
        return f"parameter [{parameter}] contains illegal chars"
    return None


def _check_resource_name(parameter: str, value: object) -> str | None:
    if value == "/":
        return f"parameter [{parameter}] cannot be the global namespace"
    return _check_name(parameter, value)


def _check_optional_name(parameter: str, value: object) -> str | None:
    return None if value == "" else _check_name(parameter, value)


def _check_type(parameter: str, value: object) -> str | None:
    if (error := _check_key(parameter, value)) is not None:
        return error
    assert isinstance(value, str)
    is_legal = TYPE_PATTERN.fullmatch(value)
    return None if is_legal else f"parameter [{parameter}] is not a valid package resource name"


def _check_uri(parameter: str, value: object) -> str | None:
    if not isinstance(value, str) or not value.startswith(("http://", "rosrpc://")):
        return f"parameter [{parameter}] is not an RPC URI"
    return _length_error(f"parameter [{parameter}]", value)


def _check_text(parameter: str, value: object) -> str | None:
    return None if isinstance(value, str) else f"parameter [{parameter}] must be a string"


def _check_list(parameter: str, value: object) -> str | None:
    return None if isinstance(value, list) else f"parameter [{parameter}] must be a list"


def _check_value(parameter: str, value: object) -> str | None:
    return f"parameter [{parameter}] must be specified" if value is None else None


TOPIC, SERVICE = (Parameter(name, _check_resource_name) for name in ("topic", "service"))
TYPE_OF_TOPIC = Parameter("topic_type", _check_type)
CALLER_URI, SERVICE_URI = (Parameter(name, _check_uri) for name in ("caller_api", "service_api"))
KEY = Parameter("key", _check_key)
MASTER_METHODS = {
    "registerPublisher": Method([], (TOPIC, TYPE_OF_TOPIC, CALLER_URI)),
    "unregisterPublisher": Method(0, (TOPIC, CALLER_URI)),
    "registerSubscriber": Method([], (TOPIC, TYPE_OF_TOPIC, CALLER_URI)),
    "unregisterSubscriber": Method(0, (TOPIC, CALLER_URI)),
    "registerService": Method(0, (SERVICE, SERVICE_URI, CALLER_URI)),
    "unregisterService": Method(0, (SERVICE, SERVICE_URI)),
    "lookupService": Method("", (SERVICE,)),
    "lookupNode": Method("", (Parameter("node", _check_name),)),
    "getPublishedTopics": Method([], (Parameter("subgraph", _check_optional_name),)),
    "getTopicTypes": Method([]),
    "getSystemState": Method([[], [], []]),
    "getUri": Method(""),
    "getPid": Method(-1),
}
"""The methods of a master."""
PARAMETER_METHODS = {
    "setParam": Method(0, (KEY, Parameter("value", _check_value))),
    "getParam": Method(0, (KEY,)),
    "deleteParam": Method(0, (KEY,)),
    "hasParam": Method(False, (KEY,)),
    "searchParam": Method(0, (KEY,)),
    "getParamNames": Method([]),
    "subscribeParam": Method(0, (CALLER_URI, KEY)),
    "unsubscribeParam": Method(0, (CALLER_URI, KEY)),
}
"""The methods of a master's parameter server."""
NODE_METHODS = {
    "publisherUpdate": Method(0, (TOPIC, Parameter("publishers", _check_list))),
    "requestTopic": Method([], (TOPIC, Parameter("protocols", _check_list))),
    "paramUpdate": Method(0, (KEY, Parameter("value", _check_value))),
    "getBusStats": Method([[], [], []]),
    "getBusInfo": Method([]),
    "getMasterUri": Method(""),
    "getPid": Method(-1),
    "getSubscriptions": Method([]),
    "getPublications": Method([]),
    "getArrived": Method({}),
    "shutdown": Method(0, (Parameter("msg", _check_text, is_optional=True),)),
}
"""The methods that every node of ROS 1 serves, and ``getArrived``, which only this node has."""
