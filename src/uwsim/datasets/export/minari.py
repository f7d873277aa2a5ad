"""Minari: episodes of observations, actions and rewards, stored as Arrow.

``MINARI_DATASETS_PATH=OUT`` and ``minari.load_dataset("uwsim/NAME-v0")`` read it. An episode has
one observation more than actions. A recording is one truncated episode, whose reward is 0. A result
has the specification of its environment, which ``recover_environment()`` makes.
"""

from __future__ import annotations

import importlib.util
import os
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...assets.bundled import bundled_files
from ...errors import MissingExtra
from ...version import __version__
from .csv_tables import check_folder
from .steps import Episode, read_episode

if TYPE_CHECKING:
    from gymnasium.envs.registration import EnvSpec
    from minari.data_collector import EpisodeBuffer

    from ...runs.planning.plan import Plan

STORAGE = "MINARI_DATASETS_PATH"
"""The environment variable with the folder of Minari's data sets."""


def check_extras() -> None:
    """Raise MissingExtra unless Minari, pyarrow and Gymnasium are installed."""
    for module in ("minari", "pyarrow", "gymnasium"):
        if importlib.util.find_spec(module) is None:
            raise MissingExtra(
                f"--minari needs {module}. Install it with: pip install 'uwsim[export]'."
            )


def export_minari(
    recording: Path, out: Path, *, observations: Sequence[str], actions: Sequence[str], rate: float
) -> tuple[str, Episode]:
    """Write a data set of one recording; return its identifier and its steps.

    Raises:
        MissingExtra: Minari or pyarrow is not installed.
        UwsimError: the recording, a topic or the folder is invalid.
    """
    check_extras()
    check_folder(out)
    episode = read_episode(recording, observations, actions, rate)
    return write_minari([episode], out, recording.stem), episode


def write_minari(
    episodes: Sequence[Episode],
    out: Path,
    name: str,
    algorithm: str = "",
    environment: Mapping[str, object] | None = None,
) -> str:
    """Write a data set of episodes with the same fields into a new folder.

    Args:
        episodes: the episodes.
        out: the folder.
        name: the name of the data set; other letters than those of Minari's names become "-".
        algorithm: the algorithm that acted; empty: not known.
        environment: the arguments of `uwsim.make_env`; None: steps of no environment.

    Returns:
        The identifier.
    """
    name = re.sub(r"[^A-Za-z0-9_]+", "-", name).strip("-") or "recording"
    identifier = f"uwsim/{name}-v0"
    out.mkdir(parents=True, exist_ok=True)
    with storage_in(out), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about an author and a code that an export has not
        _write(identifier, episodes, algorithm, environment)
    return identifier


def find_arguments(plan: Plan) -> dict[str, object]:
    """Return the arguments of `uwsim.make_env` for the environment of a plan.

    Files of uwsim have their names, and other files their absolute paths.
    """
    arguments: dict[str, object] = {}
    for kind, path in (("benchmark", plan.benchmark.path), ("scene", plan.scene.path)):
        file = Path(path).resolve()
        names = {path.resolve(): name for name, path in bundled_files(f"{kind}s").items()}
        arguments[kind] = names.get(file, str(file))
    settings = {name: value for name, value in plan.settings if not name.startswith("algorithm.")}
    return {**arguments, "settings": settings} if settings else arguments


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


def _write(
    identifier: str,
    episodes: Sequence[Episode],
    algorithm: str,
    arguments: Mapping[str, object] | None,
) -> None:
    import gymnasium
    import minari
    from gymnasium.spaces import Box

    environment: gymnasium.Env[object, object] | None = None
    if arguments is not None:  # Minari asks it for its specification only
        environment = gymnasium.Env()
        environment.spec = make_specification(identifier, arguments)
    first, limit = episodes[0], np.inf if episodes[0].outcome is None else 1.0
    observations, actions = first.observations, first.actions
    minari.create_dataset_from_buffers(
        identifier,
        [_make_buffer(number, episode) for number, episode in enumerate(episodes)],
        env=environment,
        observation_space=Box(-np.inf, np.inf, observations.shape[1:], observations.dtype.type),
        action_space=Box(-limit, limit, actions.shape[1:], actions.dtype.type),
        algorithm_name=algorithm or None,
        description=(
            f"Recorded by uwsim {__version__}. Observations: "
            f"{', '.join(first.observation_names)}. Actions: {', '.join(first.action_names)}."
        ),
        data_format="arrow",
    )


def make_specification(identifier: str, arguments: Mapping[str, object]) -> EnvSpec:
    """Return the specification of an environment, with the name of its task if it has one."""
    from gymnasium.envs.registration import EnvSpec

    from ...envs.registration import TASKS

    names = {benchmark: name for name, benchmark in TASKS.items()}
    return EnvSpec(
        id=names.get(str(arguments["benchmark"]), identifier),
        entry_point="uwsim.envs.benchmark_env:BenchmarkEnv",
        kwargs=dict(arguments),
    )


def _make_buffer(number: int, episode: Episode) -> EpisodeBuffer:
    """Return an episode of Minari, which has one observation more than actions."""
    from minari.data_collector import EpisodeBuffer

    outcome = episode.outcome
    observations, actions = episode.observations, episode.actions
    if outcome is None:
        actions = actions[:-1]
    else:
        observations = np.concatenate([observations, outcome.final_observation[None]])
    n = len(actions)
    is_last = np.arange(n) == n - 1
    is_terminated = outcome is not None and outcome.is_terminated
    return EpisodeBuffer(
        id=number,
        observations=observations,
        actions=actions,
        rewards=[0.0] * n if outcome is None else outcome.rewards.tolist(),
        terminations=(is_last & is_terminated).tolist(),
        truncations=(is_last & (not is_terminated)).tolist(),
        infos={},
    )
