"""The comparison of trackers: what `visibility-moving` is for."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from uwsim.runs.executors.executor import run_all
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan import Plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.runs.run import Run
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute

Totals = Callable[[str], dict[float, float | None]]
TRACKERS = ("ecc", "esm", "ic", "orb", "ssd-esm")


def test_guesses_published_in_a_burst_score_what_they_are_worth(tmp_path: Path) -> None:
    guesses, frozen = (
        blind(name, tmp_path / name[:4])["corners"]
        for name in ("tests.runs.trial.algorithms:Guesses", "frozen")
    )
    assert guesses > 0.95 * frozen


def blind(algorithm: str, out: Path) -> dict[str, float]:
    """Play the clear level without drawing anything; returns the measures."""
    plan = replace(plan_of(algorithm, [("fog", 0.0)]), is_blind=True)
    [row] = [row for row in execute(plan, plan.trials()[0]) if isinstance(row, LevelRow)]
    assert row.status == "missed"  # the corners are not within 5 px
    return {name: value for name, (value, _) in row.measures.items() if value is not None}


@pytest.fixture(scope="module")
def totals(tmp_path_factory: pytest.TempPathFactory) -> Totals:
    """Return what runs an algorithm on two levels of fog, once: fog -> total."""

    @cache
    def once(algorithm: str) -> dict[float, float | None]:
        plan, out = plan_of(algorithm, [("fog", 0.0), ("fog", 0.9)]), tmp_path_factory.mktemp("out")
        inputs, renderer = hash_inputs(plan)
        [result] = run_all([Run(plan=plan, out=out, inputs=inputs, renderer=renderer)])
        fogs = [value for value in result.numbers("fog") if value is not None]
        return dict(zip(fogs, result.numbers("total"), strict=True))

    return once


@pytest.mark.slow
def test_in_clear_water_a_tracker_beats_a_blob_of_colour(totals: Totals) -> None:
    blob = totals("tests.runs.trial.algorithms:Blob")[0.0]
    esm = totals("esm")[0.0]
    assert esm is not None
    assert blob is not None
    assert esm < 1.0  # of a tracker without error it is 0
    assert blob > 3.0 * esm


def plan_of(algorithm: str, levels: list[tuple[str, float]]) -> Plan:
    return make_plan(
        PlanRequest(
            benchmark="visibility-moving", algorithm=algorithm, seed=1, repeat=1, levels=levels
        )
    )


@pytest.mark.slow
def test_where_something_moves_frozen_is_worst_until_the_others_are_lost(totals: Totals) -> None:
    frozen = totals("frozen")
    tracked = 0
    for name in TRACKERS:
        for fog, total in totals(name).items():
            worst = frozen[fog]
            assert worst is not None
            if total is not None:
                tracked += 1
                assert total < worst / 2, f"{name} at fog {fog}"
    assert tracked >= len(TRACKERS)  # at fog 0 every one of them tracks
