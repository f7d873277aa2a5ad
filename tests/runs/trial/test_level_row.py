"""Values of the measures at the end of a level, by the status of its row."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from uwsim.runs.trial.level_row import cells_of


def triggered(name: str, value: float | None, *, is_fed: bool) -> object:
    measure = SimpleNamespace(
        fed_by_algorithm=is_fed, unit="px", why=None if value is not None else "no estimate",
        details={"mean": value}, detail_units={}, reasons={},
    )  # fmt: skip
    spec = SimpleNamespace(name=name)
    return SimpleNamespace(spec=spec, measure=measure, value=value, has_start_value=False)


@pytest.mark.parametrize(
    ("status", "kept"), [("ok", 2.5), ("timeout", 2.5), ("lost", None), ("algorithm error", None)]
)
def test_a_timeout_keeps_the_value_of_a_measure_that_did_not_wait(
    status: str, kept: float | None
) -> None:
    """Such as one of a level whose <stopOn> never came; what was lost or failed has no value."""
    measures = [triggered("norm", 2.5, is_fed=True), triggered("depth", 4.0, is_fed=False)]
    cells = cells_of(measures, status, "why")  # type: ignore[arg-type]
    assert cells.values == {"norm": kept, "depth": 4.0}
    assert cells.details["norm.mean"][0] == kept
    assert cells.missing_reasons == ({} if kept is not None else {"norm": "why"})


def test_a_measure_that_waited_has_no_value_in_a_timeout() -> None:
    """An old estimate is never scored."""
    measures = [triggered("norm", None, is_fed=True), triggered("other", 1.0, is_fed=True)]
    cells = cells_of(measures, "timeout", "no estimate for 2 s")  # type: ignore[arg-type]
    assert cells.values == {"norm": None, "other": 1.0}
    assert cells.missing_reasons["norm"] == "no estimate for 2 s"
