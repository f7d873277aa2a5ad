"""What a result file promises."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.errors import ResultError, UnknownName
from uwsim.results.inputs import Inputs
from uwsim.results.result import MAX_VALUE, Column, ImageStream, MissingValue, Result, SavedImage
from uwsim.results.result_file import dumps, load, loads, save
from uwsim.results.run_info import RunInfo

COLUMNS = (
    Column(name="fog", kind="level", unit="1/m"),
    Column(name="corners", kind="measure", unit="px"),
    Column(name="corners.mean", kind="detail", unit="px"),
    Column(name="total", kind="score", expression="corners"),
    Column(name="status", kind="status"),
    Column(name="ended_at", kind="time", unit="s"),
)


def make(**changes: object) -> Result:
    result = Result(
        inputs=Inputs(benchmark=("a.xml", "sha256:00"), assets={"b.osg": "sha256:11"}),
        run=RunInfo(seed=7, parameters={"threshold": 0.5}, timestep=(0.002, "s")),
        columns=COLUMNS,
        rows=((0.0, 1.83, 1.79, 1.83, "ok", 2.0), (1.2, None, None, None, "lost", 4.0)),
        missing_values=(
            MissingValue(row=1, column="corners", reason="tracker lost at 3.6 s"),
            MissingValue(row=1, column="total", reason="corners is missing"),
        ),
        facts={"S": [31.25, "grey level"], "f_star": [1.083, "1/m"]},
        image_streams=(ImageStream(seed=7, level=None, topic="/c", frames=120, sha256="ab"),),
        images=(SavedImage(row=0, camera="c", file="pictures/0.png", truth=(0.0,) * 8),),
    )
    return replace(result, **changes)


def test_what_is_saved_is_what_is_loaded(tmp_path: Path) -> None:
    file = save(make(), tmp_path / "new.result")
    assert file == tmp_path / "new.result" / "result.json"
    assert load(file) == load(tmp_path / "new.result") == make()


def test_saving_twice_gives_the_same_bytes_and_leaves_no_other_file(tmp_path: Path) -> None:
    first = save(make(), tmp_path).read_bytes()
    assert save(load(tmp_path), tmp_path).read_bytes() == first
    assert [p.name for p in tmp_path.iterdir()] == ["result.json"]


def test_the_text_is_that_of_the_design_with_one_row_a_line() -> None:
    text = dumps(make())
    assert text.startswith('{\n  "format": "uwsim-result/1",\n')
    assert text.endswith("}\n")
    assert '    [1.2, null, null, null, "lost", 4.0]\n' in text
    assert '{"name": "total", "kind": "score", "expression": "corners"}' in text
    keys = ["format", "inputs", "run", "facts", "columns", "rows", "missing"]
    assert list(json.loads(text)) == [*keys, "image_streams", "pictures"]


@given(st.floats(min_value=-MAX_VALUE, max_value=MAX_VALUE))
def test_every_float_of_a_row_survives_the_file_to_the_last_bit(value: float) -> None:
    result = make(rows=((0.0, value, 0.0, 0.0, "ok", 2.0),), missing_values=(), images=())
    back = loads(dumps(result)).rows[0][1]
    assert isinstance(back, float)
    assert math.copysign(1.0, back) == math.copysign(1.0, value)
    assert back == value


def test_numbers_of_numpy_become_plain_ones() -> None:
    result = make(rows=((np.float64(0.05), np.int64(3), 0.0, 0.0, "ok", 2.0),), missing_values=())
    assert repr(result.rows[0][:2]) == "(0.05, 3)"


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_result_never_holds_what_is_not_a_number(value: float) -> None:
    with pytest.raises(ResultError, match=r"rows\[0\]\[1\].*a missing value is null"):
        make(rows=((0.0, value, 0.0, 0.0, "ok", 2.0),), missing_values=())
    with pytest.raises(ResultError, match=r"facts\.S\[0\]"):
        make(facts={"S": [value, "grey level"]})


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("uwsim-result/1", "uwsim-result/9", "format is 'uwsim-result/9'.*reads 'uwsim-result/1'"),
        ('"format": "uwsim-result/1",', "", "format is None"),
        (', "ok", 2.0]', ', "ok"]', r"rows\[0\] has 5 cells, there are 6 columns"),
        ("1.83, 1.79", "NaN, 1.79", "contains NaN; a missing value is null"),
        ("1.83, 1.79", "1e999, 1.79", r"rows\[0\]\[1\] is inf"),
        ("1.83, 1.79", "true, 1.79", "'corners': True cannot be a measure"),
        ("1.83, 1.79", f"1{'0' * 400}, 1.79", "'corners': 10+ cannot be a measure"),
        ("1.83, 1.79", '"1.83", 1.79', "'corners': '1.83' cannot be a measure"),
        ("1.83, 1.79", "1e308, 1.79", r"'corners': 1e\+308 cannot be .* a number up to 1e\+60"),
        ('"level": null', '"level": [1.0, 2.0]', r"of the level \(1.0, 2.0\); expected 1 values"),
        ('"level": null', '"level": 7', r"image_streams\[0\].level is 7; expected a list"),
        ('"ok"', "1", "'status': 1 cannot be a status"),
        ('"name": "corners.mean"', '"name": "corners"', "two columns are called 'corners'"),
        ('"kind": "detail"', '"kind": "datail"', "kind 'datail'; expected one of run, level"),
        ('"unit": "s"', '"units": "s"', r"columns\[5\]: unknown key 'units'. Did you mean 'unit'"),
        ('"row": 1', '"row": 5', r"missing\[0\] is about row 5"),
        ('"row": 1', '"row": 0', r"row 0 has a value for 'corners': 1.83"),
        ('"column": "total"', '"column": "sum"', "about 'sum', which is no column"),
        ("pictures/0.png", "../0.png", "is outside the result"),
        ("pictures/0.png", "/etc/0.png", "is outside the result"),
        ('"rows"', '"lines"', '"rows" should be a list, found nothing'),
        ('"pictures"', '"picture"', "unknown key 'picture'. Did you mean 'pictures'"),
    ],
)
def test_a_wrong_file_says_what_is_wrong(tmp_path: Path, old: str, new: str, message: str) -> None:
    text = dumps(make())
    assert old in text
    (tmp_path / "result.json").write_text(text.replace(old, new, 1))
    with pytest.raises(ResultError, match=message) as caught:
        load(tmp_path)
    assert "result.json" in str(caught.value)


@given(st.integers(0, 1500))
def test_a_file_cut_off_anywhere_is_refused_and_never_half_read(cut: int) -> None:
    text = dumps(make())
    with pytest.raises(ResultError):
        loads(text[: min(cut, len(text) - 2)])


def test_a_file_cut_off_is_called_cut_off() -> None:
    text = dumps(make())
    with pytest.raises(ResultError, match="was it cut off"):
        loads(text[: text.index('"rows"') + 20])


@given(st.text(max_size=60))
def test_any_other_text_is_a_clean_error(text: str) -> None:
    with pytest.raises(ResultError):
        loads(text)


def test_deep_nesting_is_a_clean_error() -> None:
    with pytest.raises(ResultError):
        loads("[" * 100_000)


def test_no_result_and_no_text_are_clean_errors(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match="no result here"):
        load(tmp_path)
    (tmp_path / "result.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ResultError, match="not UTF-8"):
        load(tmp_path)


def test_a_detail_is_missing_for_the_reason_of_its_measure() -> None:
    assert make().reason(1, "corners.mean") == "tracker lost at 3.6 s"
    assert make().reason(0, "corners") is None


def test_columns_are_asked_for_by_name() -> None:
    assert make().numbers("corners") == (1.83, None)
    assert make().fact("f_star") == (1.083, "1/m")
    assert make().fact("sigma") is None
    with pytest.raises(UnknownName, match="Did you mean 'corners'"):
        make().values("corner")


def test_what_a_run_says_that_this_version_does_not_know_is_kept() -> None:
    result = make()
    other = replace(result, run=replace(result.run, other_values={"host": "abacus"}))
    assert loads(dumps(other)) == other
    assert '"host": "abacus"' in dumps(other)
    assert result.run.as_dict() == {k: v for k, v in other.run.as_dict().items() if k != "host"}
