"""The learning environment of a benchmark, ``<u:environment>``: observations, actions, reward.

`spec` has the elements, `channels` the quantities of a vehicle's state, `topic_fields` the numbers
of messages, `relations` the poses and contacts of bodies, `observer` the vector of observations and
the images, `actuator` the commands, `reward` the formulas, and `episode_levels` the levels that
an episode is drawn from.
"""

from __future__ import annotations

from .actuator import Actuator
from .channels import CHANNELS
from .episode_levels import EpisodeLevelsSpec, drawn_values, selection_errors
from .observer import Observer, bind_images
from .relations import ContactSpec, RelativePoseSpec
from .reward import REWARD_NAMES, RewardFunction
from .spec import MAX_SIZE, ActionSpec, EnvironmentSpec, ImageSpec, TopicFieldSpec

__all__ = [
    "CHANNELS",
    "MAX_SIZE",
    "REWARD_NAMES",
    "ActionSpec",
    "Actuator",
    "ContactSpec",
    "EnvironmentSpec",
    "EpisodeLevelsSpec",
    "ImageSpec",
    "Observer",
    "RelativePoseSpec",
    "RewardFunction",
    "TopicFieldSpec",
    "bind_images",
    "drawn_values",
    "selection_errors",
]
