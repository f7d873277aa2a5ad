"""The parameter server of a master: a tree of values, by names with slashes."""

from __future__ import annotations

from typing import Any

MAX_BYTES = 16 * 2**20
"""The maximum size of all parameters together, approximately [bytes]."""
MAX_VALUES = 100_000
"""The maximum number of values, lists and dictionaries in all parameters."""
MAX_DEPTH = 50
"""The maximum depth of nested dictionaries and lists."""
MAX_SUBSCRIBERS = 10_000
"""The maximum number of subscriptions, one for each node and key."""
Updates = list[tuple[str, str, Any]]
"""The updates to send: the URI of the subscriber, the key, and the new value of each."""
Result = tuple[tuple[int, str, Any], Updates]
"""The answer of a method (code, text and value), and the updates to send."""


def resolve(name: str, caller: str) -> str:
    """Return a name of the graph in full, with a leading slash.

    A relative name is in the namespace of the node ``caller``; ``~x`` is a private name of it.
    """
    if name.startswith("~"):
        return f"{caller.rstrip('/')}/{name[1:].lstrip('/')}"
    if name.startswith("/"):
        return "/" + name.strip("/")
    namespace = caller.rpartition("/")[0]
    return f"{namespace}/{name}".rstrip("/") or "/"


def _path(key: str) -> list[str]:
    return [part for part in key.split("/") if part]


