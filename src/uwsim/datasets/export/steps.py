"""Steps of an episode: observations and actions at a constant rate, and those of a recording.

At the time of a step, an observation is the newest message of its topic, and the action is the
newest command. The first step is at the first time at which all topics have a message.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...errors import BadSetting
from ...middleware.recording import BagReader
from .csv_tables import check_topics
from .message_numbers import read_numbers

MAX_STEPS = 10_000_000
"""The greatest number of steps of an episode."""
MAX_RATE = 1000.0
"""The greatest rate of steps [Hz]."""
Numbers = npt.NDArray[np.float32] | npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Outcome:
    """The rewards and the end of an episode of an environment."""

    rewards: npt.NDArray[np.float64]
    """The reward of each step, (n,)."""
    final_observation: Numbers
    """The observation after the last step, (k,)."""
    is_terminated: bool
    """True if a trigger, a measure or a failure ended the episode, not the time."""
    is_success: bool
    """True if the episode had success."""


@dataclass(frozen=True, eq=False)
class Episode:
    """The steps of a recording, or of a level of a result."""

    rate: float
    """The rate of the steps [Hz]."""
    times: npt.NDArray[np.float64]
    """The times of the steps in the recording, (n,) [s]."""
    observations: Numbers
    """The observations, (n, k)."""
    observation_names: tuple[str, ...]
    """The topic and the field of each number of an observation."""
    actions: Numbers
    """The actions, (n, m)."""
    action_names: tuple[str, ...]
    """The topic and the field of each number of an action."""
    outcome: Outcome | None = None
    """The rewards and the end; None: a recording has neither."""


def read_episode(
    recording: Path, observations: Sequence[str], actions: Sequence[str], rate: float
) -> Episode:
    """Read the steps of a recording.

    Raises:
        AssetError: the recording cannot be read.
        UnknownName: a topic is not in the recording.
        BadSetting: the rate is invalid, a topic has no numbers, or there is no step.
    """
    if not 0.0 < rate <= MAX_RATE:
        raise BadSetting(f"--rate is {rate:g}; expected more than 0, and at most {MAX_RATE:g} Hz.")
    if not observations or not actions:
        raise BadSetting("Give one --observation TOPIC and one --action TOPIC at least.")
    with BagReader(recording) as reader:
        check_topics(reader, [*observations, *actions])
        topics = list(dict.fromkeys([*observations, *actions]))
        series = {topic: _read_series(reader, topic) for topic in topics}
    start = max(float(times[0]) for times, _, _ in series.values())
    end = max(float(times[-1]) for times, _, _ in series.values())
    n_steps = math.floor((end - start) * rate + 1e-9) + 1
    if n_steps > MAX_STEPS:
        raise BadSetting(f"{n_steps} steps; at most {MAX_STEPS} are exported. Lower --rate.")
    times = start + np.arange(n_steps) / rate
    values_at_steps = {
        topic: values[np.searchsorted(stamps, times + 1e-9, side="right") - 1]
        for topic, (stamps, _, values) in series.items()
    }
    return Episode(
        rate=rate,
        times=times,
        observations=np.concatenate([values_at_steps[topic] for topic in observations], axis=1),
        observation_names=_join_names(series, observations),
        actions=np.concatenate([values_at_steps[topic] for topic in actions], axis=1),
        action_names=_join_names(series, actions),
    )


Series = tuple[npt.NDArray[np.float64], tuple[str, ...], Numbers]
"""The times (n,) [s], the fields, and the values (n, k) of a topic."""


def _join_names(series: dict[str, Series], topics: Sequence[str]) -> tuple[str, ...]:
    return tuple(f"{topic}/{name}" for topic in topics for name in series[topic][1])


def _read_series(reader: BagReader, topic: str) -> Series:
    times: list[float] = []
    rows: list[list[float]] = []
    columns: tuple[str, ...] = ()
    for time, _, message in reader.messages([topic]):
        numbers = read_numbers(message)
        columns = columns or tuple(numbers)
        times.append(time)
        rows.append([numbers.get(name, math.nan) for name in columns])
    if not columns:
        raise BadSetting(f"{topic} has no numbers; choose a topic of numbers, not images or texts.")
    return np.array(times), columns, np.array(rows, dtype=np.float32)
