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
        """Return how likely a packet of ``n_bytes`` is damaged [0..1]."""


@dataclass(frozen=True, kw_only=True)
class RateErrors:
    """A rate as a formula in the distance: of bits, bytes or whole packets."""

    rate: Callable[[float], float]
    """Returns it at a distance [m]."""
    unit: Unit
    """What is lost."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return how likely a packet of ``n_bytes`` is damaged [0..1]."""
        units = {"bit": 8 * n_bytes, "byte": n_bytes, "packet": 1}[self.unit]
        return of_any(self.rate(path.distance), units)


@dataclass(frozen=True, kw_only=True)
class BitErrors:
    """A constant rate of bit errors and, where there is a link budget, those of the noise."""

    rate: float = 0.0
    """How likely a bit is wrong, whatever the distance [1]."""
    budget: LinkBudget | None = None
    """The levels of the link; None: there is no noise."""
    bit_rate: float = 1.0
    """[bit/s]."""

    def probability(self, path: Path, n_bytes: int) -> float:
        """Return how likely a packet of ``n_bytes`` is damaged [0..1]."""
        noise = 0.0 if self.budget is None else self.budget.bit_error_rate(path, self.bit_rate)
        return of_any(1.0 - (1.0 - self.rate) * (1.0 - noise), 8 * n_bytes)


def of_any(rate: float, count: int) -> float:
    """Return how likely one of ``count`` independent things is hit, each at ``rate``: 1-(1-p)^n."""
    if rate >= 1.0:
        return 1.0 if count else 0.0
    return -math.expm1(count * math.log1p(-max(rate, 0.0)))
