"""``uwsim bench --record``: a recording of each trial, and the same result with and without it."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from tests.support.short_benchmark import fingerprint, write_benchmark
from uwsim.cli import main
from uwsim.results.journal import path_of
from uwsim.results.result_file import load

pytestmark = pytest.mark.slow
IMAGES = "/uwsim/camera1"
DEBUGS = """
import numpy as np
from uwsim.messages import Empty, Float64MultiArray, Image, String

class Debugs:
    \"\"\"Says what nobody reads, out of one array, and what no message is.\"\"\"

    def start(self, node):
        self.numbers = np.zeros(3)
        self.say = node.publisher("/debug", Float64MultiArray)
        self.wrong = node.publisher("/wrong", String)
        node.subscribe("/uwsim/camera1", Image, self.see)
        node.call("startBench", Empty())
        node.create_timer(0.05, self.tick)

    def see(self, image):
        pass

    def tick(self):
        self.numbers += 1.0
        self.say(Float64MultiArray(data=self.numbers))
        self.wrong(String(data=7))
"""


@pytest.fixture
def benchmark(tmp_path: Path) -> str:
    return str(write_benchmark(tmp_path, "0.2"))


def bench(*arguments: object) -> int:
    return main(["bench", *map(str, arguments)])


def counted(path: Path) -> dict[str, int]:
    """Topic -> how many messages a recording has on it."""
    with AnyReader([path], default_typestore=get_typestore(Stores.EMPTY)) as reader:
        return {topic: each.msgcount for topic, each in reader.topics.items()}


def digests(folder: Path, pattern: str) -> dict[str, str]:
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in folder.glob(pattern)}


def test_one_trial_is_recorded_in_the_file_and_the_result_keeps_its_bytes(
    benchmark: str, tmp_path: Path
) -> None:
    recorded, plain = tmp_path / "recorded", tmp_path / "plain"
    file = tmp_path / "dive.mcap"
    assert bench(benchmark, "--out", plain) == 0
    assert bench(benchmark, "--out", recorded, "--record", file) == 0
    assert fingerprint(recorded) == fingerprint(plain)
    found = counted(file)
    assert found[IMAGES] > 10
    assert found["/scene"] == found["/robot_description"] == 1
    assert found["/cornersTopic"] > 10
    assert not list(tmp_path.glob(".dive*"))


def test_images_that_nobody_reads_are_not_drawn_for_the_recording(
    benchmark: str, tmp_path: Path
) -> None:
    recorded, plain = tmp_path / "recorded", tmp_path / "plain"
    call = [benchmark, "--algorithm", "frozen", "--level", "fog=0"]
    assert bench(*call, "--out", plain) == 0
    assert bench(*call, "--out", recorded, "--record", tmp_path / "f.bag", "--images", "none") == 0
    assert fingerprint(recorded) == fingerprint(plain)
    assert IMAGES not in counted(tmp_path / "f.bag")


def test_each_trial_has_a_file_of_its_own_whatever_the_workers(
    benchmark: str, tmp_path: Path
) -> None:
    call = [benchmark, "--mode", "independent", "--images", "none", "--level", "fog=0"]
    for workers in "02":
        (folder := tmp_path / workers).mkdir()
        out = tmp_path / f"out{workers}"
        how = ["--repeat", "2", "--workers", workers, "--out", out, "--record", folder / "d.mcap"]
        assert bench(*call, *how) == 0
    assert sorted(p.name for p in (tmp_path / "0").iterdir()) == ["d-00000.mcap", "d-00001.mcap"]
    assert digests(tmp_path / "0", "*") == digests(tmp_path / "2", "*")
    assert len(set(digests(tmp_path / "0", "*").values())) == 2


def test_a_program_that_only_a_recorder_hears_is_none_the_more_checked(
    benchmark: str, tmp_path: Path
) -> None:
    (tmp_path / "debugs.py").write_text(DEBUGS)
    recorded, plain = tmp_path / "recorded", tmp_path / "plain"
    call = [benchmark, "--algorithm", f"{tmp_path}/debugs.py:Debugs", "--level", "fog=0"]
    call += ["--in-process"]
    assert bench(*call, "--out", plain) == 0
    assert bench(*call, "--out", recorded, "--record", tmp_path / "d.mcap") == 0
    assert fingerprint(recorded) == fingerprint(plain)
    assert counted(tmp_path / "d.mcap")["/debug"] > 3
    assert "/wrong" not in counted(tmp_path / "d.mcap")
    with AnyReader([tmp_path / "d.mcap"]) as reader:
        (debug,) = [c for c in reader.connections if c.topic == "/debug"]
        heard: list[Any] = [
            reader.deserialize(data, each.msgtype) for each, _, data in reader.messages([debug])
        ]
    said = [message.data[0] for message in heard]
    assert said == sorted(set(said))


def test_resumed_trials_are_recorded_anew_and_finished_ones_kept(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, file = tmp_path / "out", tmp_path / "dive.mcap"
    call = [benchmark, "--repeat", "2", "--level", "fog=0", "--images", "none", "--out", out]
    assert bench(*call, "--record", file) == 0
    before = digests(tmp_path, "*.mcap")
    assert sorted(before) == ["dive-00000.mcap", "dive-00001.mcap"]
    lines = path_of(out, 1).read_text().splitlines(keepends=True)
    path_of(out, 1).write_text("".join(lines[:-1]))
    (tmp_path / "dive-00001.mcap").write_bytes(b"cut off")
    (tmp_path / "dive-00000.mcap").unlink()
    capsys.readouterr()
    assert bench(*call, "--record", file, "--resume") == 0
    assert digests(tmp_path, "*.mcap") == {"dive-00001.mcap": before["dive-00001.mcap"]}
    said = capsys.readouterr().err
    assert "dive-00000.mcap is not written: its trial is finished, and is not run again" in said


def test_overwriting_another_run_records_too(benchmark: str, tmp_path: Path) -> None:
    out, file = tmp_path / "out", tmp_path / "dive.bag"
    call = [benchmark, "--algorithm", "frozen", "--level", "fog=0", "--out", out]
    assert bench(*call) == 0
    assert bench(*call, "--seed", "1", "--overwrite", "--record", file) == 0
    assert load(out).run.seed == 1
    assert counted(file)["/scene"] == 1


def test_what_cannot_be_recorded_is_refused_before_anything_runs(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    (tmp_path / "there-00001.mcap").touch()
    for file, said in (
        ("dive.txt", "only .mcap and .bag files are written"),
        ("nowhere/dive.mcap", "there is no folder"),
        ("out/dive.mcap", "is in the result directory"),
        ("there.mcap", "there-00001.mcap: the file exists; --overwrite replaces it"),
    ):
        call = ["--repeat", "2", "--out", out, "--record", tmp_path / file, "--images", "pmg"]
        assert bench(benchmark, *call) == 2
        assert "--images 'pmg'" in capsys.readouterr().err
        assert bench(benchmark, *call[:-2]) == 2
        assert said in capsys.readouterr().err
    assert not out.exists()
