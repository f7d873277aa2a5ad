"""JSON of files and peers: what Python's reader says in its own words is said in ours."""

from __future__ import annotations

import gzip
import json
from pathlib import Path

import pytest

from uwsim.base.files.json_text import MAX_DIGITS, read_json
from uwsim.base.peer_json import read_peer_json
from uwsim.errors import FileError, ResultError
from uwsim.optics import read_water
from uwsim.results.motion.motion_track import read_track
from uwsim.results.result_file import loads
from uwsim.runs.trial.pilot_inputs import read_inputs

LONG = "9" * 5000
TEXT = f'{{"name": "x",\n"count": {LONG}}}'
MESSAGE = "an integer has 5000 digits; expected at most 4000"


def test_an_integer_of_too_many_digits_is_named_with_its_line() -> None:
    with pytest.raises(json.JSONDecodeError, match=MESSAGE) as error:
        read_json(TEXT)
    assert (error.value.lineno, error.value.colno) == (2, 10)
    with pytest.raises(json.JSONDecodeError, match=MESSAGE):
        read_json(TEXT.replace("999", "-999", 1).encode())


def test_shorter_integers_are_read() -> None:
    assert read_json("-" + "9" * MAX_DIGITS) == 1 - 10**MAX_DIGITS
    assert read_json(b'{"a": [1, -2, 3.5e300]}') == {"a": [1, -2, 3.5e300]}


def test_json_that_is_nested_too_deeply_is_a_value_error() -> None:
    with pytest.raises(ValueError, match="it is nested too deeply"):
        read_json("[" * 100_000)


def test_readers_of_users_files_name_it(tmp_path: Path) -> None:
    text = f'{{"uwsim_water": 1,\n"absorption": [{LONG}]}}'
    path = tmp_path / "water.json"
    path.write_text(text)
    with pytest.raises(FileError, match=rf"water\.json:2: not JSON: {MESSAGE}"):
        read_water(path)
    with pytest.raises(ResultError, match=f"not JSON at line 2, column 16: {MESSAGE}"):
        loads(text)
    with pytest.raises(ResultError, match=MESSAGE):
        read_inputs(text.replace("\n", "").encode())
    with pytest.raises(ResultError, match=MESSAGE):
        read_track(gzip.compress(text.replace("\n", "").encode()))
    with pytest.raises(ValueError, match=MESSAGE):
        read_peer_json(text)


def test_a_water_with_an_integer_above_the_greatest_float_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "water.json"
    path.write_text(f'{{"uwsim_water": 1,\n"absorption": [{"9" * 400}]}}')
    with pytest.raises(FileError, match=r"json:2: absorption has an entry that is no finite"):
        read_water(path)
