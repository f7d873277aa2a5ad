"""When a run counts as broken."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.stored_rows import stored_row
from uwsim.base.expression import ScoreError
from uwsim.envelope import parse_criterion
from uwsim.envelope.criterion import Judgement, reasons
from uwsim.results.stored.stored_row import StoredRow


def row(status: str = "ok", total: float | None = 2.0, **measures: float | None) -> StoredRow:
    found = {name: [value, "px"] for name, value in measures.items()}
    return stored_row(status=status, total=total, measures=found)


def judge(text: str, **given: Any) -> tuple[bool, str]:
    names = [name for name in given if name not in ("status", "total")]
    judged = parse_criterion(text, names).judge(row(**given))
    return judged.is_broken, judged.reason


def test_a_run_is_broken_where_the_criterion_is_not_zero() -> None:
    assert judge("corners > 5", corners=5.5) == (True, "corners > 5")
    assert judge("corners > 5", corners=5.0) == (False, "")
    assert judge("total*corners > 9 && corners < 6", corners=5.0) == (
        True, "total*corners > 9 && corners < 6",
    )  # fmt: skip


@pytest.mark.parametrize("status", ["lost", "timeout", "collision", "algorithm error"])
def test_a_status_that_is_not_ok_is_broken_whatever_the_measures_say(status: str) -> None:
    assert judge("distance > 5", status=status, distance=1.0) == (True, status)


def test_a_criterion_that_asks_for_the_status_decides_itself() -> None:
    assert judge("status == lost", status="lost", corners=None)[0]
    assert not judge("status == lost", status="timeout", corners=None)[0]
    assert not judge("status == error", status="ok", corners=1.0)[0]
    assert judge("status != ok && status != collision", status="timeout", corners=1.0)[0]


def test_a_missing_value_is_broken_with_that_reason() -> None:
    assert judge("corners > 5", corners=None) == (True, "no value")
    assert judge("status == ok && corners > 5", corners=None) == (True, "no value")


def test_a_measure_of_that_name_comes_first() -> None:
    assert judge("collision > 2", collision=3.0)[0]
    assert not judge("status > 2", status="lost", corners=1.0)[0]


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("corner > 5", "no measure is called 'corner'. Did you mean 'corners'?"),
        ("corners >", "the expression ends too early\n  corners >\n           ^"),
        ("1 > 0", "uses no measure; expected one of corners, total, status"),
        ("lost", "uses no measure"),
    ],
)
def test_a_criterion_that_cannot_be_meant_is_refused(text: str, wrong: str) -> None:
    with pytest.raises(ScoreError) as caught:
        parse_criterion(text, ["corners"])
    assert wrong in str(caught.value)


def test_reasons_are_counted_the_most_frequent_first() -> None:
    whys = ["lost", "corners > 5", "corners > 5", ""]
    judged = [Judgement(is_broken=bool(why), reason=why) for why in whys]
    assert list(reasons(judged).items()) == [("corners > 5", 2), ("lost", 1)]
