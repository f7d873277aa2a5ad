from pathlib import Path

import pytest

from uwsim.errors import BadSetting
from uwsim.results.directory import check, lock_directory, prepare_directory

RESULT = (
    "result.json", "result.dat", "summary.csv", "provenance.json", "report.html",
    "measure-corners.csv",
    "units/00000.jsonl", "plots/total.png", "pictures/00000-bowtech1.png", "control/result.json",
    "control/units/00000.jsonl",
)  # fmt: skip


BEGUN = {
    "provenance.json": '{"command": ["bench", "visibility"]}',
    "units/00000.jsonl": '{"unit": {"run": {"seed": 1}}}\n',
}
"""What tells that a directory holds a run of ours: either of these."""


def make(directory: Path, *names: str) -> Path:
    for name in names:
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(BEGUN.get(name, "x"))
    return directory


def content(directory: Path) -> dict[str, str]:
    files = (path for path in directory.rglob("*") if path.is_file())
    return {str(path.relative_to(directory)): path.read_text() for path in files}


def enter(directory: Path, *, resume: bool = False, overwrite: bool = False) -> None:
    with prepare_directory(directory, resume=resume, overwrite=overwrite):
        pass


def enter_several(directory: Path, *results: str) -> None:
    with prepare_directory(directory, resume=True, overwrite=False, results=results):
        pass


def test_a_result_is_overwritten_whole(tmp_path: Path) -> None:
    with prepare_directory(make(tmp_path, *RESULT), resume=False, overwrite=True):
        assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("place", ["", "esm"])
def test_nothing_is_removed_while_another_run_writes(tmp_path: Path, place: str) -> None:
    results = [place] if place else []
    make(tmp_path / place, *RESULT)
    with (
        lock_directory(tmp_path / place),
        pytest.raises(BadSetting, match="another run is writing"),
        prepare_directory(tmp_path, resume=False, overwrite=True, results=results),
    ):
        pass
    assert all((tmp_path / place / name).exists() for name in RESULT)


def test_several_results_are_overwritten_and_kept_for_oneself(tmp_path: Path) -> None:
    names = ["esm", "frozen"]
    make(tmp_path / "esm", *RESULT)
    with prepare_directory(tmp_path, resume=False, overwrite=True, results=names):
        assert sorted(path.name for path in tmp_path.rglob("*")) == names
        with pytest.raises(BadSetting, match="another run"), lock_directory(tmp_path / "esm"):
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
    with pytest.raises(BadSetting, match="--resume to continue, or --overwrite"):
        enter(make(tmp_path, *RESULT))
    with pytest.raises(BadSetting, match="exclude each other"):
        enter(tmp_path, resume=True, overwrite=True)
    enter(tmp_path, resume=True)
    assert all((tmp_path / name).exists() for name in RESULT)


def test_two_runs_at_once_do_not_share_a_directory(tmp_path: Path) -> None:
    with (
        lock_directory(tmp_path / "a"),
        pytest.raises(BadSetting, match="another run"),
        lock_directory(tmp_path / "a"),
    ):
        pass
    with lock_directory(tmp_path / "a"):
        assert (tmp_path / "a").is_dir()


@pytest.mark.parametrize("marker", BEGUN)
def test_to_go_on_clears_drafts_of_our_own_files_and_nothing_else(
    tmp_path: Path, marker: str
) -> None:
    drafts = (".result.json.123.part", "plots/.total.png.7.part", "control/.result.dat.99.part")
    others = (
        "notes.txt", ".notes.txt.1.part", ".result.json.part", "mine/.result.json.1.part",
        "plots/.holiday.7.part", "units/x/.00000.jsonl.2.part",
    )  # fmt: skip
    make(tmp_path, marker, *drafts, *others)
    elsewhere = make(tmp_path.parent / f"{tmp_path.name}-elsewhere", ".00000-a.png.1.part")
    (tmp_path / "pictures").symlink_to(elsewhere)
    enter(tmp_path, resume=True)
    assert set(content(tmp_path)) == {marker, *others}
    assert set(content(elsewhere)) == {".00000-a.png.1.part"}


@pytest.mark.parametrize("name", ["notes.txt", "report.html", "mine/a", "provenance.json.txt"])
def test_to_go_on_where_no_run_was_begun_is_refused(tmp_path: Path, name: str) -> None:
    before = content(make(tmp_path, name, ".result.json.123.part"))
    with pytest.raises(BadSetting, match=r"no run of uwsim to resume; nothing was changed"):
        enter(tmp_path, resume=True)
    assert content(tmp_path) == before


def test_a_folder_with_a_result_in_it_is_not_one_itself(tmp_path: Path) -> None:
    make(tmp_path / "visibility.result", *RESULT)
    with pytest.raises(BadSetting, match=r"holds 'visibility.result', but no run"):
        enter(tmp_path, resume=True)


def test_several_results_are_gone_on_with_if_each_is_ours_or_not_there(tmp_path: Path) -> None:
    make(tmp_path / "esm", *RESULT)
    make(tmp_path, "notes.txt")
    check(tmp_path, resume=True, overwrite=False, results=["esm", "orb"])
    make(tmp_path / "orb", "notes.txt")
    with pytest.raises(BadSetting, match=r"orb: holds 'notes.txt', but no run"):
        check(tmp_path, resume=True, overwrite=False, results=["esm", "orb"])
    with pytest.raises(BadSetting, match=r"holds 'esm', but no run"):
        check(tmp_path, resume=True, overwrite=False, results=["p", "pi"])


def test_what_a_run_leaves_that_was_killed_at_once_can_be_gone_on_with(tmp_path: Path) -> None:
    (tmp_path / "esm" / "units").mkdir(parents=True)
    make(tmp_path, "esm/.provenance.json.12.part")
    enter_several(tmp_path, "esm", "orb")
    assert content(tmp_path) == {}
    enter(tmp_path / "new", resume=True)
