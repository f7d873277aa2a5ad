"""The command line that repeats the run of a result."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import resources
from pathlib import Path

from .inputs import Inputs
from .run_info import RunInfo


def bench_words(
    run: RunInfo, inputs: Inputs, *, algorithms: Sequence[str], repeats: int
) -> list[str]:
    """Return the words of ``uwsim bench ...``, without the output directory.

    Args:
        run: the description of the run of one of the algorithms.
        inputs: the inputs of that run.
        algorithms: the names of the algorithms under test; several are run together.
        repeats: the number of repeats.
    """
    words = ["uwsim", "bench", _benchmark(inputs)]
    for name in algorithms:
        words += ["--algorithm", name]
    words += ["--seed", str(run.seed or 0)]
    if repeats != 1:
        words += ["--repeat", str(repeats)]
    if run.mode:
        words += ["--mode", run.mode]
    for pair in run.pairs_of_settings:
        words += ["--set", pair]
    for pair in run.pairs_of_levels:
        words += ["--level", pair]
    if run.compatibility:
        words += ["--compat", ",".join(run.compatibility)]
    for name, _ in inputs.plugins or ():
        words += ["--plugin", name]
    return words


def _benchmark(inputs: Inputs) -> str:
    """Return the benchmark's file, or its bare name if it is bundled."""
    if inputs.benchmark is None:
        return "BENCHMARK"
    name = inputs.benchmark[0]
    folder = Path(str(resources.files("uwsim"))) / "data" / "benchmarks"
    return Path(name).stem if (folder / name).is_file() else name
