"""Prints the table of the square in docs/reproductions.md, or the experiments that explain it.

python examples/paper/square_table.py
python examples/paper/square_table.py --experiments --seeds 3
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from table_program import make_parser, mean_text

import uwsim

CONDITIONS = {
    "still water": (0.0, 0.0),
    "current": (0.0, 0.2),
    "current and waves": (0.75, 0.2),
}
"""The significant wave height [m] and the current [m/s] of each condition."""
LITERATURE = {
    "position-pi": ("PID", (17.8, 22.4, 58.1)),
    "mpc": ("MPC", (2.06, 3.37, 10.0)),
    "dob-mpc": ("DOB-MPC", (2.09, 2.03, 2.76)),
}
"""The published controller beside each of ours, and its errors in the conditions [cm]."""
PID = f"{Path(__file__).parent / 'square_pid.py'}:PublishedPid"
"""The PID controller with the published gains."""

BODY = "vehicle[bluerov2].hydrodynamics.body[base_link]."
LIGHT_VEHICLE: Mapping[str, float] = {
    f"{BODY}{name}.{axis}": value
    for name, values in {
        "linearDamping": (4.03, 6.22, 5.18),
        "quadraticDamping": (18.18, 21.66, 36.99),
        "addedMass": (5.5, 12.7, 14.57),
    }.items()
    for axis, value in enumerate(values, 1)
} | {f"{BODY}mass": 11.2, f"{BODY}volume": 0.0111}
"""The published vehicle: mass, drag and added mass; a weight in water of 0.98 N, as of ours."""
LIGHT_MODEL = {
    "algorithm.mass": "16.7 23.9 25.77",
    "algorithm.linear_drag": "4.03 6.22 5.18",
    "algorithm.quadratic_drag": "18.18 21.66 36.99",
}
"""The same numbers in the models of the controllers."""
PUBLISHED_WEIGHTS = {"algorithm.force_weight": 0.26, "algorithm.change_weight": 0.0}
"""The published ratio of the weights of force and distance, 0.05 N^-2 to 300 m^-2, for 20 kg."""
EXPERIMENTS: Sequence[tuple[str, str, Mapping[str, float | str]]] = (
    ("PID of the published gains, our vehicle", PID, {}),
    ("the same, published vehicle", PID, LIGHT_VEHICLE),
    ("the same, turning into the path", PID, {**LIGHT_VEHICLE, "algorithm.follows": 1.0}),
    ("mpc, published weights, our vehicle", "mpc", PUBLISHED_WEIGHTS),
    ("mpc, our weights, published vehicle", "mpc", {**LIGHT_VEHICLE, **LIGHT_MODEL}),
    (
        "mpc, published weights and vehicle",
        "mpc",
        {**LIGHT_VEHICLE, **LIGHT_MODEL, **PUBLISHED_WEIGHTS},
    ),
    (
        "dob-mpc, published weights and vehicle",
        "dob-mpc",
        {**LIGHT_VEHICLE, **LIGHT_MODEL, **PUBLISHED_WEIGHTS},
    ),
)
"""The title, the algorithm and the settings of each experiment."""


def measure(algorithm: str, settings: Mapping[str, float | str], n_seeds: int) -> list[str]:
    """Return the errors of a controller in the conditions [cm], with 95 % intervals over seeds."""
    heights, currents = zip(*CONDITIONS.values(), strict=True)
    result = uwsim.bench(
        "square",
        algorithm=algorithm,
        seeds=range(n_seeds),
        levels={"waveHeight": sorted(set(heights)), "current": sorted(set(currents))},
        settings=settings,
        workers=1,
    )
    columns = (result.numbers(name) for name in ("waveHeight", "current", "offset"))
    errors: dict[tuple[float | None, ...], list[float]] = {}
    for height, current, offset in zip(*columns, strict=True):
        if offset is not None:
            errors.setdefault((height, current), []).append(100.0 * offset)
    return [mean_text(errors[condition], 2) for condition in CONDITIONS.values()]


def main() -> None:
    """Run the controllers, and print a row of a table for each."""
    options = make_parser(__doc__).parse_args()
    print(f"| | {' | '.join(CONDITIONS)} |", f"|---{'|---' * len(CONDITIONS)}|", sep="\n")
    if options.experiments:
        for title, algorithm, settings in EXPERIMENTS:
            cells = measure(algorithm, settings, options.seeds)
            print(f"| {title} | {' | '.join(cells)} |", flush=True)
        return
    for algorithm, (name, published_errors) in LITERATURE.items():
        pairs = zip(published_errors, measure(algorithm, {}, options.seeds), strict=True)
        cells = [f"{literature_error:g}; {error}" for literature_error, error in pairs]
        print(f"| {name}; `{algorithm}` | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
