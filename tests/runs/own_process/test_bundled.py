"""Every bundled tracker, run as ``module:Class`` in a process of its own, scores its own rows."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_benchmark import run, write_benchmark
from uwsim.algorithms import ALGORITHMS

TRACKERS = ("ecc", "frozen", "ic", "orb", "ssd-esm")


@pytest.mark.slow
def test_rows_of_bundled_trackers_are_the_same_outside(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    for name in TRACKERS:
        cls = ALGORITHMS[name]
        there = f"{cls.__module__}:{cls.__qualname__}"
        inside = run(benchmark, tmp_path / f"{name}-in", algorithm=name)
        outside = run(benchmark, tmp_path / f"{name}-out", algorithm=there)
        assert outside.rows == inside.rows, name
        assert inside.run.clients is None
        assert outside.run.clients == ((there, "own process, grade (b)"),)
