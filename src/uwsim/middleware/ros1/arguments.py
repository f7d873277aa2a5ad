"""Checks of what masters and nodes are called with; a wrong call is answered, as by rosmaster."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .xmlrpc import Answer

NAME = re.compile(r"[~/A-Za-z][\w/]*")
"""A legal name in a graph of ROS 1; it has no two slashes in a row."""
TYPE = re.compile(r"\*|[A-Za-z]\w*/[A-Za-z]\w*")
"""A message type, or any."""
MAX_TEXT = 1000
"""Longest name, type or address [characters]; ROS has no limit."""
ERROR, FAILURE = -1, 0
"""Codes of answers: the caller is wrong; the call failed."""
Check = Callable[[str, object], "str | None"]
"""Says what is wrong with the value of a parameter, by its name; None: nothing."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a method, besides the name of the caller."""

    name: str
    """As ROS calls it."""
    check: Check
    """What its values are."""
    is_optional: bool = False
    """Whether it may be left out; the last one."""


@dataclass(frozen=True)
class Method:
    """What a method takes, and what the value of its answer is where a call is wrong."""

    nothing: Any
    """That value."""
    parameters: tuple[Parameter, ...] = ()
    """Of the method."""

    def wrong(self, arguments: tuple[Any, ...]) -> str | None:
        """Say what is wrong with the arguments of a call, the caller first; None: nothing."""
        if not arguments:
            return "missing required caller_id parameter"
        caller, *given = arguments
        if not isinstance(caller, str):
            return "caller_id must be a string"
        if (wrong := _too_long("caller_id", caller)) is not None:
            return wrong
        n_needed = sum(not each.is_optional for each in self.parameters)
        if not n_needed <= len(given) <= len(self.parameters):
            names = ", ".join(("caller_id", *(each.name for each in self.parameters)))
            return f"wrong number of arguments ({len(arguments)}); expected {names}"
        for parameter, value in zip(self.parameters, given, strict=False):
            if (wrong := parameter.check(parameter.name, value)) is not None:
                return wrong
        return None


def checked(method: Method, call: Callable[..., Answer]) -> Callable[..., Answer]:
    """Return a method that answers wrong calls, and those that fail, with a code and a text."""

    def answer(*arguments: Any) -> Answer:
        if (wrong := method.wrong(arguments)) is not None:
            return [ERROR, wrong, method.nothing]
        try:
            return call(*arguments)
        except Exception:  # the peer is told that it failed, not how this program is made
            return [FAILURE, "internal failure", method.nothing]

    return answer


def _too_long(what: str, text: str) -> str | None:
    return f"{what} has more than {MAX_TEXT} characters" if len(text) > MAX_TEXT else None


def _is_key(parameter: str, value: object) -> str | None:
    if not isinstance(value, str) or not value:
        return f"parameter [{parameter}] must be a non-empty string"
    return _too_long(f"parameter [{parameter}]", value)


def _is_name(parameter: str, value: object) -> str | None:
    if (wrong := _is_key(parameter, value)) is not None:
        return wrong
    assert isinstance(value, str)
    if not NAME.fullmatch(value) or "//" in value:
        return f"parameter [{parameter}] contains illegal chars"
    return None


def _is_name_of_something(parameter: str, value: object) -> str | None:
    if value == "/":
        return f"parameter [{parameter}] cannot be the global namespace"
    return _is_name(parameter, value)


def _is_name_or_empty(parameter: str, value: object) -> str | None:
    return None if value == "" else _is_name(parameter, value)


def _is_type(parameter: str, value: object) -> str | None:
    if (wrong := _is_key(parameter, value)) is not None:
        return wrong
    assert isinstance(value, str)
    is_legal = TYPE.fullmatch(value)
    return None if is_legal else f"parameter [{parameter}] is not a valid package resource name"


def _is_uri(parameter: str, value: object) -> str | None:
    if not isinstance(value, str) or not value.startswith(("http://", "rosrpc://")):
        return f"parameter [{parameter}] is not an RPC URI"
    return _too_long(f"parameter [{parameter}]", value)


def _is_text(parameter: str, value: object) -> str | None:
    return None if isinstance(value, str) else f"parameter [{parameter}] must be a string"


def _is_list(parameter: str, value: object) -> str | None:
    return None if isinstance(value, list) else f"parameter [{parameter}] must be a list"


def _is_given(parameter: str, value: object) -> str | None:
    return f"parameter [{parameter}] must be specified" if value is None else None


TOPIC, SERVICE = (Parameter(name, _is_name_of_something) for name in ("topic", "service"))
TYPE_OF_TOPIC = Parameter("topic_type", _is_type)
CALLER_URI, SERVICE_URI = (Parameter(name, _is_uri) for name in ("caller_api", "service_api"))
KEY = Parameter("key", _is_key)
MASTER_METHODS = {
    "registerPublisher": Method([], (TOPIC, TYPE_OF_TOPIC, CALLER_URI)),
    "unregisterPublisher": Method(0, (TOPIC, CALLER_URI)),
    "registerSubscriber": Method([], (TOPIC, TYPE_OF_TOPIC, CALLER_URI)),
    "unregisterSubscriber": Method(0, (TOPIC, CALLER_URI)),
    "registerService": Method(0, (SERVICE, SERVICE_URI, CALLER_URI)),
    "unregisterService": Method(0, (SERVICE, SERVICE_URI)),
    "lookupService": Method("", (SERVICE,)),
    "lookupNode": Method("", (Parameter("node", _is_name),)),
    "getPublishedTopics": Method([], (Parameter("subgraph", _is_name_or_empty),)),
    "getTopicTypes": Method([]),
    "getSystemState": Method([[], [], []]),
    "getUri": Method(""),
    "getPid": Method(-1),
}
"""Methods of a master."""
PARAMETER_METHODS = {
    "setParam": Method(0, (KEY, Parameter("value", _is_given))),
    "getParam": Method(0, (KEY,)),
    "deleteParam": Method(0, (KEY,)),
    "hasParam": Method(False, (KEY,)),
    "searchParam": Method(0, (KEY,)),
    "getParamNames": Method([]),
    "subscribeParam": Method(0, (CALLER_URI, KEY)),
    "unsubscribeParam": Method(0, (CALLER_URI, KEY)),
}
"""Those of its parameters."""
NODE_METHODS = {
    "publisherUpdate": Method(0, (TOPIC, Parameter("publishers", _is_list))),
    "requestTopic": Method([], (TOPIC, Parameter("protocols", _is_list))),
    "paramUpdate": Method(0, (KEY, Parameter("value", _is_given))),
    "getBusStats": Method([[], [], []]),
    "getBusInfo": Method([]),
    "getMasterUri": Method(""),
    "getPid": Method(-1),
    "getSubscriptions": Method([]),
    "getPublications": Method([]),
    "getArrived": Method({}),
    "shutdown": Method(0, (Parameter("msg", _is_text, is_optional=True),)),
}
"""Methods that every node of ROS 1 serves, and one more."""
