from pathlib import Path

import pytest

from uwsim.benchmark.directory import alone_in, prepared
from uwsim.errors import BadSetting

RESULT = (
    "result.json", "result.dat", "summary.csv", "provenance.json", "report.html",
    "measure-corners.csv",
    "units/00000.jsonl", "plots/total.png", "pictures/00000-bowtech1.png", "control/result.json",
    "control/units/00000.jsonl",
)  # fmt: skip


def make(directory: Path, *names: str) -> Path:
    for name in names:
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x")
    return directory


def enter(directory: Path, *, resume: bool = False, overwrite: bool = False) -> None:
    with prepared(directory, resume=resume, overwrite=overwrite):
        pass


def test_a_result_is_overwritten_whole(tmp_path: Path) -> None:
    with prepared(make(tmp_path, *RESULT), resume=False, overwrite=True):
        assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("place", ["", "esm"])
def test_nothing_is_removed_while_another_run_writes(tmp_path: Path, place: str) -> None:
    results = [place] if place else []
    make(tmp_path / place, *RESULT)
    with (
        alone_in(tmp_path / place),
        pytest.raises(BadSetting, match="another run is writing"),
        prepared(tmp_path, resume=False, overwrite=True, results=results),
    ):
        pass
    assert all((tmp_path / place / name).exists() for name in RESULT)


def test_several_results_are_overwritten_and_kept_for_oneself(tmp_path: Path) -> None:
    names = ["esm", "frozen"]
    make(tmp_path / "esm", *RESULT)
    with prepared(tmp_path, resume=False, overwrite=True, results=names):
        assert sorted(path.name for path in tmp_path.rglob("*")) == names
        with pytest.raises(BadSetting, match="another run"), alone_in(tmp_path / "esm"):
            pass


@pytest.mark.parametrize(
    "name", ["notes.txt", "pictures/holiday.png", "control/thesis.txt", "units/x/y", "mine/a"]
)
def test_what_is_not_ours_is_never_deleted(tmp_path: Path, name: str) -> None:
    make(tmp_path, *RESULT, name)
    with pytest.raises(BadSetting, match="nothing was overwritten"):
        enter(tmp_path, overwrite=True)
    assert all((tmp_path / each).exists() for each in (*RESULT, name))


def test_a_link_is_not_followed(tmp_path: Path) -> None:
    elsewhere = make(tmp_path / "elsewhere", "00000.jsonl")
    result = make(tmp_path / "result", "result.json")
    (result / "units").symlink_to(elsewhere)
    with pytest.raises(BadSetting, match="units"):
        enter(result, overwrite=True)
    assert (elsewhere / "00000.jsonl").exists()


def test_a_directory_that_is_not_empty_needs_a_word(tmp_path: Path) -> None:
    with pytest.raises(BadSetting, match="--resume to go on, or --overwrite"):
        enter(make(tmp_path, *RESULT))
    with pytest.raises(BadSetting, match="exclude each other"):
        enter(tmp_path, resume=True, overwrite=True)
    enter(tmp_path, resume=True)
    assert all((tmp_path / name).exists() for name in RESULT)


def test_two_runs_at_once_do_not_share_a_directory(tmp_path: Path) -> None:
    with (
        alone_in(tmp_path / "a"),
        pytest.raises(BadSetting, match="another run"),
        alone_in(tmp_path / "a"),
    ):
        pass
    with alone_in(tmp_path / "a"):
        assert (tmp_path / "a").is_dir()
