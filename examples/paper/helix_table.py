"""Prints the table of the helix in docs/reproductions.md, or the experiments on its differences.

python examples/paper/helix_table.py --seeds 10
python examples/paper/helix_table.py --experiments --seeds 3
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from table_program import make_parser, mean_text

import uwsim
from uwsim.results.log import load_log

POLICY = f"{Path(__file__).parents[1] / 'learning' / 'policy.py'}:TrainedHelix"
"""The trained policy of the learning environment ``uwsim/Helix-v0``."""
LITERATURE = {"SHAC": 0.099, "DroQ": 0.157, "PPO": 0.164, "MPC": 0.315}
"""The published errors of a real BlueROV2 Heavy [m]."""
ROWS = {"position-pi": "position-pi", "position-lqr": "position-lqr", "mpc": "mpc", "PPO": POLICY}
"""The algorithms, by title."""
SETTLED_TIME = 10.0
"""The time after which the vehicle has arrived at the helix [s]."""
BODY = "vehicle[bluerov2].hydrodynamics.body[base_link]."
EXPERIMENTS: Sequence[tuple[str, Mapping[str, float | str]]] = (
    ("commands 0.1 s late", {"algorithm.latency_s": 0.1}),
    ("commands 0.2 s late", {"algorithm.latency_s": 0.2}),
    ("commands 0.4 s late", {"algorithm.latency_s": 0.4}),
    (
        "drag 1.5 times that of the model",
        {f"{BODY}quadraticDamping.1": 211.5, f"{BODY}quadraticDamping.2": 325.5},
    ),
)
"""The title and the settings of each experiment."""


def measure(
    algorithm: str,
    n_seeds: int,
    *,
    settings: Mapping[str, float | str] | None = None,
    period: float = 20.0,
    current: float = 0.0,
) -> tuple[list[float], list[float]]:
    """Return the errors of the trials [m]: of the whole trials, and after `SETTLED_TIME`.

    Args:
        algorithm: the algorithm.
        n_seeds: the number of seeds.
        settings: the settings of scene and algorithm.
        period: the time of a turn of the helix [s].
        current: the speed of the water [m/s].
    """
    benchmark = uwsim.read_benchmark("helix")
    benchmark["offset"].trajectory.set(period=period, rise=0.02 * period)
    scene = uwsim.read_scene("open-water-scene")
    scene.add("ROSWrenchToPAT", topic="/bluerov2/wrench", vehicle_name="bluerov2")
    with tempfile.TemporaryDirectory() as folder:
        result = uwsim.bench(
            benchmark,
            scene=scene,
            algorithm=algorithm,
            seeds=range(n_seeds),
            levels={"current": [current]},
            settings=settings,
            workers=1,
            out=Path(folder) / "result",
        )
        log = load_log(Path(folder) / "result" / "measure-offset.csv")
    names = [name.partition(" [")[0] for name in log.header]
    time, distance = names.index("time"), names.index("total")
    seed = names.index("seed") if "seed" in names else None
    squares: dict[object, list[float]] = {}
    for sample in log.samples:
        key = None if seed is None else sample[seed]
        if float(sample[time] or 0.0) >= SETTLED_TIME:
            squares.setdefault(key, []).append(float(sample[distance] or 0.0) ** 2)
    late_errors = [math.sqrt(math.fsum(part) / len(part)) for part in squares.values()]
    return [value for value in result.numbers("offset") if value is not None], late_errors


def main() -> None:
    """Run the algorithms, and print a row of a table for each."""
    options = make_parser(__doc__).parse_args()
    print("| | whole trial [m] | after 10 s [m] |", "|---|---|---|", sep="\n")
    if not options.experiments:
        for title, error in LITERATURE.items():
            print(f"| theirs, {title} | {error:g} | |")
        for title, algorithm in ROWS.items():
            print_row(title, measure(algorithm, options.seeds))
        return
    for name, algorithm in (("position-lqr", "position-lqr"), ("PPO", POLICY)):
        for title, settings in EXPERIMENTS:
            print_row(f"{name}, {title}", measure(algorithm, options.seeds, settings=settings))
        print_row(f"{name}, a turn in 10 s", measure(algorithm, options.seeds, period=10.0))
        print_row(f"{name}, a current of 0.1 m/s", measure(algorithm, options.seeds, current=0.1))


def print_row(title: str, columns: Sequence[Sequence[float]]) -> None:
    """Print a row: a title, and the mean of each column [m]."""
    cells = [mean_text(errors, 3) for errors in columns]
    print(f"| {title} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
