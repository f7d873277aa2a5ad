"""A campaign: the start of a shard, the overhead of the engine, and the merge of 10 000 rows.

Run ``python benchmarks/campaign.py``. Times are CPU times of processes without their children.
*Start*: a shard without a trial, as the command. *Overhead*: what a shard with levels of `currents`
of 120 s does beside their simulation (`run_trial`), in percent of it. *Merge*: of 10 000 finished
trials of one row each, copies of one trial; with its start, without plots and report.
"""

from __future__ import annotations

import json
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

from measure import main, upper_target_figure

from uwsim.runs.executors import executor
from uwsim.runs.executors.executor import run_each
from uwsim.runs.executors.worker import Event, run_trial
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import prepare_run
from uwsim.runs.run import Run

START_S, OVERHEAD_PERCENT, MERGE_S = 3.0, 2.0, 5.0
N_STARTS = 5
N_TRIALS = 2
"""The number of trials whose overhead is measured."""
N_LEVELS, N_REPEATS = 4, 2500
BENCHMARK = f"""<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml"
    u:algorithm="nothing">
  <measures>
    <time> <name>taskTime</name> </time>
    <distance> <name>path</name> <target>girona500</target> <log>0.05</log> </distance>
  </measures>
  <startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
  <function>taskTime</function>
  <sceneUpdater>
    <repeat> <iterations>{N_LEVELS}</iterations> <interval>0.1</interval> </repeat>
  </sceneUpdater>
</benchmark>
"""


def command_seconds(*words: str) -> float:
    """Return the CPU time of a command of uwsim [s]."""
    start = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-m", "uwsim", *words], check=True, stdout=subprocess.DEVNULL)
    end = resource.getrusage(resource.RUSAGE_CHILDREN)
    return end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime


def measure_start(folder: Path) -> float:
    """Return the median CPU time of a shard without a trial [s]."""
    words = ["bench", "currents", "--algorithm", "p", "--level", "current=0"]
    words += ["--mode", "independent", "--shard", "9/9", "--out", str(folder / "start.result")]
    command_seconds(*words)
    return median(command_seconds(*words) for _ in range(N_STARTS))


def measure_overhead(folder: Path) -> tuple[float, float]:
    """Return the CPU time of the trials of a shard, in all and in their simulation [s]."""
    request = PlanRequest(
        benchmark="currents", algorithm="p", repeat=N_TRIALS + 1, levels=[("current", 0.0)]
    )
    run = prepare_run(make_plan(request), folder / "overhead.result")
    simulation_s = 0.0

    def timed_trial(*arguments: Any) -> Iterator[Event]:
        nonlocal simulation_s
        start = time.process_time()
        for event in run_trial(*arguments):
            simulation_s += time.process_time() - start
            yield event
            start = time.process_time()
        simulation_s += time.process_time() - start

    with patch.object(executor, "run_trial", timed_trial):
        run_each([replace(run, chosen_trials=frozenset({0}))])  # warms up
        simulation_s = 0.0
        start = time.process_time()
        for number in range(1, N_TRIALS + 1):
            run_each([replace(run, chosen_trials=frozenset({number}))])
        return time.process_time() - start, simulation_s


def write_campaign(folder: Path) -> Path:
    """Write 10 000 finished trials, copies of one with their own heads; return their folder."""
    benchmark = folder / "blind.xml"
    benchmark.write_text(BENCHMARK)
    request = PlanRequest(benchmark=str(benchmark), repeat=N_REPEATS, mode="independent")
    run = prepare_run(make_plan(request), folder / "merge.result")
    run_each([replace(run, chosen_trials=frozenset({0}))])
    copy_trials(run)
    return run.out


def copy_trials(run: Run) -> None:
    """Write the journal and track of each trial of a run as a copy of those of the first."""
    first = run.out / "units" / "00000.jsonl"
    head, row, end = map(json.loads, first.read_text().splitlines())
    for trial in run.trials()[1:]:
        (level,) = trial.values
        head["unit"].update(seed=trial.seed, levels=[list(level)])
        row["row"]["values"] = list(level)
        path = first.with_name(f"{trial.index:05d}.jsonl")
        lines = (json.dumps(record, separators=(",", ":")) for record in (head, row, end))
        path.write_text("".join(f"{line}\n" for line in lines))
        shutil.copy(first.with_suffix(".motion"), path.with_suffix(".motion"))


def measure() -> dict[str, object]:
    """Measure the three targets."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        start = measure_start(folder)
        total, simulation = measure_overhead(folder)
        merge = command_seconds("merge", str(write_campaign(folder)), "--no-report")
    return {
        "start of a shard [s]": upper_target_figure(start, START_S),
        "overhead of the engine [%]": {
            **upper_target_figure(100.0 * (total / simulation - 1.0), OVERHEAD_PERCENT),
            "total_s": round(total, 3),
            "simulation_s": round(simulation, 3),
        },
        "merge of 10 000 rows [s]": upper_target_figure(merge, MERGE_S),
    }


if __name__ == "__main__":
    main(measure)
