"""Damage files by chance and see that every error is one clean line.

    scripts/fuzz results --trials 5000 --seed 1

Each trial is known by its target and its seed; what went wrong can be repeated with them.
"""

from __future__ import annotations

import argparse
import functools
import resource
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

SLOW = 5.0
"""A trial that takes longer is told [s of the processor]."""
LARGE = 200
"""A trial that makes the process grow by more is told [MB]."""


def results(trials: int, seed: int) -> Counter[str]:
    """Results that `report`, `compare`, `verify` and `bench --resume` read."""
    from tests.support.fuzzed_results import TARGETS, made, trial

    wrong: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="uwsim-fuzz-") as folder:
        sound = made(Path(folder))
        for number in range(seed, seed + trials):
            for target in TARGETS:
                said = trial(sound, target, number)
                if said is not None:
                    print(f"results, {target}, seed {number}: {said}"[:300], flush=True)
                    wrong[f"{target}: {said.partition(':')[0]}"] += 1
    return wrong


def obj(trials: int, seed: int) -> Counter[str]:
    """OBJ files and their materials, that models are read from."""
    from tests.support.fuzzed_obj import trial

    wrong: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="uwsim-fuzz-") as folder:
        for number in range(seed, seed + trials):
            said = trial(Path(folder), number)
            if said is not None:
                print(f"obj, seed {number}: {said}"[:300], flush=True)
                wrong[said.partition(":")[0]] += 1
    return wrong


def files(target: str, trials: int, seed: int) -> Counter[str]:
    """Files that a scene or a benchmark is made of; each within a bound of time and memory."""
    from tests.support.fuzzed_files import trial

    wrong: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="uwsim-fuzz-") as folder:
        for number in range(seed, seed + trials):
            before, peak = time.process_time(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            said = trial(Path(folder), target, number)
            took = time.process_time() - before
            grew = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak) >> 10
            if said is None and number > seed:  # the first loads all that reading takes
                said = f"slow: {took:.1f} s" if took > SLOW else None
                said = said or (f"large: {grew} MB more" if grew > LARGE else None)
            if said is not None:
                print(f"{target}, seed {number}: {said}"[:300], flush=True)
                wrong[said.partition(":")[0]] += 1
    return wrong


WHAT = {
    "obj": obj,
    "results": results,
    **{
        target: functools.partial(files, target)
        for target in ("benchmark", "current", "expression", "image", "mesh", "robot", "scene")
    },
}
"""What can be damaged -> how many trials from which seed on; returns what went wrong, counted."""


def main() -> int:
    """Run the trials; returns 1 if any went wrong."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("what", choices=WHAT, help="what is damaged")
    parser.add_argument("--trials", type=int, default=1000, help="how many for each reader")
    parser.add_argument("--seed", type=int, default=1, help="seed of the first trial")
    options = parser.parse_args()
    wrong = WHAT[options.what](options.trials, options.seed)
    for what, n in wrong.most_common():
        print(f"{n:6} {what}")
    print(f"{options.what}: {sum(wrong.values())} wrong in {options.trials} trials of each reader")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
