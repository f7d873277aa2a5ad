import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.stored_rows import end_record, row_record, stored_end, stored_row
from uwsim.errors import ReplayDiffers, ResultError
from uwsim.results.journal import Journal, StoredTrial, path_of, read

HEAD = {"seed": 1}


def play(folder: Path, rows: list[dict[str, object]], *, end: bool = True) -> None:
    file = Journal(folder, 0, HEAD)
    try:
        for row in rows:
            file.add(row)
        if end:
            file.finish(stored_end(notes=[f"{len(rows)} rows"]))
    finally:
        file.close()


def test_rows_come_back_as_they_were_added(tmp_path: Path) -> None:
    rows = stored_row(total=0.1), stored_row(total=None)
    play(tmp_path, [*rows])
    assert read(tmp_path, 0, HEAD) == StoredTrial(rows, stored_end(notes=["2 rows"]))


def test_nothing_stored_is_nothing_finished(tmp_path: Path) -> None:
    assert read(tmp_path, 3, HEAD) == StoredTrial((), None)


@pytest.mark.parametrize("cut", range(1, 700, 53))
def test_a_file_cut_off_anywhere_goes_on_and_ends_with_the_same_bytes(
    tmp_path: Path, cut: int
) -> None:
    rows = [stored_row(total=1 / 3), stored_row(total=2.0), stored_row(total=None)]
    play(tmp_path, rows)
    whole = path_of(tmp_path, 0).read_bytes()
    path_of(tmp_path, 0).write_bytes(whole[:-cut])
    play(tmp_path, rows)
    assert path_of(tmp_path, 0).read_bytes() == whole


def test_a_row_that_differs_when_played_again_stops_the_run(tmp_path: Path) -> None:
    row = stored_row(duration=2.0)
    play(tmp_path, [row], end=False)
    with pytest.raises(ReplayDiffers, match=r"row 0.*differs.*in duration"):
        play(tmp_path, [stored_row(duration=2.5)])
    assert read(tmp_path, 0, HEAD).rows == (row,)


@pytest.mark.parametrize("line", [1, -1])
def test_what_is_behind_the_end_of_a_trial_is_refused(tmp_path: Path, line: int) -> None:
    play(tmp_path, [stored_row()])
    path = path_of(tmp_path, 0)
    lines = path.read_text().splitlines()
    path.write_text("".join(f"{each}\n" for each in [*lines, lines[line]]))
    with pytest.raises(ResultError, match=r"00000\.jsonl:4: it follows the end of its trial"):
        read(tmp_path, 0, HEAD)


def test_rows_of_another_run_are_refused(tmp_path: Path) -> None:
    play(tmp_path, [stored_row()])
    with pytest.raises(ResultError, match="another run"):
        read(tmp_path, 0, {"seed": 2})


@pytest.mark.parametrize(
    ("line", "now", "said"),
    [
        (1, {"row": row_record()}, "expected an object with 'unit'"),
        (1, {"unit": {"seed": "x"}}, "unit.seed is 'x'; expected a whole number from 0"),
        (2, 7, "found 7; expected an object with 'row' or 'end'"),
        (2, {"row": {}}, "expected 'values' among its keys"),
        (2, {"row": row_record(total="x")}, "row.total is 'x'; expected a finite number"),
        (2, {"row": row_record(status="\ud800")}, r"row.status is '\\ud800'; expected text"),
        (2, {"row": row_record(missing={"\ud800": "x"})}, r"row.missing is '\\ud800'; expected"),
        (2, {"row": row_record(measures={"a": 1})}, "row.measures.a is 1; expected a list of 2"),
        (2, {"row": row_record(logs={"a": [["x"]]})}, "expected numbers and nulls"),
        (3, {"end": end_record(streams=[["/a", 1]])}, r"end.streams\[0\] is .* a list of 3"),
    ],
)
def test_a_line_that_is_damaged_is_named_with_what_was_expected(
    tmp_path: Path, line: int, now: Any, said: str
) -> None:
    play(tmp_path, [stored_row()])
    path = path_of(tmp_path, 0)
    lines = path.read_text().splitlines()
    lines[line - 1] = json.dumps(now)
    path.write_text("".join(f"{each}\n" for each in lines))
    with pytest.raises(ResultError, match=rf"00000.jsonl:{line}: .*{said}"):
        read(tmp_path, 0, HEAD)


def test_not_a_number_is_damage_and_no_end_of_the_file(tmp_path: Path) -> None:
    play(tmp_path, [stored_row()])
    path = path_of(tmp_path, 0)
    path.write_text(path.read_text().replace("1.5", "NaN"))
    with pytest.raises(ResultError, match="jsonl:2: it contains NaN; a missing value is null"):
        read(tmp_path, 0, HEAD)
