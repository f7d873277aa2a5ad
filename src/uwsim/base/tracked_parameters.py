"""The parameters of an algorithm, which record the names that the algorithm reads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ..errors import did_you_mean

Value = float | str


class TrackedParameters(dict[str, Value]):
    """A dict that records the names that are read; an iteration reads all of them."""

    def __init__(self, values: Mapping[str, Value]) -> None:
        super().__init__(values)
        self.plain_copy = dict(values)
        """The parameters as a dict that records nothing."""
        self.names_read: dict[str, None] = {}
        """The names that were read, in the order of reading, whether or not they have a value."""

    def _record_all(self) -> None:
        self.names_read.update(dict.fromkeys(self.plain_copy))

    def __getitem__(self, name: str) -> Value:
        self.names_read[name] = None
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        if isinstance(name, str):
            self.names_read[name] = None
        return super().__contains__(name)

    def get(self, name: str, default: Any = None) -> Any:
        """Return a value, or the default."""
        self.names_read[name] = None
        return super().get(name, default)

    def pop(self, name: str, *default: Any) -> Any:
        """Remove a value and return it, or the default."""
        self.names_read[name] = None
        return super().pop(name, *default)

    def setdefault(self, name: str, default: Any = None) -> Any:
        """Return a value; where there is none, store and return the default."""
        self.names_read[name] = None
        return super().setdefault(name, default)

    def __iter__(self) -> Iterator[str]:
        self._record_all()
        return super().__iter__()

    def keys(self) -> Any:
        """Return the names."""
        self._record_all()
        return super().keys()

    def values(self) -> Any:
        """Return the values."""
        self._record_all()
        return super().values()

    def items(self) -> Any:
        """Return the names and values."""
        self._record_all()
        return super().items()

    def copy(self) -> dict[str, Value]:
        """Return the parameters as a dict."""
        self._record_all()
        return dict(super().items())

    def __or__(self, other: Any) -> Any:
        return self.copy() | other

    def __ror__(self, other: Any) -> Any:
        return other | self.copy()


def describe_unread_parameters(name: str, names: Iterable[str], names_read: Iterable[str]) -> str:
    """Return a note on the parameters that an algorithm never read; empty if it read all.

    Args:
        name: the name of the algorithm.
        names: the names of its parameters.
        names_read: the names that it read.
    """
    valid_names = list(names_read)
    unread_names = [parameter for parameter in names if parameter not in valid_names]
    if not unread_names:
        return ""
    noun = "parameter" if len(unread_names) == 1 else "parameters"
    suggestion = did_you_mean(unread_names[0], valid_names)
    reading_text = f"It read {', '.join(valid_names)}" if valid_names else "It read none"
    unread_text = ", ".join(map(repr, unread_names))
    return f"algorithm {name!r} never read the {noun} {unread_text}.{suggestion} {reading_text}"


def untracked_parameters(parameters: object) -> object:
    """Return parameters as a dict that records nothing."""
    return parameters.plain_copy if isinstance(parameters, TrackedParameters) else parameters
