"""All cheats of ``scripts/cheat_trials`` on a short benchmark."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cheat_trials import (
    CHEATS,
    GAINS,
    Bursts,
    FirstQuadTracker,
    ReadsTheFolder,
    bench_of,
    find_errors,
    results_by_name,
    trial,
)
from tests.support.short_trial import rows_of


@pytest.mark.slow
def test_guesses_that_nobody_looks_at_gain_nothing(tmp_path: Path) -> None:
    scores = []
    for cheat in (FirstQuadTracker, Bursts):
        plan = bench_of(tmp_path, cheat, seed=2, length=0.3).plan
        scores.append([row.total for row in rows_of(plan)])
    assert scores[0] == scores[1]
    assert None not in scores[0]


@pytest.mark.slow
def test_no_cheat_gains_but_those_within_their_own_process(tmp_path: Path) -> None:
    results = results_by_name(trial(tmp_path, CHEATS, seed=2, length=1.0))
    assert find_errors(results) == []
    for cheat in GAINS:
        assert results[cheat.__name__].values("total") == pytest.approx((0.0, 0.0), abs=0.1)


@pytest.mark.slow
def test_the_rows_of_a_run_tell_the_truth_only_when_they_are_not_sealed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.runs.sealing.is_foreign", lambda plan: False)
    results = results_by_name(trial(tmp_path, (ReadsTheFolder,), seed=2, length=0.5))
    assert len(find_errors(results)) == 2  # else the test above says nothing
