"""Minari: one episode of observations and actions, stored as Arrow.

``MINARI_DATASETS_PATH=OUT`` and ``minari.load_dataset("uwsim/NAME-v0")`` read it. The reward is 0:
a recording has none. An episode has one observation more than actions; the episode is truncated.
"""

from __future__ import annotations

import importlib.util
import os
import re
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ...errors import MissingExtra
from ...version import __version__
from .csv_tables import check_folder
from .steps import Episode, read_episode

STORAGE = "MINARI_DATASETS_PATH"
"""The environment variable with the folder of Minari's data sets."""


def export_minari(
    recording: Path, out: Path, *, observations: Sequence[str], actions: Sequence[str], rate: float
) -> tuple[str, Episode]:
    """Write a data set of one episode; return its identifier and its steps.

    Raises:
        MissingExtra: Minari or pyarrow is not installed.
        UwsimError: the recording, a topic or the folder is invalid.
    """
    for module in ("minari", "pyarrow", "gymnasium"):
        if importlib.util.find_spec(module) is None:
            raise MissingExtra(
                f"--minari needs {module}. Install it with: pip install 'uwsim[export]'."
            )
    check_folder(out)
    episode = read_episode(recording, observations, actions, rate)
    name = re.sub(r"[^A-Za-z0-9_]+", "-", recording.stem).strip("-") or "recording"
    identifier = f"uwsim/{name}-v0"
    out.mkdir(parents=True, exist_ok=True)
    with storage_in(out), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about an author and a code that a recording has not
        _write(identifier, episode)
    return identifier, episode


@contextmanager
def storage_in(out: Path) -> Iterator[None]:
    """Let Minari write into a folder during the block, whatever the user has set."""
    previous_value = os.environ.get(STORAGE)
    os.environ[STORAGE] = str(out.absolute())
    try:
        yield
    finally:
        del os.environ[STORAGE]
        if previous_value is not None:
            os.environ[STORAGE] = previous_value


def _write(identifier: str, episode: Episode) -> None:
    import minari
    from gymnasium.spaces import Box
    from minari.data_collector import EpisodeBuffer

    n = len(episode.times) - 1
    is_last = np.arange(n) == n - 1
    buffer = EpisodeBuffer(
        id=0,
        observations=episode.observations,
        actions=episode.actions[:n],
        rewards=[0.0] * n,
        terminations=[False] * n,
        truncations=is_last.tolist(),
        infos={},
    )
    minari.create_dataset_from_buffers(
        identifier,
        [buffer],
        observation_space=Box(-np.inf, np.inf, episode.observations.shape[1:], np.float32),
        action_space=Box(-np.inf, np.inf, episode.actions.shape[1:], np.float32),
        description=(
            f"Recorded by uwsim {__version__}. Observations: "
            f"{', '.join(episode.observation_names)}. Actions: {', '.join(episode.action_names)}."
        ),
        data_format="arrow",
    )
