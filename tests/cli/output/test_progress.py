"""The time left is about right from when it is first said."""

from __future__ import annotations

import pytest

from uwsim.cli.output.progress import TimeEstimate


def moments(n: int, *, start: float, each: float, at_once: int = 1) -> list[float]:
    """When each of n pieces is done: after a start, so many at a time."""
    return [start + each * (1 + i // at_once) + 0.001 * (i % at_once) for i in range(n)]


@pytest.mark.parametrize(("n", "at_once"), [(27, 1), (27, 2), (40, 4), (12, 4), (540, 16)])
def test_a_slow_start_does_not_make_the_rest_look_long(n: int, at_once: int) -> None:
    # 5 s to load and compile, then a quarter of a second each: 5.25 s * 26 would be 136 s, not 6.5
    left = TimeEstimate(n, n_parallel=at_once)
    when = moments(n, start=5.0, each=0.25, at_once=at_once)
    n_said = 0
    for now in when:
        left.count_piece(now)
        if left.seconds is not None:
            n_said += 1
            truth = when[-1] - now
            assert left.seconds <= 2.5 * truth + 0.25 * at_once
            assert truth <= 2.5 * left.seconds + 0.5
    assert n_said >= (n - at_once) // 2


def test_what_was_done_before_is_no_part_of_the_speed() -> None:
    left = TimeEstimate(100, n_done=90)
    for now in (60.0, 61.0, 62.0):
        left.count_piece(now)
    assert left.seconds == 7.0


def test_nothing_is_reported_before_a_second_piece() -> None:
    left = TimeEstimate(3)
    assert left.seconds is None
    left.count_piece(9.0)
    assert left.seconds is None
    left.count_piece(10.0)
    assert left.seconds == 1.0
