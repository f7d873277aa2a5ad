"""A simulation that fails ends its trial; its levels have rows that say why."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_benchmark import fingerprint, write_benchmark
from tests.support.short_trial import make_plan
from uwsim.bus import Node
from uwsim.cli import main
from uwsim.errors import SimulationFailed
from uwsim.results.journal import path_of
from uwsim.results.motion import load_track
from uwsim.results.result_file import load
from uwsim.runs.trial.level_row import LevelRow, TrialEnd
from uwsim.runs.trial.trial import execute
from uwsim.simulation import Simulation

WHY = "'ball' moves at 200 m/s"
THREE = "<repeat> <iterations>3</iterations> <interval>1</interval> </repeat>"


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def fail_from(time: float, monkeypatch: pytest.MonkeyPatch, *, seed: int = 0) -> None:
    """Let simulations of a seed fail at a time [s]."""
    advance = Simulation.advance

    def failing(self: Simulation, *arguments: float) -> None:
        if self.time >= time and self.world.model.seed == seed:
            raise SimulationFailed(WHY)
        advance(self, *arguments)

    monkeypatch.setattr(Simulation, "advance", failing)


def test_levels_in_and_after_a_failure_have_rows_and_those_before_keep_their_values(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = make_plan(tmp_path, Idle, THREE)
    fail_from(1.5, monkeypatch)
    *rows, end = execute(plan, plan.trials()[0])
    assert isinstance(end, TrialEnd)
    found = [row for row in rows if isinstance(row, LevelRow)]
    assert [row.status for row in found] == ["ok", "simulation error", "simulation error"]
    assert [row.total for row in found] == [1.0, None, None]
    assert [row.duration for row in found] == pytest.approx([1.0, 0.5, 0.0])
    assert found[1].missing_reasons == {"t": WHY, "total": WHY}
    assert found[1].measures == {"t": (None, "s")}
    (tmp_path / "track").write_bytes(end.motion)
    levels = load_track(tmp_path / "track").levels
    assert [level.status for level in levels] == [row.status for row in found]


def test_a_failure_before_the_first_level_has_rows_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = make_plan(tmp_path, Idle, THREE, mode="independent")
    fail_from(0.5, monkeypatch)  # in the prelude
    outcomes = [list(execute(plan, trial)) for trial in plan.trials()]
    rows = [row for row, _ in outcomes if isinstance(row, LevelRow)]
    assert [(row.status, row.duration) for row in rows] == [("simulation error", 0.0)] * 3


@pytest.mark.slow
def test_bench_runs_the_other_trials_and_ends_with_the_status_of_a_failed_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["bench", str(write_benchmark(tmp_path, "0.2")), "--repeat", "3", "--level", "fog=0"]
    call += ["--workers", "0", "--algorithm", "esm"]
    assert main([*call, "--out", str(tmp_path / "whole")]) == 0
    fail_from(0.1, monkeypatch, seed=1)
    out = tmp_path / "failed"
    assert main([*call, "--out", str(out)]) == 3
    said = capsys.readouterr().err
    assert f"'simulation error': esm, 1 of 3 rows ({WHY})" in said
    assert "Traceback" not in said
    result, whole = load(out), load(tmp_path / "whole")
    assert result.values("status") == ("ok", "simulation error", "ok")
    assert [result.rows[0], result.rows[2]] == [whole.rows[0], whole.rows[2]]
    assert result.reason(1, "corners") == result.reason(1, "total") == WHY
    for index in (0, 2):
        assert path_of(out, index).read_bytes() == path_of(tmp_path / "whole", index).read_bytes()
    assert "simulation error" in (out / "report.html").read_text()
    before = fingerprint(out)
    assert main([*call, "--out", str(out), "--resume"]) == 3
    assert fingerprint(out) == before
    assert main(["verify", str(out), "--all"]) == 0
