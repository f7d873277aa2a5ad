"""The form of an observation: its only part, or several parts by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy.typing as npt

STATE = "state"
"""The name of the vector of numbers in an observation with images."""
Observation = npt.NDArray[Any] | dict[str, npt.NDArray[Any]]
"""An observation: an array, or arrays by name."""


def join_parts(
    state: npt.NDArray[Any] | None, images: Mapping[str, npt.NDArray[Any]]
) -> Observation:
    """Return the only part of an observation, or a dictionary of several parts.

    Args:
        state: the vector of numbers, or None without one.
        images: the images by name.
    """
    parts = ({} if state is None else {STATE: state}) | dict(images)
    return parts if len(parts) > 1 else next(iter(parts.values()))
