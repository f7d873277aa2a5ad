"""An episode: a trial of a benchmark that pauses whenever an observation is due.

The steps are those of ``uwsim bench``, so that the measures at the end of an episode are those of a
level with the same seed, level and actions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import Any, NoReturn

from ..base.expression import parse
from ..base.geometry import Array
from ..benchmark.environment import EnvironmentSpec, RewardFunction
from ..benchmark.measures import find_outcome_spec
from ..benchmark.measures.outcome import MISSED_STATUS
from ..benchmark.spec import MAX_TASK_DURATION
from ..benchmark.updaters import Level, interval
from ..errors import BadSetting
from ..messages.observation import Observation
from ..runs.planning.plan import Plan
from ..runs.planning.trial_cache import TrialCache
from ..runs.trial.level_row import LevelRow, TrialEnd
from ..runs.trial.trial import open_trial
from ..runs.trial.trial_observer import TrialObserver
from ..simulation import Simulation
from ..world import ImageView
from .task import trial_of


class Episode:
    """A running episode of one or more agents, which begins with the first observation.

    The agents are the vehicles with an ``<u:environment>``, in the order of the file.

    Args:
        plan: the plan of the environment.
        seed: the seed of every random stream.
        level: the level of the benchmark.
        cache: the compiled scenes.
        observer: the observer that shows the episode; None: none.
    """

    def __init__(
        self,
        plan: Plan,
        seed: int,
        level: Level,
        cache: TrialCache,
        observer: TrialObserver | None = None,
    ) -> None:
        self._plan, self._stack = plan, ExitStack()
        self.row: LevelRow | None = None
        """The result of the level, when it has ended."""
        trial = trial_of(seed, level)
        try:
            trial_context = open_trial(plan, trial, cache=cache, observer=observer)
            execution = self._stack.enter_context(trial_context)
            self._execution, self._channels = execution, execution.channels
            self._rows = execution.rows()
            self._rewards = [
                RewardFunction(
                    channel.spec.reward,
                    channel.spec.sample_names(plan.benchmark.measures),
                    channel.state(),
                )
                for channel in self._channels
            ]
            self._advance()
        except BaseException:
            self._stack.close()
            raise

    def __reduce__(self) -> NoReturn:
        """Refuse a copy, as of ``copy.deepcopy``: the engine's state is shared with the trial."""
        raise TypeError(
            "A running environment cannot be copied or pickled; make another one with the same "
            "arguments, and reset it with the same seed."
        )

    @property
    def simulation(self) -> Simulation:
        """The simulation."""
        return self._execution.simulation

    @property
    def layouts(self) -> list[tuple[tuple[str, int], ...]]:
        """The name and the size of each part of the observation of each agent."""
        return [channel.observer.layout for channel in self._channels]

    @property
    def action_layouts(self) -> list[tuple[tuple[str, int], ...]]:
        """The topic and the number of commands of each part of an action of each agent."""
        return [channel.actuator.layout for channel in self._channels]

    @property
    def has_acted(self) -> bool:
        """True if an action of each agent was applied."""
        return all(channel.has_acted for channel in self._channels)

    @property
    def last_actions(self) -> list[Array]:
        """The last action of each agent that was applied, (n,); 0 before the first."""
        return [channel.last_action for channel in self._channels]

    @property
    def n_actions(self) -> list[int]:
        """The number of numbers of an action of each agent."""
        return [channel.actuator.size for channel in self._channels]

    @property
    def images(self) -> list[Mapping[str, ImageView]]:
        """The observed images of each agent by name."""
        return [channel.images for channel in self._channels]

    def observe(self) -> list[Observation]:
        """Return the present observation of each agent; images are taken anew by each call."""
        return [channel.take_observation() for channel in self._channels]

    def step(self, actions: Sequence[Array]) -> list[float]:
        """Apply an action of each agent until the next observation is due; return the rewards.

        At the end of the level, `row` is set.
        """
        for channel, action in zip(self._channels, actions, strict=True):
            channel.set_action(action)
        return self.follow()

    def follow(self) -> list[float]:
        """Run the plan's algorithm until the next observation is due; return the rewards."""
        last_actions = self.last_actions
        measures = {m.spec.name: m.measure for m in self._execution.active_measures}
        self._advance()
        measures |= {m.spec.name: m.measure for m in self._execution.active_measures}
        return [
            reward.compute(
                measures,
                channel.observer.read_relations(),
                channel.observer.state(last_action),
                channel.last_action,
            )
            for channel, reward, last_action in zip(
                self._channels, self._rewards, last_actions, strict=True
            )
        ]

    def _advance(self) -> None:
        """Take steps until an observation is due, or the level has ended."""
        for channel in self._channels:
            channel.is_due = channel.is_due and self.simulation.step == 0
        for row in self._rows:
            if isinstance(row, LevelRow):
                self.row = row
                return
            if row is None and self._channels[0].is_due:
                return

    @property
    def is_truncated(self) -> bool:
        """True if the time of the level is over; an episode that ends earlier is terminated."""
        length = interval(self._plan.benchmark.scene_updater)
        timestep = self._plan.timestep
        return (
            self.row is not None
            and length is not None
            and self.row.duration >= round(length / timestep) * timestep - timestep / 2.0
        )

    def is_success(self, agent: int = 0) -> bool:
        """Return whether the level has ended with the status ``ok`` and an agent's success.

        A success of the environment replaces that of a ``<u:outcome>``, but not its failures.
        """
        criterion = self._channels[agent].spec.success
        if self.row is None or self.row.status not in self._good_statuses(criterion):
            return False
        if criterion is None:
            return True
        values = {name: value for name, (value, _) in self.row.measures.items()}
        result = parse(criterion, list(values)).evaluate(values)
        return result is not None and result != 0.0

    def _good_statuses(self, criterion: str | None) -> tuple[str, ...]:
        has_outcome = find_outcome_spec(self._plan.benchmark.measures) is not None
        return ("ok",) if criterion is None or not has_outcome else ("ok", MISSED_STATUS)

    def result(self, agent: int = 0) -> dict[str, Any]:
        """Return the result of the level for ``info``; empty before its end."""
        if self.row is None:
            return {}
        is_success = self.is_success(agent)
        return {
            "measures": {name: _number(value) for name, (value, _) in self.row.measures.items()},
            "score": _number(self.row.total),
            "status": self.row.status,
            "is_success": is_success,
            "success": is_success,
        }

    def finish(self) -> TrialEnd | None:
        """Take the end of the trial, and close the scene."""
        end = None
        if self.row is not None:
            end = next((item for item in self._rows if isinstance(item, TrialEnd)), None)
        self.close()
        return end

    def close(self) -> None:
        """Close the scene."""
        self._stack.close()


def _number(value: float | None) -> float:
    """Return a value as a number; NaN if there is none."""
    return float("nan") if value is None else float(value)


def environment_of(plan: Plan) -> EnvironmentSpec:
    """Return the environment of a plan.

    Raises:
        BadSetting: the benchmark has none.
    """
    if plan.benchmark.environment is None:
        raise BadSetting(f"{plan.benchmark.path}: the benchmark has no <u:environment>.")
    return plan.benchmark.environment


def max_steps_of(plan: Plan) -> int:
    """Return the number of steps of an episode that nothing ends before its time is over."""
    length = interval(plan.benchmark.scene_updater) or MAX_TASK_DURATION
    return max(1, round(length / environment_of(plan).period))
