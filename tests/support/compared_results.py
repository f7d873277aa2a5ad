"""Results of a few levels and seeds with given values (no module under test)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from uwsim.analysis.comparison import Entry
from uwsim.results.inputs import Inputs
from uwsim.results.result import Cell, Column, MissingValue, Result
from uwsim.results.result_file import save
from uwsim.results.run_info import RunInfo

Values = Mapping[float, Sequence[float | None]]
"""The values at each fog, one for each seed; None: the tracker was lost."""

INPUTS = {
    "benchmark": ("visibility.xml", "sha256:" + "3f" * 32),
    "scene": ("visibility-scene.xml", "sha256:" + "a0" * 32),
    "assets": {"blackbox.osg": "sha256:" + "77" * 32, "girona500.urdf": "sha256:" + "78" * 32},
}


def make_result(algorithm: str, values: Values, *, seed: int = 0) -> Result:
    """Return a sweep of fog with seeds from ``seed`` on."""
    columns = (
        Column(name="repeat", kind="run"),
        Column(name="seed", kind="run"),
        Column(name="fog", kind="level", unit="1/m"),
        Column(name="corners", kind="measure", unit="px"),
        Column(name="total", kind="score", expression="corners"),
        Column(name="status", kind="status"),
        Column(name="ended_at", kind="time", unit="s"),
    )
    rows: list[tuple[Cell, ...]] = []
    missing_values = []
    n = max((len(seed_values) for seed_values in values.values()), default=0)
    for repeat in range(n):
        for i, (fog, seed_values) in enumerate(values.items()):
            value = seed_values[repeat]
            if value is None:
                missing_values.append(
                    MissingValue(row=len(rows), column="total", reason="lost at 3.1 s")
                )
            status = "ok" if value is not None else "lost"
            rows.append((repeat, seed + repeat, fog, value, value, status, 2.0 * (i + 1)))
    run = RunInfo(
        seed=seed,
        mode="independent",
        algorithm=algorithm,
        parameters={"levels": 3.0},
        settings=(),
        compatibility=(),
        timestep=(0.002, "s"),
        version="0.1.0",
    )
    return Result(
        inputs=Inputs.from_dict(INPUTS),
        run=run,
        columns=columns,
        rows=tuple(rows),
        missing_values=tuple(missing_values),
    )


def noisy_result(
    algorithm: str, mean: float, *, n: int, salt: int, levels: Sequence[float] = (0.0, 0.5, 1.0)
) -> Result:
    """Return a result of values with a standard deviation of 0.1 about a mean.

    A further noise is common to all results: equal for equal seeds and levels.
    """
    shared_noise = np.random.Generator(np.random.Philox(99)).normal(0.0, 0.5, (n, len(levels)))
    own_noise = np.random.Generator(np.random.Philox(salt)).normal(mean, 0.1, (n, len(levels)))
    samples = shared_noise + own_noise
    return make_result(algorithm, {fog: samples[:, i].tolist() for i, fog in enumerate(levels)})


def entries(*results: Result) -> tuple[Entry, ...]:
    """Return the entries of results, named by their algorithms."""
    return tuple(
        Entry(name=name, source=f"{name}.result", result=result, sha256="00" * 32)
        for result in results
        if (name := str(result.run.algorithm))
    )


def save_results(directory: Path, *results: Result) -> list[str]:
    """Save results in directories named by their algorithms; return the directories."""
    paths = []
    for result in results:
        paths.append(str(directory / f"{result.run.algorithm}.result"))
        save(result, Path(paths[-1]))
    return paths
