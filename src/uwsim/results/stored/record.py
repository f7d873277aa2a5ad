"""The base class of the records in a result; known keys may be absent, unknown keys are kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import ClassVar, Self

from .checked_values import checked_values


@dataclass(frozen=True, kw_only=True)
class StoredRecord:
    """An object in ``result.json``, with an attribute for each known key; None if it is absent."""

    KEY: ClassVar[str]
    """The key of the record in ``result.json``."""
    STORED_KEYS: ClassVar[Mapping[str, str]] = {}
    """The key of each attribute whose key in ``result.json`` is not its name: name -> key."""

    other_values: Mapping[str, object] = field(default_factory=dict)
    """The values under keys that this version does not know."""

    def __post_init__(self) -> None:
        for name in (attribute.name for attribute in fields(self)):
            path = self.KEY if name == "other_values" else f"{self.KEY}.{self._key(name)}"
            object.__setattr__(self, name, checked_values(getattr(self, name), path))

    @classmethod
    def from_dict(cls, record: Mapping[str, object]) -> Self:
        """Return the record of a JSON object whose shape was checked (`stored_shapes`)."""
        names = {cls._key(attribute.name): attribute.name for attribute in fields(cls)}
        del names["other_values"]
        known_values = {names[key]: value for key, value in record.items() if key in names}
        other_values = {key: value for key, value in record.items() if key not in names}
        return cls(other_values=other_values, **known_values)

    def as_dict(self) -> dict[str, object]:
        """Return the JSON object: present keys in the order of the fields, then unknown keys."""
        names = (attribute.name for attribute in fields(self) if attribute.name != "other_values")
        known_values = {
            self._key(name): value for name in names if (value := getattr(self, name)) is not None
        }
        return {**known_values, **self.other_values}

    @classmethod
    def _key(cls, name: str) -> str:
        return cls.STORED_KEYS.get(name, name)
