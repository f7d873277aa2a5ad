"""Numbers with as many digits as their intervals justify."""

from __future__ import annotations

import math

from ..quantities import Quantity


def format_value(value: float, error: float) -> str:
    """Return a value with the digits down to a tenth of its error."""
    if not math.isfinite(value) or not math.isfinite(error) or error <= 0.0:
        return f"{value:.4g}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{min(digits, 6)}f}"


def format_quantity(quantity: Quantity) -> str:
    """Return a value with its interval: ``1.02 (0.97 to 1.07)``."""
    half_width = 0.5 * (quantity.high - quantity.low)
    texts = [
        format_value(number, half_width) for number in (quantity.value, quantity.low, quantity.high)
    ]
    return f"{texts[0]} ({texts[1]} to {texts[2]})"


def round_number(number: float) -> float:
    """Round a number to six digits, so that files do not depend on the processor."""
    return float(f"{number:.6g}") if math.isfinite(number) else number
