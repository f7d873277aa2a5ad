"""The numbers of a field of the newest message on a topic: ``<topicField>``."""

from __future__ import annotations

import dataclasses
import typing

import numpy as np

from ...base.geometry import Array
from ...errors import BadSetting, UnknownName
from ...world import World
from .spec import TopicFieldSpec


class TopicField:
    """The numbers of a field of the newest message; 0 before the first message.

    Numbers that are not finite, such as the range of a sensor without an echo, are 0.

    Raises:
        UnknownName: there is no such topic, or no such field.
        BadSetting: the field has no numbers.
    """

    def __init__(self, spec: TopicFieldSpec, world: World) -> None:
        topics = world.bus.topics
        message_type = world.bus.message_type(spec.topic)
        if message_type is None:
            raise UnknownName("topic", spec.topic, [f"/{name}" for name in topics])
        self._path = spec.field.split(".")
        self.size = _size_of(message_type, self._path, spec)
        """The number of numbers."""
        self._values = np.zeros(self.size)
        self.close = world.bus.subscribe(spec.topic, message_type, self._receive)

    def read(self) -> Array:
        """Return the numbers of the newest message, (n,)."""
        return self._values

    def _receive(self, message: object) -> None:
        value = message
        for name in self._path:
            value = getattr(value, name)
        numbers = np.array(_flatten(value)[: self.size])
        values = np.zeros(self.size)
        values[: len(numbers)] = np.where(np.isfinite(numbers), numbers, 0.0)
        self._values = values


def _size_of(message_type: type, path: list[str], spec: TopicFieldSpec) -> int:
    """Return the number of numbers of a field of a type of messages."""
    kind: typing.Any = message_type
    for name in path:
        hints = typing.get_type_hints(kind) if dataclasses.is_dataclass(kind) else {}
        names = [n for n in hints if not n.startswith("_")]
        if name not in names:
            raise UnknownName(f"field of {message_type.__name__}", spec.field, names)
        kind = hints[name]
    return _count(kind, spec)


def _count(kind: typing.Any, spec: TopicFieldSpec) -> int:
    if kind in (float, int, bool):
        return 1
    if typing.get_origin(kind) is np.ndarray:
        return spec.size
    if dataclasses.is_dataclass(kind):
        hints = typing.get_type_hints(kind)
        return sum(_count(hints[f.name], spec) for f in dataclasses.fields(kind))
    raise BadSetting(
        f"The field {spec.field!r} of {spec.topic!r} has no numbers; expected numbers or an array."
    )


def _flatten(value: object) -> list[float]:
    if dataclasses.is_dataclass(value):
        fields = dataclasses.fields(value)
        return [number for f in fields for number in _flatten(getattr(value, f.name))]
    array: Array = np.asarray(value, dtype=np.float64)
    return [float(number) for number in array.ravel()]
