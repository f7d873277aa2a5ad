"""Error models of packets."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, Protocol

from .channel import Path
from .link_budget import LinkBudget

Unit = Literal["bit", "byte", "packet"]


class ErrorModel(Protocol):
    """An error model of packets."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return the probability that a packet of ``n_bytes`` is damaged [0..1]."""


@dataclass(frozen=True, kw_only=True)
class RateErrors:
    """An error rate as a formula in the distance, for bits, bytes or whole packets."""

    rate: Callable[[float], float]
    """The function that returns the rate at a distance [m]."""
    unit: Unit
    """The unit to which the rate refers."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return the probability that a packet of ``n_bytes`` is damaged [0..1]."""
        units = {"bit": 8 * n_bytes, "byte": n_bytes, "packet": 1}[self.unit]
        return error_probability(self.rate(path.distance), units)


@dataclass(frozen=True, kw_only=True)
class BitErrors:
    """A constant bit error rate and, with a link budget, that of the noise."""

    rate: float = 0.0
    """The bit error rate at any distance [1]."""
    budget: LinkBudget | None = None
    """The sound levels of the link; None: there is no noise."""
    bit_rate: float = 1.0
    """The bit rate of the sender [bit/s]."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return the probability that a packet of ``n_bytes`` is damaged [0..1]."""
        noise = 0.0 if self.budget is None else self.budget.bit_error_rate(path, self.bit_rate)
        return error_probability(1.0 - (1.0 - self.rate) * (1.0 - noise), 8 * n_bytes)


def error_probability(unit_rate: float, count: int) -> float:
    """Return the probability of at least one error among ``count`` units: 1-(1-p)^n."""
    if unit_rate >= 1.0:
        return 1.0 if count else 0.0
    return -math.expm1(count * math.log1p(-max(unit_rate, 0.0)))
