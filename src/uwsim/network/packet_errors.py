"""Error models: the probability that a packet is damaged on a path."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, Protocol

from .channel import Path
from .link_budget import LinkBudget

Unit = Literal["bit", "byte", "packet"]
"""The unit whose errors an error rate counts."""


class ErrorModel(Protocol):
    """An error model of packets."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return the probability that a packet of ``n_bytes`` is damaged [0..1]."""


@dataclass(frozen=True, kw_only=True)
class RateErrors:
    """An error rate that depends on the distance, for bits, bytes or whole packets."""

    rate: Callable[[float], float]
    """The function that returns the error rate [1] at a distance [m]."""
    unit: Unit
    """The unit whose errors the rate counts."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return the probability that a packet of ``n_bytes`` is damaged [0..1]."""
        units = {"bit": 8 * n_bytes, "byte": n_bytes, "packet": 1}[self.unit]
        return error_probability(self.rate(path.distance), units)


@dataclass(frozen=True, kw_only=True)
class BitErrors:
    """A constant bit error rate and, with a link budget, the bit error rate due to noise."""

    rate: float = 0.0
    """The bit error rate at any distance [1]."""
    budget: LinkBudget | None = None
    """The link budget, which determines the errors due to noise; None: there is no noise."""
    bit_rate: float = 1.0
    """The bit rate of the sender [bit/s]."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return the probability that a packet of ``n_bytes`` is damaged [0..1]."""
        noise = 0.0 if self.budget is None else self.budget.bit_error_rate(path, self.bit_rate)
        return error_probability(1.0 - (1.0 - self.rate) * (1.0 - noise), 8 * n_bytes)


def error_probability(unit_rate: float, count: int) -> float:
    """Return the probability of an error in at least one of ``count`` units: 1 - (1 - p)^n.

    Args:
        unit_rate: the probability p of an error in one unit [1].
        count: the number n of units.
    """
    if unit_rate >= 1.0:
        return 1.0 if count else 0.0
    return -math.expm1(count * math.log1p(-max(unit_rate, 0.0)))
