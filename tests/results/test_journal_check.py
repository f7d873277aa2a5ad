"""A row is believed if its unit has stored the same; where there is no unit it is not checked."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.support.compared_results import make_result
from tests.support.stored_rows import end_record, row_record
from uwsim.analysis.comparison import read_entries, remarks
from uwsim.analysis.report import write_report
from uwsim.cli import main
from uwsim.errors import ResultError
from uwsim.results.journal_check import check_rows
from uwsim.results.result_file import load, save

WHY = "lost at 3.1 s"
FOUND = {0.0: [1.5, 1.25], 0.5: [2.5, None]}


Found = dict[float, list[Any]]


def written(directory: Path, algorithm: str = "esm", found: Found = FOUND) -> Path:
    """A result of two seeds and two levels, with what its units have stored."""
    result = make_result(algorithm, found)
    save(result, directory)
    for seed in (0, 1):
        lines: list[dict[str, Any]] = [{"unit": {"run": {"seed": 0}, "seed": seed}}]
        for fog, values in found.items():
            value = values[seed]
            row = row_record(
                values=[fog],
                measures={"corners": [value, "px"]},
                total=value,
                status="lost" if value is None else "ok",
                missing={} if value is not None else {"total": WHY},
                duration=2.0,
            )
            lines.append({"row": row})
        lines.append({"end": end_record()})
        file = directory / "units" / f"{seed:05d}.jsonl"
        file.parent.mkdir(exist_ok=True)
        file.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return directory


def altered(directory: Path, before: str, after: str) -> Path:
    path = directory / "result.json"
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after, 1))
    return directory


def checked(directory: Path) -> str | None:
    return check_rows(load(directory), directory)


def test_rows_that_say_what_their_units_have_stored_are_believed(tmp_path: Path) -> None:
    assert checked(written(tmp_path)) is None


@pytest.mark.parametrize("n", [1, 5])
def test_a_row_that_a_result_repeats_is_refused(tmp_path: Path, n: int) -> None:
    path = written(tmp_path) / "result.json"
    document = json.loads(path.read_text())
    document["rows"] += [document["rows"][1]] * n
    path.write_text(json.dumps(document))
    with pytest.raises(ResultError, match=rf"seed 0, level 0\.5 occurs {n + 1} times"):
        checked(tmp_path)


def test_a_level_that_is_there_twice_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path) / "units" / "00001.jsonl"
    lines = path.read_text().splitlines()
    path.write_text("".join(f"{each}\n" for each in [*lines[:2], *lines[1:]]))
    with pytest.raises(ResultError, match=r"00001\.jsonl: level 0\.0 of seed 1 occurs twice"):
        checked(tmp_path)


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ("2.5, 2.5,", "2.5, 2.4,", "row 1, column total: 2.4 there, 2.5 by units/"),
        ("1.25, 1.25,", "1.2, 1.2,", "row 2, column corners: 1.2 there, 1.25 by units/"),
        ('"lost", 4.0', '"ok", 4.0', "row 3, column status: 'ok' there, 'lost' by units/"),
        ('"ok", 2.0', '"ok", 1.0', "row 0, column ended_at: 1.0 there, 2.0 by units/"),
        ("lost at 3.1 s", "bad luck", "row 3, why total is missing: 'bad luck' there"),
        ('"px"', '"m"', "row 0, column corners: in m there, in px by units/"),
        ("[0, 0, 0.5,", "[0, 0, 0.6,", "row 1: units/ has no such level"),
        ("[1, 1, 0.0,", "[1, 7, 0.0,", "row 2: units/ has no such level"),
    ],
)
def test_a_row_that_says_other_than_its_unit_is_refused_everywhere(
    tmp_path: Path, before: str, after: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    one = altered(written(tmp_path / "esm"), before, after)
    other = written(tmp_path / "orb", "orb")
    with pytest.raises(ResultError, match="differs from the journals of its trials") as caught:
        checked(one)
    assert said in str(caught.value)
    out = str(tmp_path / "comparison")
    for call in (["report", str(one)], ["compare", str(other), str(one), "--out", out]):
        assert main(call) == 2
        [line] = capsys.readouterr().err.splitlines()
        assert said in line
    assert not (one / "report.html").exists()


def test_a_score_by_another_name_is_refused(tmp_path: Path) -> None:
    altered(written(tmp_path, found={0.0: [1.5, 1.25]}), '"total"', '"totel"')
    with pytest.raises(ResultError, match="row 0, there is no column total"):
        checked(tmp_path)


def test_many_contradictions_are_counted(tmp_path: Path) -> None:
    path = written(tmp_path) / "units" / "00000.jsonl"
    path.write_text(path.read_text().replace("1.5", "1.75").replace("2.5", "2.75"))
    with pytest.raises(ResultError, match=r"1\.75 by units/; row 1, .*; and 1 more\. uwsim verify"):
        checked(tmp_path)


def test_what_cannot_be_checked_is_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one, other = written(tmp_path / "esm"), written(tmp_path / "orb", "orb")
    assert remarks(read_entries([one, other])) == ()
    (one / "units" / "00000.jsonl").unlink()
    altered(one, '"timestep"', '"units": [2, 2], "timestep"')
    shutil.rmtree(other / "units")
    some = "2 of 4 rows are not checked: their trials are not in units/"
    none = "rows are not checked: there is no units/ next to them"
    assert remarks(read_entries([one, other])) == (f"esm: {some}", f"orb: {none}")
    assert f"<p>{none.capitalize()}.</p>" in write_report(other).read_text()
    assert main(["report", str(one)]) == 0
    assert capsys.readouterr().err == f"uwsim: warning: {some}\n"


def test_a_row_that_was_left_out_is_missed(tmp_path: Path) -> None:
    file = altered(written(tmp_path), '"timestep"', '"units": [2, 2], "timestep"') / "result.json"
    assert checked(tmp_path) is None
    lines = [
        line for line in file.read_text().splitlines() if not line.startswith("    [1, 1, 0.0")
    ]
    file.write_text("\n".join(lines).replace('"row": 3', '"row": 2'))
    with pytest.raises(ResultError, match=r"trials: it has no row of seed 1, level 0\.0\. uwsim"):
        checked(tmp_path)


def test_a_result_older_than_its_units_is_believed(tmp_path: Path) -> None:
    path = written(tmp_path) / "result.json"
    rows = [line for line in path.read_text().splitlines() if line.startswith("    [1, 1, 0.5")]
    text = path.read_text().replace(rows[0], "").replace('"ok", 2.0],\n\n', '"ok", 2.0]\n')
    path.write_text(text.replace(f'    {{"row": 3, "column": "total", "why": "{WHY}"}}\n', ""))
    assert len(load(tmp_path).rows) == 3
    assert checked(tmp_path) is None


def test_the_end_of_an_independent_level_counts_from_its_start(tmp_path: Path) -> None:
    directory = altered(written(tmp_path), '"ok", 4.0', '"ok", 2.0')
    assert checked(directory) is None
    contradicting = altered(directory, '"lost", 4.0', '"lost", 6.0')
    with pytest.raises(ResultError, match=r"row 3, column ended_at: 6\.0 there, 2\.0 by units/"):
        checked(contradicting)
