"""Damage files at random, and check that each error is one clean line.

    scripts/fuzz results --trials 5000 --seed 1

The target and the seed of a trial repeat it.
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

MAX_CPU_TIME = 5.0
"""The largest CPU time of a trial [s]."""
MAX_MEMORY_GROWTH = 200
"""The largest growth of the process in a trial [MB]."""


def fuzz_results(trials: int, seed: int) -> Counter[str]:
    """Damage results, and read them as `report`, `compare`, `verify` and `bench --resume`."""
    from tests.support.fuzzed_results import TARGETS, make_intact_result, trial

    error_counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="uwsim-fuzz-") as folder:
        intact_result = make_intact_result(Path(folder))
        for number in range(seed, seed + trials):
            for target in TARGETS:
                error = trial(intact_result, target, number)
                if error is not None:
                    print(f"results, {target}, seed {number}: {error}"[:300], flush=True)
                    error_counts[f"{target}: {error.partition(':')[0]}"] += 1
    return error_counts


def fuzz_obj(trials: int, seed: int) -> Counter[str]:
    """Damage OBJ files and their materials, and read them."""
    from tests.support.fuzzed_obj import trial

    error_counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="uwsim-fuzz-") as folder:
        for number in range(seed, seed + trials):
            error = trial(Path(folder), number)
            if error is not None:
                print(f"obj, seed {number}: {error}"[:300], flush=True)
                error_counts[error.partition(":")[0]] += 1
    return error_counts


def fuzz_files(target: str, trials: int, seed: int) -> Counter[str]:
    """Damage files of a scene or a benchmark, and read them within limits of time and memory."""
    from tests.support.fuzzed_files import trial

    error_counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="uwsim-fuzz-") as folder:
        for number in range(seed, seed + trials):
            start_time, peak = (
                time.process_time(),
                resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
            )
            error = trial(Path(folder), target, number)
            cpu_time = time.process_time() - start_time
            memory_growth = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak) >> 10
            if error is None and number > seed:  # the first trial imports the readers
                error = f"slow: {cpu_time:.1f} s" if cpu_time > MAX_CPU_TIME else None
                error = error or (
                    f"large: {memory_growth} MB more" if memory_growth > MAX_MEMORY_GROWTH else None
                )
            if error is not None:
                print(f"{target}, seed {number}: {error}"[:300], flush=True)
                error_counts[error.partition(":")[0]] += 1
    return error_counts


FUZZERS = {
    "obj": fuzz_obj,
    "results": fuzz_results,
    **{
        target: functools.partial(fuzz_files, target)
        for target in ("benchmark", "current", "expression", "image", "mesh", "robot", "scene")
    },
}
"""The function that fuzzes each target; it returns the number of each error."""


def main() -> int:
    """Run the trials; return 1 if any failed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("what", choices=FUZZERS, help="target to damage")
    parser.add_argument("--trials", type=int, default=1000, help="number of trials for each reader")
    parser.add_argument("--seed", type=int, default=1, help="seed of the first trial")
    options = parser.parse_args()
    error_counts = FUZZERS[options.what](options.trials, options.seed)
    for error, n in error_counts.most_common():
        print(f"{n:6} {error}")
    n_errors = sum(error_counts.values())
    print(f"{options.what}: {n_errors} errors in {options.trials} trials of each reader")
    return 1 if error_counts else 0


if __name__ == "__main__":
    sys.exit(main())
