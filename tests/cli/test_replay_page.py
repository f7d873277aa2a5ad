"""``uwsim replay -o x.html``, and the links of a report to it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.packs import unpack
from tests.support.short_benchmark import run, write_benchmark
from uwsim.analysis.report import write_report
from uwsim.cli.replay import open_replay, open_trials, show_page
from uwsim.errors import BadSetting, UwsimError


@pytest.mark.slow
def test_the_rows_of_a_report_link_to_a_replay_that_is_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result = tmp_path / "result"
    run(write_benchmark(tmp_path, "0.1"), result, repeat=2)
    how = "uwsim replay . -o replay.html"
    assert how in write_report(result).read_text()
    out = result / "replay.html"
    show_page(open_replay(result / "result.json", None, None, ()), out, overwrite=False, port=0)
    assert "its rows link to it" in capsys.readouterr().out
    report = (result / "report.html").read_text()
    assert how not in report
    links = re.findall(r'href="replay.html#level=(\d+)"', report)
    assert links == ["0", "3", "1", "4", "2", "5"]
    with pytest.raises(BadSetting, match="--overwrite"):
        show_page(open_replay(result, 0, None, ()), out, overwrite=False, port=0)
    deeper = tmp_path / "new" / "folder.html"
    show_page(open_replay(result, 0, None, ()), deeper, overwrite=False, port=0)
    assert deeper.is_file()
    deeper.unlink()
    deeper.mkdir()
    with pytest.raises(BadSetting, match="is a folder"):
        show_page(open_replay(result, 0, None, ()), deeper, overwrite=True, port=0)


@pytest.fixture
def torn(tmp_path: Path) -> Path:
    """A result of three independent levels; the motion of the second is missing."""
    result = tmp_path / "result"
    run(write_benchmark(tmp_path, "0.1"), result, mode="independent")
    (result / "units" / "00001.motion").unlink()
    return result


def test_a_level_without_motion_is_listed_and_warned_of(
    torn: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pack = open_replay(torn, None, None, ()).pack()
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"uwsim: warning: {torn}/units: 00001.motion: missing; ")
    head, _ = unpack(pack)
    levels = [level for trial in head["trials"] for level in trial["levels"]]
    assert [level["label"] for level in levels] == ["fog 0", "fog 0.4", "fog 0.8"]
    assert [level["status"] for level in levels] == ["ok", "no motion", "ok"]
    assert levels[1]["values"] == {"fog": 0.4}
    assert levels[1]["end"] - levels[1]["start"] == pytest.approx(0.1)
    assert "units/00001.motion" in levels[1]["why"]
    assert head["trials"][1]["motion"] is None
    names = [[curve["name"] for curve in trial["curves"]] for trial in head["trials"]]
    assert [each[0] for each in names] == ["corners"] * 3
    assert {"corners.nw_x", "corners.sw_y"} <= set(names[1])


def test_a_film_says_that_a_level_is_left_out(
    torn: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert [trial.index for trial in open_trials(torn, None, None, ())] == [0, 2]
    assert "00001.motion: missing; their levels are left out" in capsys.readouterr().err
    open_trials(torn, 2, None, ())
    assert capsys.readouterr().err == ""


def test_a_result_without_inputs_of_a_pilot_is_one_error(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.1")
    with pytest.raises(UwsimError) as error:
        run(benchmark, tmp_path / "again", algorithm="scripted:nowhere")
    assert str(error.value) == "nowhere: no result here (there is no such file or directory)."