class Parameters:
    """The tree of parameters; each method returns the master's answer and the updates to send."""

    def __init__(self) -> None:
        self._tree: dict[str, Any] = {}
        self._n, self._n_bytes = 0, 0  # upper bounds of the number of values and of their size
        self._subscribers: dict[str, set[str]] = {}

    def set_param(self, caller: str, key: str, value: Any) -> Result:
        """Set a parameter; a dictionary sets a subtree."""
        name = resolve(key, caller)
        path = _path(name)
        if (error := self._limit_error(path, value)) is not None:
            return (-1, error, 0), []
        if not path:
            if not isinstance(value, dict):
                return (-1, "cannot set root to a value that is no dictionary", 0), []
            self._tree = value
        else:
            subtree = self._tree
            for part in path[:-1]:
                if not isinstance(subtree.get(part), dict):
                    subtree[part] = {}
                subtree = subtree[part]
            subtree[path[-1]] = value
        updates = [
            (uri, f"{subscribed_name.rstrip('/')}/", self._find(subscribed_name))
            for subscribed_name, uris in sorted(self._subscribers.items())
            if _is_inside(name, subscribed_name) or _is_inside(subscribed_name, name)
            for uri in sorted(uris)
        ]
        return (1, f"parameter {name} set", 0), updates

    def get_param(self, caller: str, key: str) -> Result:
        """Return a parameter, or a subtree."""
        name = resolve(key, caller)
        value = self._find(name)
        if value is None:
            return (-1, f"Parameter [{name}] is not set", 0), []
        return (1, f"Parameter [{name}]", value), []

    def delete_param(self, caller: str, key: str) -> Result:
        """Delete a parameter or a subtree."""
        name = resolve(key, caller)
        path = _path(name)
        subtree = self._find("/" + "/".join(path[:-1])) if path else None
        if not isinstance(subtree, dict) or path[-1] not in subtree:
            return (-1, f"parameter [{name}] is not set", 0), []
        del subtree[path[-1]]
        return (1, f"parameter {name} deleted", 0), []

    def has_param(self, caller: str, key: str) -> Result:
        """Return whether a parameter is set."""
        name = resolve(key, caller)
        return (1, name, self._find(name) is not None), []

    def search_param(self, caller: str, key: str) -> Result:
        """Find a parameter in the namespaces of the caller, innermost first."""
        first_part = (_path(key) or [""])[0]
        parts = _path(caller)
        for n in range(len(parts), -1, -1):
            namespace = "/" + "/".join(parts[:n])
            if self._find(f"{namespace}/{first_part}") is not None:
                return (1, "Found", resolve(key, f"{namespace.rstrip('/')}/x")), []
        return (-1, f"Cannot find parameter [{key}]", ""), []

    def get_param_names(self, caller: str) -> Result:
        """Return the names of all parameters."""
        return (1, "Parameter names", sorted(_leaf_names(self._tree, ""))), []

    def subscribe_param(self, caller: str, uri: str, key: str) -> Result:
        """Subscribe a node to changes of a parameter; return its value, ``{}`` if it is not set."""
        name = resolve(key, caller)
        if sum(map(len, self._subscribers.values())) >= MAX_SUBSCRIBERS:
            return (-1, f"at most {MAX_SUBSCRIBERS} subscribers are kept", 0), []
        self._subscribers.setdefault(name, set()).add(uri)
        value = self._find(name)
        return (1, f"Subscribed to parameter [{name}]", {} if value is None else value), []

    def unsubscribe_param(self, caller: str, uri: str, key: str) -> Result:
        """Unsubscribe a node."""
        name = resolve(key, caller)
        uris = self._subscribers.get(name, set())
        n = int(uri in uris)
        uris.discard(uri)
        if not uris:
            self._subscribers.pop(name, None)
        return (1, "Unsubscribed", n), []

    def _limit_error(self, path: list[str], value: Any) -> str | None:
        """Return the error if all parameters would exceed a limit with a new value; else None."""
        depth, n, n_bytes = measure_value(value)
        old_value = self._find("/" + "/".join(path))
        if old_value is None:
            n, n_bytes = n + len(path), n_bytes + sum(map(len, path))
        if len(path) + depth > MAX_DEPTH:
            return f"at most {MAX_DEPTH} namespaces are kept inside each other"
        if self._n + n > MAX_VALUES or self._n_bytes + n_bytes > MAX_BYTES:
            _, self._n, self._n_bytes = measure_value(self._tree)
            _, n_old, n_old_bytes = measure_value(old_value)
            n, n_bytes = n - n_old, n_bytes - n_old_bytes
        if self._n + n > MAX_VALUES:
            return f"at most {MAX_VALUES} parameters are kept"
        if self._n_bytes + n_bytes > MAX_BYTES:
            return f"all parameters together have at most {MAX_BYTES} bytes"
        self._n, self._n_bytes = self._n + n, self._n_bytes + n_bytes
        return None

    def _find(self, name: str) -> Any:
        value: Any = self._tree
        for part in _path(name):
            if not isinstance(value, dict) or part not in value:
                return None
            value = value[part]
        return value


def measure_value(value: Any) -> tuple[int, int, int]:
    """Return the depth of a value, the number of values in it, and their approximate bytes."""
    max_depth, n, n_bytes = 0, 0, 0
    pending_parts = [(value, 0)]
    while pending_parts:
        part, depth = pending_parts.pop()
        max_depth, n = max(max_depth, depth), n + 1
        if isinstance(part, dict):
            n_bytes += sum(len(str(key)) for key in part)
            pending_parts += [(child, depth + 1) for child in part.values()]
        elif isinstance(part, list | tuple):
            pending_parts += [(child, depth + 1) for child in part]
        else:
            n_bytes += len(part) if isinstance(part, str | bytes) else _size_of(part)
    return max_depth, n, n_bytes


def _size_of(value: Any) -> int:
    data = getattr(value, "data", b"")  # of xmlrpc.client.Binary
    return 8 + (len(data) if isinstance(data, bytes | str) else 0)


def _is_inside(name: str, namespace: str) -> bool:
    return f"{name.rstrip('/')}/".startswith(f"{namespace.rstrip('/')}/")


def _leaf_names(tree: dict[str, Any], prefix: str) -> list[str]:
    names = []
    for key, value in tree.items():
        name = f"{prefix}/{key}"
        names += _leaf_names(value, name) if isinstance(value, dict) and value else [name]
    return names
