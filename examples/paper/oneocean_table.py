"""Prints the table of OneOcean in docs/reproductions.md, or the experiments that explain it.

python examples/paper/oneocean_table.py --seeds 10
python examples/paper/oneocean_table.py --experiments --seeds 5
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from oneocean_heuristic import Heuristic, HeuristicForce
from oneocean_model import Task, simulate
from table_program import make_parser, mean_text

import uwsim
from uwsim.statistics import rate

FOLDER = Path(__file__).parent
CURRENTS = (0.1, 0.2, 0.3)
"""The speeds of the water, unless ``--currents`` has others [m/s]."""
TASKS = {
    "station keeping": Task(count=1, length=0.0, radius=1.3, duration=560.0, hold=240.0, kp=0.8),
    "go to goal": Task(count=1, length=240.0, radius=1.3, duration=300.0),
    "route": Task(count=20, length=277.2, radius=1.6, duration=560.0),
    "go to goal, tier 2": Task(count=1, length=160.0, radius=4.0, duration=280.0),
    "route, tier 2": Task(count=12, length=227.7, radius=3.2, duration=460.0),
}
"""The tasks; without a tier in the name, they are those of tier 3."""
LITERATURE = {
    "station keeping": 1.07,
    "go to goal": 0.74,
    "route": 0.54,
    "go to goal, tier 2": 0.9,
    "route, tier 2": 0.9,
}
"""The published error [m], and the published shares of successes; those of tier 2 are read from a
figure, which has 0.7 and 0.3 for tier 3."""
N_MODEL_SEEDS = 50
"""The number of seeds of the published equations."""
BLUEROV2: Mapping[str, float | str] = {
    "vehicle[auv].file": "bluerov2_heavy.urdf",
    "vehicle[auv].dynamics": "bluerov2_heavy",
}
"""The settings that replace the published vehicle by a BlueROV2 Heavy."""
Results = dict[float, list[float]]
Rows = Sequence[tuple[str, type[Heuristic], Mapping[str, float | str]]]
VEHICLES: Rows = (
    ("their vehicle", HeuristicForce, {}),
    ("BlueROV2 Heavy", Heuristic, BLUEROV2),
)
"""The title, the algorithm and the settings of each row of the table."""
EXPERIMENTS: Rows = (
    ("their vehicle, a command each second", HeuristicForce, {"algorithm.period": 1.0}),
    ("their vehicle, as fast as commanded", HeuristicForce, {"algorithm.force_gain": 26.0}),
)
"""The same of each experiment."""


def make_benchmark(task: Task) -> uwsim.Benchmark:
    """Return the benchmark of a task, from that of "go to goal"."""
    benchmark = uwsim.read_benchmark(
        FOLDER / "oneocean.xml", plugins=[FOLDER / "oneocean_waypoints.py"]
    )
    benchmark["route"].set(count=task.count, length=task.length, radius=task.radius)
    benchmark.scene_updater.interval = task.hold or task.duration
    if task.is_station:
        benchmark["outcome"].set(success=f"route_max <= {task.radius}", ends="false")
    return benchmark


def measure(
    name: str,
    algorithm: type[Heuristic],
    settings: Mapping[str, float | str],
    *,
    n_seeds: int,
    currents: Sequence[float],
) -> Results:
    """Return the errors [m] or successes of the trials of a task, for each current [m/s]."""
    task = TASKS[name]
    result = uwsim.bench(
        make_benchmark(task),
        algorithm=algorithm,
        seeds=range(n_seeds),
        levels={"current": currents},
        settings={"algorithm.kp": task.kp, **settings},
        data_path=[FOLDER],
    )
    column = "route.rms" if task.is_station else "outcome"
    values: Results = {}
    for current, value in zip(result.numbers("current"), result.numbers(column), strict=True):
        values.setdefault(round(current or 0.0, 3), []).append(value or 0.0)
    return values


def measure_model(name: str, step: float, currents: Sequence[float]) -> Results:
    """Return the same of the published equations, in steps of a length [s]."""
    values: Results = {}
    for current in currents:
        for seed in range(N_MODEL_SEEDS):
            outcome = simulate(TASKS[name], seed=seed, current=current, step=step)
            value = outcome.error if TASKS[name].is_station else float(outcome.is_success)
            values.setdefault(current, []).append(value)
    return values


def print_row(title: str, name: str, values: Results) -> None:
    """Print a row: theirs; ours with its interval, and divided by theirs, for each current."""
    published_value = LITERATURE[name]
    is_error = TASKS[name].is_station
    cells = [f"{published_value:g} m" if is_error else f"{100.0 * published_value:.0f} %"]
    cells += [_format(numbers, published_value, is_error) for numbers in values.values()]
    print(f"| {name}; {title} | {' | '.join(cells)} |", flush=True)


def _format(values: Sequence[float], published_value: float, is_error: bool) -> str:
    if is_error:
        ratio = sum(values) / len(values) / published_value
        return f"{mean_text(values, 2)} m; {ratio:.2f}"
    share = rate(round(sum(values)), len(values))
    return (
        f"{100.0 * share.value:.0f} % [{100.0 * share.low:.0f}, {100.0 * share.high:.0f}]; "
        f"{share.value / published_value:.2f}"
    )


def main() -> None:
    """Run the tasks, and print a row of a table for each task and vehicle."""
    parser = make_parser(__doc__)
    parser.add_argument("--currents", type=float, nargs="+", default=CURRENTS, help="[m/s]")
    options = parser.parse_args()
    currents = options.currents
    headings = [f"{current:g} m/s" for current in currents]
    print(f"| | theirs | {' | '.join(headings)} |", f"|---|---{'|---' * len(headings)}|", sep="\n")
    if options.experiments:
        for step in (1.0, 0.1):
            for name in TASKS:
                title = f"their equations, steps of {step:g} s"
                print_row(title, name, measure_model(name, step, currents))
    rows = EXPERIMENTS if options.experiments else VEHICLES
    for title, algorithm, settings in rows:
        for name in [name for name in TASKS if not name.endswith("tier 2")]:
            values = measure(name, algorithm, settings, n_seeds=options.seeds, currents=currents)
            print_row(title, name, values)


if __name__ == "__main__":
    main()
