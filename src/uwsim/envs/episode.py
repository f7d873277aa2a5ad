"""An episode: a trial of a benchmark that pauses whenever an observation is due.

The steps are those of ``uwsim bench``, so that the measures at the end of an episode are those of a
level with the same seed, level and actions.
"""

from __future__ import annotations

from contextlib import ExitStack

from ..base.expression import parse
from ..base.geometry import Array
from ..benchmark.environment import EnvironmentSpec, RewardFunction
from ..benchmark.updaters import Level, interval
from ..errors import BadSetting
from ..runs.planning.plan import Plan
from ..runs.planning.trial_cache import TrialCache
from ..runs.trial.level_row import LevelRow, TrialEnd
from ..runs.trial.trial import open_trial
from ..simulation import Simulation
from .task import trial_of


class Episode:
    """A running episode, which begins with the first observation.

    Args:
        plan: the plan of the environment.
        seed: the seed of every random stream.
        level: the level of the benchmark.
        cache: the compiled scenes.
    """

    def __init__(self, plan: Plan, seed: int, level: Level, cache: TrialCache) -> None:
        self._plan, self._stack = plan, ExitStack()
        self.row: LevelRow | None = None
        """The result of the level, when it has ended."""
        trial = trial_of(seed, level)
        try:
            execution = self._stack.enter_context(open_trial(plan, trial, cache=cache))
            spec = plan.benchmark.environment
            assert spec is not None
            assert execution.channel is not None
            self._execution, self._channel = execution, execution.channel
            self._rows = execution.rows()
            names = [measure.name for measure in plan.benchmark.measures]
            self._reward = RewardFunction(spec.reward, names, self._channel.state())
            self._advance()
        except BaseException:
            self._stack.close()
            raise

    @property
    def simulation(self) -> Simulation:
        """The simulation."""
        return self._execution.simulation

    @property
    def layout(self) -> tuple[tuple[str, int], ...]:
        """The name and the size of each part of the observation."""
        return self._channel.observer.layout

    @property
    def n_actions(self) -> int:
        """The number of numbers of an action."""
        return self._channel.actuator.size

    def observe(self) -> Array:
        """Return the present observation."""
        return self._channel.take_observation()

    def step(self, action: Array) -> float:
        """Apply an action until the next observation is due; return the reward.

        At the end of the level, `row` is set.
        """
        last_action = self._channel.last_action
        self._channel.set_action(action)
        measures = {m.spec.name: m.measure for m in self._execution.active_measures}
        self._advance()
        measures |= {m.spec.name: m.measure for m in self._execution.active_measures}
        state = self._channel.observer.state(last_action)
        return self._reward.compute(measures, state, self._channel.last_action)

    def _advance(self) -> None:
        """Take steps until an observation is due, or the level has ended."""
        self._channel.is_due = self._channel.is_due and self.simulation.step == 0
        for row in self._rows:
            if isinstance(row, LevelRow):
                self.row = row
                return
            if row is None and self._channel.is_due:
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

    @property
    def is_success(self) -> bool:
        """True if the level has ended with the status ``ok`` and the criterion of success."""
        if self.row is None or self.row.status != "ok":
            return False
        spec = self._plan.benchmark.environment
        assert spec is not None
        if spec.success is None:
            return True
        values = {name: value for name, (value, _) in self.row.measures.items()}
        result = parse(spec.success, list(values)).evaluate(values)
        return result is not None and result != 0.0

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


def environment_of(plan: Plan) -> EnvironmentSpec:
    """Return the environment of a plan.

    Raises:
        BadSetting: the benchmark has none.
    """
    if plan.benchmark.environment is None:
        raise BadSetting(f"{plan.benchmark.path}: the benchmark has no <u:environment>.")
    return plan.benchmark.environment
