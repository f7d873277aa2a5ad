"""The file of an author runs in no process that plans, simulates or compares."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.support.small_suite import run_suite
from uwsim.benchmark.plugin import read_isolated
from uwsim.errors import BadSetting, PluginError
from uwsim.results.result_file import load
from uwsim.runs.own_process.description import describe_program
from uwsim.suites.suite import Suite
from uwsim.suites.verification import verify_submission

CHEAT = '''
import sys

from helper import GAIN
from uwsim.algorithms.position import PositionPI
from uwsim.bus.bus import Bus

Bus.hide_topic = lambda self, topic, reason="": None
verification = sys.modules.get("uwsim.suites.verification")
if verification is not None:
    verification._false_claims = verification._compare = lambda *arguments: []


class Cheat(PositionPI):
    """Reads the true odometry in a track that does not permit it."""

    PARAMETERS = {**PositionPI.PARAMETERS, "kp": GAIN}
'''


def test_a_file_that_changes_the_simulator_changes_no_row_and_no_verdict(
    small_suite: Path, suite: Suite, tmp_path: Path
) -> None:
    (tmp_path / "cheat.py").write_text(CHEAT)
    (tmp_path / "helper.py").write_text("GAIN = 1.1\n")
    words = ["--algorithm", f"near={tmp_path}/cheat.py:Cheat", "--include", f"{tmp_path}/helper.py"]
    entry = run_suite(small_suite, tmp_path / "entry", *words, "--track", "a", "--short", status=3)
    result = load(entry / "near-v1")
    assert set(result.values("status")) == {"algorithm error"}
    assert set(result.inputs.algorithm or {}) == {"cheat.py", "helper.py"}
    assert verify_submission(entry, suite, "x").verdict == "verified"
    path = entry / "near-v1" / "result.json"
    path.write_text(path.read_text().replace('"algorithm error"', '"ok"'))
    assert verify_submission(entry, suite, "x").verdict == "differs"
    files = [str(getattr(module, "__file__", "")) for module in list(sys.modules.values())]
    assert not [file for file in files if file.startswith(str(tmp_path))]


@pytest.mark.parametrize(
    ("source", "kind", "message"),
    [
        ("x = 1\nraise ValueError('no weights')\n", PluginError, "mine.py:2: .*no weights"),
        ("import os\nos._exit(3)\n", BadSetting, "exit status 3"),
        ("class Mine:\n    pass\n", BadSetting, "has no method start"),
    ],
)
def test_a_file_that_cannot_be_imported_is_a_clean_error(
    source: str, kind: type[Exception], message: str, tmp_path: Path
) -> None:
    (tmp_path / "mine.py").write_text(source)
    plugin = read_isolated(tmp_path / "mine.py", "mine.py")
    with pytest.raises(kind, match=message):
        describe_program("mine.py:Mine", plugin, tmp_path, {})
