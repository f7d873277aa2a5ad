"""The comparison of trackers: what `visibility-moving` is for."""

from pathlib import Path

import pytest

from uwsim.benchmark.bench import Bench, open_once
from uwsim.benchmark.crew import play_all
from uwsim.cli.plan import make_plan

TRACKERS = ("ecc", "esm", "ic", "orb", "ssd-esm")


def totals(algorithm: str, out: Path) -> dict[float, float | None]:
    plan = make_plan(
        "visibility-moving",
        scene=None,
        algorithm=algorithm,
        seed=1,
        repeat=1,
        mode=None,
        levels=["fog=0", "fog=0.9"],
        settings=[],
        compat=[],
        data_path=(),
    )
    inputs, renderer = open_once(plan)
    [result] = play_all([Bench(plan=plan, out=out, inputs=inputs, renderer=renderer)])
    fogs = [value for value in result.numbers("fog") if value is not None]
    return dict(zip(fogs, result.numbers("total"), strict=True))


@pytest.mark.slow
def test_where_something_moves_frozen_is_worst_until_the_others_are_lost(tmp_path: Path) -> None:
    frozen = totals("frozen", tmp_path / "frozen")
    tracked = 0
    for name in TRACKERS:
        for fog, total in totals(name, tmp_path / name).items():
            worst = frozen[fog]
            assert worst is not None
            if total is not None:
                tracked += 1
                assert total < worst / 2, f"{name} at fog {fog}"
    assert tracked >= len(TRACKERS)  # at fog 0 every one of them tracks
