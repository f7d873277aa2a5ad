"""A finished trial whose motion is lost or damaged is run again by a resumed run."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_benchmark import bench_of, fingerprint, write_benchmark
from uwsim.errors import ReplayDiffers
from uwsim.results.journal import path_of, track_path
from uwsim.runs.executors.executor import run_all

pytestmark = pytest.mark.slow


def test_lost_and_damaged_motion_is_made_again_and_nothing_else_changes(tmp_path: Path) -> None:
    benchmark, out = write_benchmark(tmp_path, "0.2"), tmp_path / "out"
    run_all([bench_of(benchmark, out, mode="independent")])
    before = fingerprint(out)
    whole = track_path(out, 2).read_bytes()
    track_path(out, 1).unlink()
    track_path(out, 2).write_bytes(whole[: len(whole) // 2])
    run = bench_of(benchmark, out, mode="independent")
    assert [trial.index for trial in run.begin()] == [1, 2]
    run_all([run])
    assert fingerprint(out) == before
    assert bench_of(benchmark, out, mode="independent").begin() == []


def test_a_trial_that_does_not_come_out_the_same_again_stays_finished(tmp_path: Path) -> None:
    benchmark, out = write_benchmark(tmp_path, "0.2"), tmp_path / "out"
    run_all([bench_of(benchmark, out, mode="independent")])
    track_path(out, 1).unlink()
    path = path_of(out, 1)
    path.write_text(path.read_text().replace('"ended_at":', '"ended_at":1'))
    before = fingerprint(out)
    with pytest.raises(ReplayDiffers, match="differs from the stored one in ended_at"):
        run_all([bench_of(benchmark, out, mode="independent")])
    assert fingerprint(out) == before
