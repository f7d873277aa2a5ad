"""The parameter server of a master: a tree of values, by names with slashes."""

from __future__ import annotations

from typing import Any

MAX_BYTES = 16 * 2**20
"""What all parameters together may take, about [bytes]."""
MAX_VALUES = 100_000
"""Values, lists and dictionaries in them."""
MAX_DEPTH = 50
"""Dictionaries and lists inside each other."""
MAX_SUBSCRIBERS = 10_000
"""Nodes that are told of changes, one for each key."""
Changed = list[tuple[str, str, Any]]
"""Subscriber's URI, key, new value."""
Result = tuple[tuple[int, str, Any], Changed]


def resolve(name: str, caller: str) -> str:
    """Return a name of the graph with a leading slash.

    A relative one is in the namespace of the node ``caller``, ``~x`` is its own.
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
    """Parameters; each method returns what the master answers, and whom to tell what."""

    def __init__(self) -> None:
        self._tree: dict[str, Any] = {}
        self._n, self._n_bytes = 0, 0  # at most so many values and bytes are kept
        self._subscribers: dict[str, set[str]] = {}

    def set_param(self, caller: str, key: str, value: Any) -> Result:
        """Set a parameter; a dictionary sets a subtree."""
        name = resolve(key, caller)
        path = _path(name)
        if (why := self._too_much(path, value)) is not None:
            return (-1, why, 0), []
        if not path:
            if not isinstance(value, dict):
                return (-1, "cannot set root to a value that is no dictionary", 0), []
            self._tree = value
        else:
            inside = self._tree
            for part in path[:-1]:
                if not isinstance(inside.get(part), dict):
                    inside[part] = {}
                inside = inside[part]
            inside[path[-1]] = value
        changed = [
            (uri, f"{each.rstrip('/')}/", self._found(each))
            for each, uris in sorted(self._subscribers.items())
            if _is_inside(name, each) or _is_inside(each, name)
            for uri in sorted(uris)
        ]
        return (1, f"parameter {name} set", 0), changed

    def get_param(self, caller: str, key: str) -> Result:
        """Return a parameter, or a subtree."""
        name = resolve(key, caller)
        found = self._found(name)
        if found is None:
            return (-1, f"Parameter [{name}] is not set", 0), []
        return (1, f"Parameter [{name}]", found), []

    def delete_param(self, caller: str, key: str) -> Result:
        """Delete a parameter or a subtree."""
        name = resolve(key, caller)
        path = _path(name)
        inside = self._found("/" + "/".join(path[:-1])) if path else None
        if not isinstance(inside, dict) or path[-1] not in inside:
            return (-1, f"parameter [{name}] is not set", 0), []
        del inside[path[-1]]
        return (1, f"parameter {name} deleted", 0), []

    def has_param(self, caller: str, key: str) -> Result:
        """Whether a parameter is set."""
        name = resolve(key, caller)
        return (1, name, self._found(name) is not None), []

    def search_param(self, caller: str, key: str) -> Result:
        """Find a parameter in the namespaces of the caller, innermost first."""
        first = (_path(key) or [""])[0]
        parts = _path(caller)
        for n in range(len(parts), -1, -1):
            namespace = "/" + "/".join(parts[:n])
            if self._found(f"{namespace}/{first}") is not None:
                return (1, "Found", resolve(key, f"{namespace.rstrip('/')}/x")), []
        return (-1, f"Cannot find parameter [{key}]", ""), []

    def get_param_names(self, caller: str) -> Result:
        """Return the names of all parameters."""
        return (1, "Parameter names", sorted(_leaves(self._tree, ""))), []

    def subscribe_param(self, caller: str, uri: str, key: str) -> Result:
        """Tell a node when a parameter changes; returns its value, ``{}`` if it is not set."""
        name = resolve(key, caller)
        if sum(map(len, self._subscribers.values())) >= MAX_SUBSCRIBERS:
            return (-1, f"at most {MAX_SUBSCRIBERS} subscribers are kept", 0), []
        self._subscribers.setdefault(name, set()).add(uri)
        found = self._found(name)
        return (1, f"Subscribed to parameter [{name}]", {} if found is None else found), []

    def unsubscribe_param(self, caller: str, uri: str, key: str) -> Result:
        """Tell a node no more."""
        name = resolve(key, caller)
        uris = self._subscribers.get(name, set())
        n = int(uri in uris)
        uris.discard(uri)
        if not uris:
            self._subscribers.pop(name, None)
        return (1, "Unsubscribed", n), []

    def _too_much(self, path: list[str], value: Any) -> str | None:
        """Say which limit all parameters would exceed with a new one; None: none."""
        depth, n, n_bytes = extent(value)
        before = self._found("/" + "/".join(path))
        if before is None:
            n, n_bytes = n + len(path), n_bytes + sum(map(len, path))
        if len(path) + depth > MAX_DEPTH:
            return f"at most {MAX_DEPTH} namespaces are kept inside each other"
        if self._n + n > MAX_VALUES or self._n_bytes + n_bytes > MAX_BYTES:
            _, self._n, self._n_bytes = extent(self._tree)
            _, n_old, n_old_bytes = extent(before)
            n, n_bytes = n - n_old, n_bytes - n_old_bytes
        if self._n + n > MAX_VALUES:
            return f"at most {MAX_VALUES} parameters are kept"
        if self._n_bytes + n_bytes > MAX_BYTES:
            return f"all parameters together have at most {MAX_BYTES} bytes"
        self._n, self._n_bytes = self._n + n, self._n_bytes + n_bytes
        return None

    def _found(self, name: str) -> Any:
        found: Any = self._tree
        for part in _path(name):
            if not isinstance(found, dict) or part not in found:
                return None
            found = found[part]
        return found


def extent(value: Any) -> tuple[int, int, int]:
    """Return how deep a value is, how many values it holds, and about how many bytes."""
    deepest, n, n_bytes = 0, 0, 0
    waiting = [(value, 0)]
    while waiting:
        part, depth = waiting.pop()
        deepest, n = max(deepest, depth), n + 1
        if isinstance(part, dict):
            n_bytes += sum(len(str(key)) for key in part)
            waiting += [(each, depth + 1) for each in part.values()]
        elif isinstance(part, list | tuple):
            waiting += [(each, depth + 1) for each in part]
        else:
            n_bytes += len(part) if isinstance(part, str | bytes) else _size_of(part)
    return deepest, n, n_bytes


def _size_of(value: Any) -> int:
    data = getattr(value, "data", b"")  # of xmlrpc.client.Binary
    return 8 + (len(data) if isinstance(data, bytes | str) else 0)


def _is_inside(name: str, namespace: str) -> bool:
    return f"{name.rstrip('/')}/".startswith(f"{namespace.rstrip('/')}/")


def _leaves(tree: dict[str, Any], prefix: str) -> list[str]:
    found = []
    for key, value in tree.items():
        name = f"{prefix}/{key}"
        found += _leaves(value, name) if isinstance(value, dict) and value else [name]
    return found
