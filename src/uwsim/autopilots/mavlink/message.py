"""A MAVLink message as a value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Message:
    """A MAVLink message, apart from its bytes."""

    name: str
    """The name of the message, such as ``HEARTBEAT``."""
    fields: Mapping[str, Any] = field(default_factory=dict)
    """The values of the fields, in the units of the message's definition."""
    system: int = 0
    """The system that sent the message; 0 for a message to be sent."""
    component: int = 0
    """The component that sent the message; 0 for a message to be sent."""

    def number(self, name: str) -> float:
        """Return the value of a field as a finite number; 0 if it is none."""
        value = self.fields.get(name, 0.0)
        is_number = isinstance(value, int | float) and math.isfinite(value)
        return float(value) if is_number else 0.0

    def integer(self, name: str) -> int:
        """Return the value of a field as an integer; 0 if it is none."""
        value = self.fields.get(name, 0)
        return value if isinstance(value, int) else 0
