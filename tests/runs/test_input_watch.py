"""A file of a run that is edited while the run goes on: no row is kept that may be made of it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.support.short_trial import INIT_TRIGGER, make_plan, with_algorithm
from uwsim.base.files.input_files import InputFile, compute_hash
from uwsim.bus import Node
from uwsim.errors import RunFailed
from uwsim.results.inputs import Inputs
from uwsim.runs.executors.executor import run_each
from uwsim.runs.input_watch import InputWatch, unique_files
from uwsim.runs.run import Run

LEVELS = """<sceneFogUpdater> <initialValue>0</initialValue> <finalValue>0.2</finalValue>
<step>0.1</step> <interval>0.1</interval> </sceneFogUpdater>"""


def file_of(path: Path) -> InputFile:
    return InputFile(path.name, compute_hash(path), path)


class Edits:
    """Writes into a file in the second of three levels."""

    def start(self, node: Node) -> None:
        path = Path(str(node.parameters["path"]))
        node.create_timer(0.1, lambda: path.write_text("other") if node.now > 0.15 else None)


def test_a_row_is_kept_only_while_all_files_are_as_they_were(tmp_path: Path) -> None:
    (tmp_path / "box.png").write_text("texture")
    plan = make_plan(tmp_path, Edits, LEVELS, start=INIT_TRIGGER)
    plan = with_algorithm(plan, parameters={"path": str(tmp_path / "box.png")})
    files = unique_files([file_of(tmp_path / "box.png")])
    bench = Run(plan=plan, out=tmp_path / "out", inputs=Inputs(), renderer="none", files=files)
    outcome = run_each([bench])
    [(_, error)] = outcome.failures
    assert isinstance(error, RunFailed)
    assert f"{tmp_path}/box.png was changed (" in str(error)
    assert len(outcome.results[0].rows) == 1


def test_what_was_changed_is_named_and_what_was_only_touched_is_not(tmp_path: Path) -> None:
    for name in ("a", "b", "bag/c"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(name)
    watch = InputWatch(unique_files([file_of(tmp_path / name) for name in ("a", "b", "bag")]))
    watch.check()
    os.utime(tmp_path / "a")
    watch.check()
    (tmp_path / "bag" / "c").write_text("C")
    with pytest.raises(RunFailed, match=f"During the run {tmp_path}/bag was changed"):
        watch.check()
    (tmp_path / "bag" / "c").write_text("bag/c")
    watch.check()
    (tmp_path / "b").unlink()
    shutil.rmtree(tmp_path / "bag")
    said = "/b became unreadable .No such file .*; .*/bag became unreadable"
    with pytest.raises(RunFailed, match=said):
        watch.check()


def test_files_are_found_by_a_worker_that_has_gone_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a").write_text("a")
    files = unique_files(
        [file_of(Path("a")), InputFile("made", "sha256:0"), file_of(tmp_path / "a")]
    )
    assert [file.path for file in files] == [tmp_path / "a"]
