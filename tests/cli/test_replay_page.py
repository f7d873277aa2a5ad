"""``uwsim replay -o x.html``, and the links of a report to it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.short_benchmark import run, write_benchmark
from uwsim.analysis.report import write_report
from uwsim.cli.replay import opened, show_page
from uwsim.errors import BadSetting


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
