"""That a tracker answers its start exactly stands beside the status of each row."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_benchmark import run, write_benchmark
from uwsim.analysis.report import render
from uwsim.results.result_file import dumps
from uwsim.results.table import lines

SAID = "all estimates are exactly the start that"


@pytest.mark.slow
@pytest.mark.parametrize("repeat", [1, 2])
def test_a_tracker_that_answers_its_start_has_it_said_in_each_row(
    repeat: int, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    result = run(write_benchmark(tmp_path, "0.5"), out, algorithm="frozen", repeat=repeat)
    rows = {remark.row for remark in result.remarks}
    assert rows == set(range(len(result.rows)))
    for line in lines(result):
        assert line.is_ok
        assert SAID in line.reason
        assert line.reason.startswith(f"{repeat} of {repeat}: corners" if repeat > 1 else "corners")
    (remark,) = {remark.text for remark in result.remarks}
    assert any(SAID in note for note in result.run.notes)
    assert remark in dumps(result)
    assert SAID in render(result, out, plots=())
    assert SAID not in "".join(path.read_text() for path in out.rglob("*.dat"))


@pytest.mark.slow
def test_a_tracker_that_gives_other_estimates_has_no_remark(tmp_path: Path) -> None:
    result = run(write_benchmark(tmp_path, "0.5"), tmp_path / "out", algorithm="esm")
    assert result.remarks == ()
    assert "remarks" not in dumps(result)
