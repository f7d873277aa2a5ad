"""An episode of `grasp`: how many times faster than real time, with its camera in the loop.

One seed at fog 0 without current, run in this process as a worker runs it: the software rasteriser
has no threads of its own, so that CPU time is that of one core. The episode is what is measured of
it, from the beginning of its level to its end; beside it the whole trial, with making the scene
live. A first trial warms the caches. One JSON on stdout.
"""

from __future__ import annotations

import os
import time
from statistics import median

from measure import main
from uwsim.runs.trial.onlooker import Onlooker

from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.planning.trial_cache import TrialCache
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute

TIMES_REAL_TIME = 8.0
REPEATS = 3
SEED = 0


class Clock(Onlooker):
    """Takes the CPU time of the level."""

    def __init__(self) -> None:
        self.began = self.ended = 0.0

    def open(self, *_: object) -> None:
        """Nothing to be seen."""

    def begin_level(self, *_: object) -> None:
        """The level is measured from now on."""
        self.began = time.process_time()

    def end_level(self, *_: object) -> None:
        """The level is over."""
        self.ended = time.process_time()

    def pilot(self) -> None:
        """Nobody pilots."""

    def close(self) -> None:
        """Nothing to be closed."""


def measure() -> dict[str, object]:
    """Run the episode several times."""
    os.environ["LP_NUM_THREADS"] = "0"  # of the rasteriser, which is made with the first image
    level = [("fog", 0.0), ("current", 0.0)]
    plan = make_plan(PlanRequest(benchmark="grasp", seed=SEED, levels=level))
    [trial] = plan.trials()
    cache = TrialCache()
    episodes, whole, rows = [], [], []
    for _ in range(REPEATS + 1):
        clock, began = Clock(), time.process_time()
        found = [*execute(plan, trial, cache=cache, observer=clock)]
        whole.append(time.process_time() - began)
        episodes.append(clock.ended - clock.began)
        rows += [row for row in found if isinstance(row, LevelRow)]
    cpu_s, trial_s, simulated_s = median(episodes[1:]), median(whole[1:]), rows[0].duration
    return {
        "episode: times real time": {
            "value": round(simulated_s / cpu_s, 2),
            "target": TIMES_REAL_TIME,
            "ratio": round(TIMES_REAL_TIME * cpu_s / simulated_s, 3),
        },
        "episode: cpu_s": [round(each, 2) for each in episodes[1:]],
        "episode: simulated_s": simulated_s,
        "trial: cpu_s": round(trial_s, 2),
        "status": rows[0].status,
        "same rows": len({repr((row.total, row.logs, row.fingerprint)) for row in rows}) == 1,
    }


if __name__ == "__main__":
    main(measure)
