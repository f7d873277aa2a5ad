from pathlib import Path

import pytest

from uwsim.benchmark.unit_file import Stored, UnitFile, path_of, read
from uwsim.errors import ReplayDiffers, ResultError

HEAD = {"seed": 1}


def play(folder: Path, rows: list[dict[str, object]], *, end: bool = True) -> None:
    file = UnitFile(folder, 0, HEAD)
    try:
        for row in rows:
            file.add(row)
        if end:
            file.finish({"n": len(rows)})
    finally:
        file.close()


def test_rows_come_back_as_they_were_added(tmp_path: Path) -> None:
    play(tmp_path, [{"a": 0.1}, {"a": None}])
    assert read(tmp_path, 0, HEAD) == Stored(({"a": 0.1}, {"a": None}), {"n": 2})


def test_nothing_stored_is_nothing_finished(tmp_path: Path) -> None:
    assert read(tmp_path, 3, HEAD) == Stored((), None)


@pytest.mark.parametrize("cut", range(1, 60, 7))
def test_a_file_cut_off_anywhere_goes_on_and_ends_with_the_same_bytes(
    tmp_path: Path, cut: int
) -> None:
    rows: list[dict[str, object]] = [{"a": 1 / 3}, {"a": 2.0}, {"a": None}]
    play(tmp_path, rows)
    whole = path_of(tmp_path, 0).read_bytes()
    path_of(tmp_path, 0).write_bytes(whole[:-cut])
    play(tmp_path, rows)
    assert path_of(tmp_path, 0).read_bytes() == whole


def test_a_row_that_differs_when_played_again_stops_the_run(tmp_path: Path) -> None:
    play(tmp_path, [{"a": 1.0, "b": 2.0}], end=False)
    with pytest.raises(ReplayDiffers, match=r"row 0.*differs.*in b"):
        play(tmp_path, [{"a": 1.0, "b": 2.5}])
    assert read(tmp_path, 0, HEAD).rows == ({"a": 1.0, "b": 2.0},)


def test_rows_of_another_run_are_refused(tmp_path: Path) -> None:
    play(tmp_path, [{"a": 1.0}])
    with pytest.raises(ResultError, match="another run"):
        read(tmp_path, 0, {"seed": 2})
