"""The actions of environments: arrays of finite numbers from programs outside."""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting, short_repr

NUMBER_KINDS = "buif"
"""The kinds of numpy numbers that an action may have: booleans, integers and floats."""


def read_action_values(
    action: object, shape: tuple[int, ...], subject: str = "The action"
) -> Array:
    """Return the numbers of an action, or of those of several rows.

    Args:
        action: the action of a program.
        shape: the expected shape.
        subject: the beginning of the message of an error.

    Raises:
        BadSetting: it has another shape, or values that are no finite real numbers.
    """
    expected = f"expected {shape}, finite numbers from -1 to 1 (others are clipped)."
    try:
        values = np.asarray(action)
    except (TypeError, ValueError, OverflowError):
        raise BadSetting(f"{subject} is {short_repr(action)}; {expected}") from None
    if values.dtype.kind not in NUMBER_KINDS:
        raise BadSetting(f"{subject} is {short_repr(action)}; {expected}")
    if values.shape != shape:
        raise BadSetting(f"{subject} has the shape {values.shape}; {expected}")
    numbers: Array = values.astype(np.float64)
    if not np.isfinite(numbers).all():
        index = tuple(np.argwhere(~np.isfinite(numbers))[0].tolist())
        place = ", ".join(map(str, index))
        raise BadSetting(f"{subject} has {numbers[index]} at [{place}]; {expected}")
    return numbers
