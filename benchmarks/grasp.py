"""Measure the real-time factor of an episode of `grasp`, with its camera in the loop.

One seed at fog 0 without current, run in this process as a worker runs it. The software rasteriser
has no threads of its own, so that the CPU time is that of one core. The episode lasts from the
start of its level to its end; the whole trial includes the start of the scene. A first trial fills
the caches. The output is one JSON object.
"""

from __future__ import annotations

import os
import time
from statistics import median

from measure import main

from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.planning.trial_cache import TrialCache
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute
from uwsim.runs.trial.trial_observer import TrialObserver

TIMES_REAL_TIME = 8.0
REPEATS = 3
SEED = 0


class LevelClock(TrialObserver):
    """An observer that measures the CPU time of the level."""

    def __init__(self) -> None:
        self.start = self.end = 0.0  # [s]

    def open(self, *_: object) -> None:
        """Do nothing."""

    def begin_level(self, *_: object) -> None:
        """Store the CPU time at the start."""
        self.start = time.process_time()

    def end_level(self, *_: object) -> None:
        """Store the CPU time at the end."""
        self.end = time.process_time()

    def pilot(self) -> None:
        """Return no pilot."""

    def close(self) -> None:
        """Do nothing."""


def measure() -> dict[str, object]:
    """Run the episode several times."""
    os.environ["LP_NUM_THREADS"] = "0"  # of the rasteriser, which the first image creates
    level = [("fog", 0.0), ("current", 0.0)]
    plan = make_plan(PlanRequest(benchmark="grasp", seed=SEED, levels=level))
    [trial] = plan.trials()
    cache = TrialCache()
    episode_times, trial_times, rows = [], [], []
    for _ in range(REPEATS + 1):
        clock, start = LevelClock(), time.process_time()
        records = [*execute(plan, trial, cache=cache, observer=clock)]
        trial_times.append(time.process_time() - start)
        episode_times.append(clock.end - clock.start)
        rows += [record for record in records if isinstance(record, LevelRow)]
    cpu_s, trial_s = median(episode_times[1:]), median(trial_times[1:])
    simulated_s = rows[0].duration
    return {
        "episode: times real time": {
            "value": round(simulated_s / cpu_s, 2),
            "target": TIMES_REAL_TIME,
            "ratio": round(TIMES_REAL_TIME * cpu_s / simulated_s, 3),
        },
        "episode: cpu_s": [round(seconds, 2) for seconds in episode_times[1:]],
        "episode: simulated_s": simulated_s,
        "trial: cpu_s": round(trial_s, 2),
        "status": rows[0].status,
        "same rows": len({repr((row.total, row.logs, row.fingerprint)) for row in rows}) == 1,
    }


if __name__ == "__main__":
    main(measure)
