"""A kill trial of each kind; ``scripts/kill_trials`` makes as many as are wanted."""

from __future__ import annotations

import pytest

from tests.support.kill_trials import KINDS, Workplace, prepare, run_trial

SEED = 9


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Workplace:
    return prepare(tmp_path_factory.mktemp("trials"))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_disturbed_run_loses_nothing_and_leaves_nothing_behind(
    kind: str, place: Workplace
) -> None:
    assert run_trial(place, SEED, 0, [kind]) == []
