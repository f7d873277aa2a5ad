"""The Gymnasium environment of a benchmark file."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box

from ..editing import Benchmark, Scene
from ..errors import BadSetting, short_repr
from ..messages.observation import Observation
from .actions import read_action_values
from .episode import environment_of, max_steps_of
from .frames import Frame, FrameSource
from .levels import read_choices
from .spaces import observation_space
from .steppers import StepperName, make_stepper
from .task import EnvironmentOptions, make_task

if TYPE_CHECKING:
    from ..viewer.live.session import LiveSession

MAX_SEED = 2**31 - 1
"""The greatest seed that an environment draws for an episode without a seed."""
Action = npt.NDArray[np.float32]


class BenchmarkEnv(gymnasium.Env[Observation, Action]):  # type: ignore[misc]  # mypy skips gymnasium
    """The environment of a benchmark file with ``<u:environment>``.

    Args:
        benchmark: a benchmark file, a bundled name, or a `Benchmark`.
        scene: the scene, a `Scene` too; None: the scene that the benchmark names.
        observation: the observed quantities and fields of topics; None: those of the file.
        action: the topics of the commands; None: those of the file.
        reward: the expression of the reward; None: that of the file.
        success: the expression of the success; None: that of the file.
        vehicle: the vehicle; None: that of the file, or the first of the scene.
        reference: the measure with the desired position; None: that of the file.
        period: the time between two actions [s]; None: that of the file.
        settings: values to change in the scene and the updaters, as ``--set`` names them.
        data_path: more folders in which files are searched.
        render_mode: ``rgb_array``; ``human``, a page for a browser, whose address is printed once;
            or None.
        camera: the camera of the images, or ``chase``, ``orbit``, ``top`` or ``viewer``, views from
            outside (`uwsim.envs.frames`); None: the first camera of the scene, else ``orbit``.
        frame_size: the width and height of the images [px]; None: those of the camera.
        real_time_factor: the simulation time per wall time in the mode ``human`` [1]; 0: as fast as
            possible.
        stepper: ``engine``: an episode is a trial of the benchmark, to the bit. ``rows``: compiled
            code, which agrees with the engine to 1e-10. ``auto``: rows if they can step the
            environment, else the engine.

    Raises:
        UwsimError: a file, a name or an option is invalid.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "human"], "render_fps": 20}  # noqa: RUF012

    def __init__(
        self,
        benchmark: str | Path | Benchmark,
        *,
        scene: str | Path | Scene | None = None,
        observation: Sequence[str] | None = None,
        action: Sequence[str] | None = None,
        reward: str | None = None,
        success: str | None = None,
        vehicle: str | None = None,
        reference: str | None = None,
        period: float | None = None,
        settings: Mapping[str, float | str] | None = None,
        data_path: Sequence[str | Path] = (),
        render_mode: str | None = None,
        camera: str | None = None,
        frame_size: tuple[int, int] | None = None,
        real_time_factor: float = 1.0,
        stepper: StepperName = "engine",
    ) -> None:
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise BadSetting(
                f"render_mode is {render_mode!r}; expected 'rgb_array', 'human' or None. "
                "(RenderCollection of Gymnasium gives lists of images.)"
            )
        if not isinstance(real_time_factor, int | float) or not real_time_factor >= 0.0:
            raise BadSetting(
                f"real_time_factor is {short_repr(real_time_factor)}; expected a number, at least "
                "0."
            )
        options = EnvironmentOptions(
            observation=observation,
            action=action,
            reward=reward,
            success=success,
            vehicle=vehicle,
            reference=reference,
            period=period,
        )
        self._plan = make_task(
            benchmark,
            options,
            settings=settings or {},
            data_path=tuple(data_path),
            scene=scene,
        )
        self.render_mode = render_mode
        self.metadata = {
            **type(self).metadata,
            "render_fps": max(1, round(1.0 / environment_of(self._plan).period)),
        }
        self._page_stack = ExitStack()
        self._page: LiveSession | None = None
        self._stepper = make_stepper(self._plan, stepper, renders=render_mode is not None)
        self._begin_info: dict[str, Any] = {}
        self._is_over, self._is_closed = True, False
        self.layout = self._stepper.layout
        """The name and the size of each part of the observation, in order."""
        size = sum(n for _, n in self.layout)
        self.observation_space = observation_space(size, self._stepper.images)
        self.action_space = Box(-1.0, 1.0, (self._stepper.n_actions,), np.float32)
        self._frames = FrameSource(self._plan.scene, camera, frame_size)
        self._real_time_factor = real_time_factor

    @property
    def max_steps(self) -> int:
        """The number of steps of an episode that nothing ends before its time is over."""
        return max_steps_of(self._plan)

    @property
    def stepper(self) -> str:
        """The stepper of the environment, and the reason for it."""
        return self._stepper.statement

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode.

        Args:
            seed: the seed of the episode, that of ``uwsim bench --seed``; None: the environment
                draws one.
            options: ``{"level": {...}}`` with a value or a range for each swept parameter, or for
                the path of a number of the scene; other swept parameters are drawn from the
                levels of the benchmark.

        Returns:
            The observation, and ``info`` with ``seed``, ``level`` and ``variations``.
        """
        updater, has_paths = self._plan.benchmark.scene_updater, self._stepper.has_paths
        choices = read_choices(updater, options, has_paths=has_paths)
        super().reset(seed=seed)
        episode_seed = int(self.np_random.integers(MAX_SEED)) if seed is None else seed
        self._is_over = True  # until the new episode has begun
        self._open_page()
        draws = self._stepper.begin(episode_seed, choices, self._page)
        self._begin_info = {"seed": episode_seed, **draws}
        self._is_over = False
        return self._stepper.observe(), self._info()

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Apply an action for one period, or until the episode ends."""
        if self._is_over:
            raise gymnasium.error.ResetNeeded("No episode is running; call reset() first.")
        values = read_action_values(action, self.action_space.shape)
        reward, is_terminated, is_truncated = self._stepper.step(values)
        info = self._info()
        self._is_over = is_terminated or is_truncated
        if self._is_over:
            info |= self._stepper.results()
        return self._stepper.observe(), reward, is_terminated, is_truncated, info

    def render(self) -> Frame | None:
        """Return the present image, (h, w, 3), in the mode ``rgb_array``; otherwise None.

        In the mode ``human``, the steps themselves are shown.
        """
        if self.render_mode != "rgb_array" or self._is_closed:
            return None
        return self._stepper.draw(self._frames)

    def close(self) -> None:
        """Close the scene, its renderer and the page."""
        self._is_over = self._is_closed = True
        self._stepper.close()
        self._page_stack.close()
        self._page = None

    def _open_page(self) -> None:
        """Open the page of the mode ``human``, unless it is open, and print its address."""
        if self.render_mode != "human" or self._page is not None:
            return
        from ..viewer.live.open_session import open_session

        self._page = self._page_stack.enter_context(
            open_session(
                Path(self._plan.benchmark.path).stem, report=_print, speed=self._real_time_factor
            )
        )

    def _info(self) -> dict[str, Any]:
        """Return the seed, the level and the variations of the episode."""
        info = self._begin_info
        return info | {"level": dict(info["level"]), "variations": dict(info["variations"])}


def _print(line: str) -> None:
    """Print a line for the user on standard error."""
    print(line, file=sys.stderr, flush=True)
