"""The spaces of observations: a vector of numbers, images, or a dictionary of both."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from gymnasium.spaces import Box, Dict

from ..benchmark.environment.observer import MAX_OBSERVATION
from ..messages.observation import STATE
from ..world import ImageView


def observation_space(n_numbers: int, images: Mapping[str, ImageView]) -> Box | Dict:
    """Return the space of an observation, in the form of `uwsim.messages.observation.join_parts`.

    Args:
        n_numbers: the number of numbers of the vector.
        images: the images by name.
    """
    spaces: dict[str, Box] = {}
    if n_numbers:
        spaces[STATE] = Box(-MAX_OBSERVATION, MAX_OBSERVATION, (n_numbers,), np.float64)
    for name, view in images.items():
        spaces[name] = Box(0.0, view.maximum, view.shape, view.number_type)
    return Dict(spaces) if len(spaces) > 1 else next(iter(spaces.values()))
