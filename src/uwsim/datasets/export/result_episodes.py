"""Episodes of a result: its levels are run again, and their steps are kept.

A result has the measures of its levels, not their steps. Its inputs, seeds and algorithm are
recorded, so that the same levels run again to the bit. The steps are those of the benchmark's
``<u:environment>``: an observation, the action of the policy and the reward every ``<period>``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from ...benchmark.updaters import Level
from ...envs.episode import Episode as RunningEpisode
from ...errors import BadSetting, ResultError
from ...runs.planning.plan import Plan, Trial
from ...runs.planning.trial_cache import TrialCache
from .steps import Episode, Outcome


def run_episodes(
    plan: Plan,
    trials: Sequence[Trial],
    totals: Sequence[float | None],
    on_level: Callable[[], None],
) -> Iterator[Episode]:
    """Run the levels of trials again, and yield the steps of each.

    Args:
        plan: the plan of the result.
        trials: its trials.
        totals: the stored total of each level, in the order of trials and levels.
        on_level: a function that is called after each level.

    Raises:
        BadSetting: the benchmark has no environment or several, or observes images; its levels
            follow each other in one trial; or the algorithm is no policy.
        ResultError: a level has another total than the stored one.
    """
    if plan.benchmark.environment is None:
        raise BadSetting(
            f"{plan.benchmark.path}: the benchmark has no <u:environment>, so its result has no "
            "steps; expected --csv, or a recording (uwsim bench --record)."
        )
    if len(plan.benchmark.environments) > 1:
        raise BadSetting(
            f"{plan.benchmark.path}: has environments of {len(plan.benchmark.environments)} "
            "vehicles; expected a benchmark with one <u:environment>."
        )
    if plan.benchmark.environment.image:
        raise BadSetting(
            f"{plan.benchmark.path}: the environment observes images; expected a vector. "
            "Images are exported from recordings (uwsim bench --record)."
        )
    levels = [(trial, level) for trial in trials for level in trial.levels]
    if not all(trial.is_independent for trial in trials):
        raise BadSetting(
            f"{plan.benchmark.path}: its levels follow each other in one trial; expected a result "
            "of uwsim bench --mode independent."
        )
    cache = TrialCache()
    try:
        for (trial, level), total in zip(levels, totals, strict=True):
            yield run_episode(plan, trial.seed, level, total, cache)
            on_level()
    finally:
        cache.close()


def run_episode(
    plan: Plan, seed: int, level: Level, total: float | None, cache: TrialCache
) -> Episode:
    """Run a level with the algorithm of its plan; return its steps."""
    spec = plan.benchmark.environment
    assert spec is not None
    episode = RunningEpisode(plan, seed, level, cache)
    try:
        observations, actions, rewards = episode.observe(), [], []
        while episode.row is None:
            rewards += episode.follow()
            actions.append(episode.last_actions[0].copy())
            observations += episode.observe()
        if not episode.has_acted:
            raise BadSetting(
                f"{plan.algorithm.name}: publishes no actions of the environment; expected the "
                "result of a policy, such as --algorithm policy.py:Policy."
            )
        if episode.row.total != total:
            raise ResultError(
                f"Seed {seed}, {level}: the total is {episode.row.total}, and {total} in the "
                "result. Compare them with: uwsim verify."
            )
        vectors = np.array(observations, dtype=np.float64)
        return Episode(
            rate=1.0 / spec.period,
            times=np.arange(len(actions), dtype=np.float64) * spec.period,
            observations=vectors[:-1],
            observation_names=_number_names(episode.layouts[0]),
            actions=np.array(actions),
            action_names=_number_names(episode.action_layouts[0]),
            outcome=Outcome(
                rewards=np.array(rewards),
                final_observation=vectors[-1],
                is_terminated=not episode.is_truncated,
                is_success=episode.is_success(),
            ),
        )
    finally:
        episode.close()


def _number_names(layout: Sequence[tuple[str, int]]) -> tuple[str, ...]:
    """Return a name for each number of a vector, as ``heading.0``."""
    return tuple(f"{name}.{index}" for name, size in layout for index in range(size))
