"""The PettingZoo environment of a benchmark file in which several vehicles have policies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.spaces import Box, Dict
from pettingzoo import ParallelEnv

from ..base.geometry import Array
from ..editing import Benchmark, Scene
from ..errors import BadSetting, UnknownName, did_you_mean
from ..messages.observation import Observation
from ..runs.planning.trial_cache import TrialCache
from .actions import read_action_values
from .benchmark_env import MAX_SEED, Action
from .episode import Episode
from .frames import Frame, FrameSource
from .levels import OPTIONS, check_options, draw_level, is_path, read_choices, vary_plan
from .spaces import observation_space
from .task import AgentOptions, make_agents_task, read_agents


class ParallelBenchmarkEnv(ParallelEnv[str, Observation, Action]):  # type: ignore[misc]  # as Gymnasium
    """The environment of a benchmark file with an ``<u:environment>`` for each of its agents.

    The agents are vehicles, by their names. All act at the same times, in one simulation, and their
    episode ends at the same time. An agent has its own observation, reward and success; the
    measures of the benchmark and its score are common to all.

    Args:
        benchmark: a benchmark file, a bundled name, or a `Benchmark`.
        scene: the scene, a `Scene` too; None: the scene that the benchmark names.
        agents: for each vehicle that acts, by its name, the parts of its environment
            (``observation``, ``action``, ``reward``, ``success``, ``reference``, ``period``) that
            replace those of the file; None: the agents of the file.
        settings: values to change in the scene and the updaters, as ``--set`` names them.
        data_path: more folders in which files are searched.
        render_mode: ``rgb_array``, or None.
        camera: the camera or view of the images, as of `BenchmarkEnv`.
        frame_size: the width and height of the images [px]; None: those of the camera.

    Raises:
        UwsimError: a file, a name or an option is invalid.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}  # noqa: RUF012

    def __init__(
        self,
        benchmark: str | Path | Benchmark,
        *,
        scene: str | Path | Scene | None = None,
        agents: Mapping[str, AgentOptions] | None = None,
        settings: Mapping[str, float | str] | None = None,
        data_path: Sequence[str | Path] = (),
        render_mode: str | None = None,
        camera: str | None = None,
        frame_size: tuple[int, int] | None = None,
    ) -> None:
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise BadSetting(f"render_mode is {render_mode!r}; expected 'rgb_array' or None.")
        self._plan = make_agents_task(
            benchmark,
            read_agents(agents),
            settings=settings or {},
            data_path=tuple(data_path),
            scene=scene,
        )
        environments = self._plan.benchmark.environments
        self.render_mode = render_mode
        self.metadata = {
            **type(self).metadata,
            "name": f"uwsim_{Path(self._plan.benchmark.path).stem}",
            "render_fps": max(1, round(1.0 / environments[0].period)),
        }
        self._cache = TrialCache()
        self._generator = np.random.default_rng()
        self._seed = 0
        self._episode: Episode | None = self._begin(0, {})
        self.possible_agents = [spec.vehicle for spec in environments]
        """The names of the vehicles that act."""
        self.agents: list[str] = []
        """The agents of the running episode; empty when it is over."""
        self.layouts = dict(zip(self.possible_agents, self._episode.layouts, strict=True))
        """The name and the size of each part of the observation of each agent, in order."""
        self.observation_spaces = {
            agent: observation_space(sum(n for _, n in self.layouts[agent]), images)
            for agent, images in zip(self.possible_agents, self._episode.images, strict=True)
        }
        self.action_spaces = {
            agent: Box(-1.0, 1.0, (n,), np.float32)
            for agent, n in zip(self.possible_agents, self._episode.n_actions, strict=True)
        }
        self._frames = FrameSource(self._plan.scene, camera, frame_size)

    def observation_space(self, agent: str) -> Box | Dict:
        """Return the space of the observations of an agent."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Box:
        """Return the space of the actions of an agent."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Observation], dict[str, dict[str, Any]]]:
        """Begin an episode of all agents; the arguments are those of `BenchmarkEnv.reset`.

        PettingZoo's checks pass options that no environment knows: these are ignored, unless they
        are misspelt ones.
        """
        known_options = {
            key: value
            for key, value in check_options(options).items()
            if key in OPTIONS or did_you_mean(key, OPTIONS)
        }
        choices = read_choices(self._plan.benchmark.scene_updater, known_options)
        if seed is not None:
            self._generator = np.random.default_rng(seed)
        episode_seed = int(self._generator.integers(MAX_SEED)) if seed is None else seed
        self.agents = []  # until the new episode has begun
        if self._episode is not None:
            self._episode.close()
        self._episode = self._begin(episode_seed, choices)
        self.agents = list(self.possible_agents)
        return self._observe(self._episode), self._infos(self._episode)

    def step(
        self, actions: Mapping[str, Action]
    ) -> tuple[
        dict[str, Observation],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        """Apply an action of each agent for one period, or until the episode ends.

        Raises:
            BadSetting: no episode is running, an agent has no action, or an action is invalid.
        """
        episode, agents = self._episode, self.possible_agents
        if episode is None or not self.agents:
            raise BadSetting("No episode is running; call reset() first.")
        rewards = episode.step([self._read_action(agent, actions) for agent in agents])
        is_over, is_truncated = episode.row is not None, episode.is_truncated
        observations, infos = self._observe(episode), self._infos(episode)
        if is_over:
            self.agents = []
        return (
            observations,
            dict(zip(agents, rewards, strict=True)),
            dict.fromkeys(agents, is_over and not is_truncated),
            dict.fromkeys(agents, is_truncated),
            infos,
        )

    def render(self) -> Frame | None:
        """Return the image of the camera, (h, w, 3); None without a render mode."""
        if self.render_mode is None or self._episode is None:
            return None
        return self._frames.draw(self._episode.simulation)

    def close(self) -> None:
        """Close the scene and its renderer."""
        if self._episode is not None:
            self._episode.close()
            self._episode = None
        self._cache.close()

    def _read_action(self, agent: str, actions: Mapping[str, Action]) -> Array:
        if agent not in actions:
            raise UnknownName("agent of an action", agent, list(actions))
        shape = self.action_spaces[agent].shape
        return read_action_values(actions[agent], shape, f"The action of {agent!r}")

    def _begin(self, seed: int, choices: Mapping[str, float | tuple[float, float]]) -> Episode:
        self._seed = seed
        self._level = draw_level(self._plan.benchmark, seed, choices)
        self._variations = {path: value for path, value in choices.items() if is_path(path)}
        plan = vary_plan(self._plan, choices)
        self._variations |= {draw.path: draw.value for draw in plan.draws(seed)}
        return Episode(plan, seed, self._level, self._cache)

    def _observe(self, episode: Episode) -> dict[str, Observation]:
        return dict(zip(self.possible_agents, episode.observe(), strict=True))

    def _infos(self, episode: Episode) -> dict[str, dict[str, Any]]:
        """Return the seed and the level and, at the end, the result of each agent."""
        return {
            agent: {
                "seed": self._seed,
                "level": dict(self._level.values),
                "variations": dict(self._variations),
                **episode.result(i),
            }
            for i, agent in enumerate(self.possible_agents)
        }
