"""Numbers with as many digits as their intervals justify."""

from __future__ import annotations

import math

from ..uncertainty import Estimate


def format_value(value: float, error: float) -> str:
    """Return a value with the digits down to a tenth of its error."""
    if not math.isfinite(value) or not math.isfinite(error) or error <= 0.0:
        return f"{value:.4g}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{min(digits, 7)}f}"


def format_interval(estimate: Estimate) -> tuple[str, str]:
    """Return the value, and its interval: ``12.9 to 14.3``."""
    error = 0.5 * (estimate.high - estimate.low)
    low, high = (format_value(number, error) for number in (estimate.low, estimate.high))
    return format_value(estimate.value, error), f"{low} to {high}"


def round_number(number: float) -> float | None:
    """Round a number to six digits for JSON, which has no infinity."""
    return float(f"{number:.6g}") if math.isfinite(number) else None
