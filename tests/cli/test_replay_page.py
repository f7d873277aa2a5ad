"""``uwsim replay -o x.html``, and the links of a report to it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.short_benchmark import run, write_benchmark
from uwsim.analysis.report import write_report
from uwsim.cli.replay import opened, show_page
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
    show_page(opened(result / "result.json", None, None, ()), out, overwrite=False, port=0)
    assert "its rows link to it" in capsys.readouterr().out
    report = (result / "report.html").read_text()
    assert how not in report
    links = re.findall(r'href="replay.html#level=(\d+)"', report)
    assert links == ["0", "3", "1", "4", "2", "5"]
    with pytest.raises(BadSetting, match="--overwrite"):
        show_page(opened(result, 0, None, ()), out, overwrite=False, port=0)
    deeper = tmp_path / "new" / "folder.html"
    show_page(opened(result, 0, None, ()), deeper, overwrite=False, port=0)
    assert deeper.is_file()
    deeper.unlink()
    deeper.mkdir()
    with pytest.raises(BadSetting, match="is a folder"):
        show_page(opened(result, 0, None, ()), deeper, overwrite=True, port=0)


def test_a_result_without_inputs_of_a_pilot_is_one_error(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.1")
    with pytest.raises(UwsimError) as error:
        run(benchmark, tmp_path / "again", algorithm="scripted:nowhere")
    assert str(error.value) == "nowhere: no result here (there is no such file or directory)."
