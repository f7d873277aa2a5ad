"""Records of a result whose keys are known and may be absent; what is not known is kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import ClassVar, Self

from .checked_values import checked_values


@dataclass(frozen=True, kw_only=True)
class StoredRecord:
    """An object of ``result.json``. None is a key that is absent; `others` has unknown keys."""

    KEY: ClassVar[str]
    """Key of the record in ``result.json``."""

    others: Mapping[str, object] = field(default_factory=dict)
    """Values under keys that this version does not know."""

    def __post_init__(self) -> None:
        for each in fields(self):
            at = self.KEY if each.name == "others" else f"{self.KEY}.{each.name}"
            object.__setattr__(self, each.name, checked_values(getattr(self, each.name), at))

    @classmethod
    def of(cls, stored: Mapping[str, object]) -> Self:
        """Return the record of what JSON has; its shape has been checked (`stored_shapes`)."""
        known = {each.name for each in fields(cls)} - {"others"}
        given = {name: value for name, value in stored.items() if name in known}
        others = {name: value for name, value in stored.items() if name not in known}
        return cls(others=others, **given)

    def stored(self) -> dict[str, object]:
        """Return what `of` reads: the keys that are there, in their order."""
        names = (each.name for each in fields(self) if each.name != "others")
        known = {name: value for name in names if (value := getattr(self, name)) is not None}
        return {**known, **self.others}
