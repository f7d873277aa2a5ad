"""The two steppers of an environment: the engine, for any scene, and compiled rows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, Protocol

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting
from ..messages.observation import Observation
from ..runs.planning.plan import Plan
from ..runs.planning.trial_cache import TrialCache
from ..runs.trial.trial_observer import TrialObserver
from ..world import ImageView
from .compiled.episodes import Episodes
from .episode import Episode
from .frames import Frame, FrameSource
from .levels import Value, draw_level, is_path, vary_plan
from .row_task import RowsRefused

StepperName = Literal["engine", "rows", "auto"]
STEPPERS = ("engine", "rows", "auto")
"""The names of the steppers; ``auto``: rows if they can step the environment, else the engine."""
ENGINE = "engine: the trial of uwsim bench, for any scene and any topic"
"""The statement of the stepper that is the default."""
NO_IMAGES = "Rows render no images; expected stepper='engine' with render_mode."
"""The error if images are to be rendered."""
ROWS = "rows: one free vehicle, thrusters as actions, the state as observation"
"""The statement of the stepper of compiled rows."""


class Stepper(Protocol):
    """An object that steps the episodes of one environment."""

    statement: str
    """The name of the stepper, and the reason for it."""
    has_paths: bool
    """True if the options of an episode may change any number of the scene by its path."""

    @property
    def layout(self) -> tuple[tuple[str, int], ...]:
        """The name and the size of each part of an observation."""

    @property
    def images(self) -> Mapping[str, ImageView]:
        """The observed images by name."""

    @property
    def n_actions(self) -> int:
        """The number of numbers of an action."""

    def begin(
        self, seed: int, choices: Mapping[str, Value], observer: TrialObserver | None = None
    ) -> dict[str, Any]:
        """Begin an episode; return its ``level`` and ``variations``."""

    def observe(self) -> Observation:
        """Return the present observation."""

    def step(self, action: Array) -> tuple[float, bool, bool]:
        """Apply an action; return the reward, and whether the episode is terminated, truncated."""

    def results(self) -> dict[str, Any]:
        """Return the results of an episode that is over."""

    def draw(self, frames: FrameSource) -> Frame:
        """Return the present image, (h, w, 3)."""

    def close(self) -> None:
        """Release the scene."""


class EngineStepper:
    """The trials of ``uwsim bench``, stepped by the engine."""

    def __init__(self, plan: Plan, statement: str = ENGINE) -> None:
        self._plan, self._cache = plan, TrialCache()
        self.statement, self.has_paths = statement, True
        level = draw_level(plan.benchmark, 0, {})
        self._episode = Episode(plan, 0, level, self._cache)

    @property
    def layout(self) -> tuple[tuple[str, int], ...]:
        """The name and the size of each part of an observation."""
        return self._episode.layouts[0]

    @property
    def images(self) -> Mapping[str, ImageView]:
        """The observed images by name."""
        return self._episode.images[0]

    @property
    def n_actions(self) -> int:
        """The number of numbers of an action."""
        return self._episode.n_actions[0]

    def begin(
        self, seed: int, choices: Mapping[str, Value], observer: TrialObserver | None = None
    ) -> dict[str, Any]:
        """Begin an episode; return its ``level`` and ``variations``."""
        level = draw_level(self._plan.benchmark, seed, choices)
        variations = {path: value for path, value in choices.items() if is_path(path)}
        plan = vary_plan(self._plan, choices)
        variations |= {draw.path: draw.value for draw in plan.draws(seed)}
        self._episode.close()
        self._episode = Episode(plan, seed, level, self._cache, observer)
        return {"level": dict(level.values), "variations": variations}

    def observe(self) -> Observation:
        """Return the present observation."""
        [observation] = self._episode.observe()
        return observation

    def step(self, action: Array) -> tuple[float, bool, bool]:
        """Apply an action; return the reward, and whether the episode is terminated, truncated."""
        [reward] = self._episode.step([action])
        is_truncated = self._episode.is_truncated
        return reward, self._episode.row is not None and not is_truncated, is_truncated

    def results(self) -> dict[str, Any]:
        """Return the results of an episode that is over."""
        return self._episode.result()

    def draw(self, frames: FrameSource) -> Frame:
        """Return the present image, (h, w, 3)."""
        return frames.draw(self._episode.simulation)

    def close(self) -> None:
        """Close the scene and its renderer."""
        self._episode.close()
        self._cache.close()


class RowStepper:
    """The only row of a batch that compiled code steps."""

    def __init__(self, plan: Plan) -> None:
        self._episodes = Episodes(plan, 1)
        self.statement, self.has_paths = ROWS, False
        self._mask, self._row = np.ones(1, np.bool_), np.zeros(1, np.int64)
        self._arrays = self._episodes.arrays

    @property
    def layout(self) -> tuple[tuple[str, int], ...]:
        """The name and the size of each part of an observation."""
        return self._episodes.layout

    @property
    def images(self) -> Mapping[str, ImageView]:
        """The observed images by name."""
        return {}

    @property
    def n_actions(self) -> int:
        """The number of numbers of an action."""
        return self._episodes.n_actions

    def begin(
        self, seed: int, choices: Mapping[str, Value], observer: TrialObserver | None = None
    ) -> dict[str, Any]:
        """Begin an episode; return its ``level`` and ``variations``."""
        episodes = self._episodes
        episodes.begin(self._mask, [seed], choices)
        level = {name: float(values[0]) for name, values in episodes.levels.items()}
        variations = {path: float(values[0]) for path, values in episodes.variations.items()}
        return {"level": level, "variations": variations}

    def observe(self) -> Observation:
        """Return the present observation."""
        observation: Array = self._arrays.observations[0].copy()
        return observation

    def step(self, action: Array) -> tuple[float, bool, bool]:
        """Apply an action; return the reward, and whether the episode is terminated, truncated."""
        arrays = self._arrays
        self._episodes.step(action, self._mask)
        return float(arrays.rewards[0]), bool(arrays.terminated[0]), bool(arrays.truncated[0])

    def results(self) -> dict[str, Any]:
        """Return the results of an episode that is over."""
        results = self._episodes.results(self._row)
        measures = {name: float(values[0]) for name, values in results.pop("measures").items()}
        return {"measures": measures, **{key: item.item(0) for key, item in results.items()}}

    def draw(self, frames: FrameSource) -> Frame:
        """Raise BadSetting: rows have no images."""
        raise BadSetting(NO_IMAGES)

    def close(self) -> None:
        """End the threads, of which there are none."""
        self._episodes.close()


def make_stepper(plan: Plan, name: str, *, renders: bool) -> Stepper:
    """Make the stepper of one environment.

    Args:
        plan: the plan of the environment.
        name: one of `STEPPERS`.
        renders: true if images are rendered, which needs the engine.

    Raises:
        BadSetting: there is no such stepper, or rows cannot step the environment.
    """
    if check_stepper(name) == "engine":
        return EngineStepper(plan)
    if renders and name == "auto":
        return EngineStepper(plan, "engine: rows render no images")
    if renders:
        raise BadSetting(NO_IMAGES)
    try:
        return RowStepper(plan)
    except RowsRefused as error:
        if name == "rows":
            raise
        return EngineStepper(plan, f"engine: {error.reasons}")


def check_stepper(name: str) -> str:
    """Return the name of a stepper; raise BadSetting if there is none."""
    if name not in STEPPERS:
        raise BadSetting(f"stepper is {name!r}; expected one of {', '.join(STEPPERS)}.")
    return name
