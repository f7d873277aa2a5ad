"""The outcome of a level: success, classes of failures, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_trial import make_plan, rows_of
from uwsim.algorithms import ALGORITHMS
from uwsim.benchmark.reader import check_benchmark
from uwsim.errors import BadSetting
from uwsim.runs.trial.level_row import LevelRow

ONCE = "<repeat> <iterations>1</iterations> <interval>1</interval> </repeat>"
OUTCOME = "<time> <name>t</name> </time> <u:outcome> <name>outcome</name> {} </u:outcome>"
LATE = "<failure> <status>too late</status> <condition>t &gt; {}</condition> {} </failure>"


def row_of(folder: Path, outcome: str) -> LevelRow:
    """Return the row of a level of 1 s that an outcome judges by the time t that has passed."""
    measures = OUTCOME.format(outcome)
    (row,) = rows_of(make_plan(folder, ALGORITHMS["nothing"], ONCE, measures=measures))
    return row


def test_a_success_that_ends_the_level_has_its_time(tmp_path: Path) -> None:
    row = row_of(tmp_path, "<success>t &gt; 0.25</success> <ends>true</ends>")
    assert (row.status, row.measures["outcome"]) == ("ok", (1.0, "1"))
    assert row.duration == pytest.approx(0.252)
    assert row.details["outcome.time_done"] == (pytest.approx(0.252), "s")
    assert row.total == pytest.approx(0.252)


def test_a_success_that_does_not_last_is_none(tmp_path: Path) -> None:
    row = row_of(tmp_path, "<success>t &gt; 0.2 &amp;&amp; t &lt; 0.6</success>")
    assert (row.status, row.duration) == ("missed", pytest.approx(1.0))
    assert row.details["outcome.time_done"][0] is None
    assert row.total == pytest.approx(1.0)  # the level was complete
    assert row.remarks == ("outcome: missed, as not t > 0.2 && t < 0.6",)


def test_without_an_end_the_time_is_that_since_which_the_success_holds(tmp_path: Path) -> None:
    row = row_of(tmp_path, "<success>t &lt; 0.2 || t &gt; 0.4</success>")
    assert row.status == "ok"
    assert row.details["outcome.time_done"][0] == pytest.approx(0.402)


def test_the_first_failure_that_holds_is_the_status(tmp_path: Path) -> None:
    early = "<failure> <status>early</status> <condition>t &lt; 0.5</condition> </failure>"
    row = row_of(tmp_path, f"<success>1</success> {early} {LATE.format(0.7, '')}")
    assert (row.status, row.measures["outcome"][0]) == ("too late", 0.0)
    assert row.total == pytest.approx(1.0)


def test_a_failure_that_ends_the_level_leaves_no_score(tmp_path: Path) -> None:
    row = row_of(tmp_path, f"<success>1</success> {LATE.format(0.3, '<ends>true</ends>')}")
    assert (row.status, row.duration) == ("too late", pytest.approx(0.302))
    assert row.total is None
    assert row.missing_reasons["total"] == "t > 0.3; t = 0.302"


def test_details_are_named_with_underscores_and_others_are_refused(tmp_path: Path) -> None:
    body = "<positionError> <name>offset</name> <target>girona500</target> <position> <x>0</x> "
    body += "<y>0</y> <z>0</z> </position> </positionError>"
    text = "<success>offset_x_rms &lt;= offset_max</success>"
    measures = body + OUTCOME.format(text)
    plan = make_plan(tmp_path, ALGORITHMS["nothing"], ONCE, measures=measures)
    assert [row.status for row in rows_of(plan)] == ["ok"]
    measures = body + OUTCOME.format(text.replace("offset_max", "offset_top"))
    plan = make_plan(tmp_path, ALGORITHMS["nothing"], ONCE, measures=measures)
    with pytest.raises(BadSetting, match="no value or detail is called 'offset_top'"):
        rows_of(plan)


@pytest.mark.parametrize(
    ("outcome", "message"),
    [
        ("<success>later &gt; 1</success>", "no measure is called 'later'"),
        ("<success>t &gt;</success>", "<success>: the expression ends too early"),
        ("<success>1</success>" + LATE.format("x", ""), "<condition>: no measure is called 'x'"),
        (
            "<success>1</success>" + LATE.format(1, "").replace("too late", "missed"),
            "<status> is 'missed'; expected lower-case words",
        ),
        ("<success>1</success>" + 2 * LATE.format(1, ""), "'too late' is given twice"),
        (
            "<success>1</success> </u:outcome> <u:outcome> <name>b</name> <success>1</success>",
            "<u:outcome> is given twice",
        ),
    ],
)
def test_errors_have_their_lines(outcome: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "benchmark.xml"
    path.write_text(
        f'<benchmark xmlns:u="urn:uwsim:1">\n<measures> {OUTCOME.format(outcome)} '
        "<time> <name>later</name> </time> </measures>\n"
        "<startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>\n"
        f"<function>t</function> <sceneUpdater> {ONCE} </sceneUpdater> </benchmark>"
    )
    (error,) = [item for item in check_benchmark(path)[0] if item.severity == "error"]
    assert message in error.message
    assert error.line == 2
