"""``uwsim envelope``: one number with its bound, the same bytes twice, runs used again."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import pytest

from uwsim.cli import main
from uwsim.envelope.search_request import round_down
from uwsim.results.directory import lock_directory

PARTS = '''
from dataclasses import dataclass
from typing import ClassVar

from uwsim.benchmark.measures import Measure, MeasureSpec
from uwsim.benchmark.updaters import SceneUpdater, SceneUpdaterSpec
from uwsim.schema import element
from uwsim.messages import Float32MultiArray, String, floats


@dataclass(frozen=True, kw_only=True)
class LoadSpec(SceneUpdaterSpec):
    """A load from 0 to 1."""

    name: ClassVar[str] = "load"
    unit: ClassVar[str] = "N"
    initial_value: float = element(default=0.0, minimum=0.0)
    """Smallest [N]."""

    def values(self):
        return (self.initial_value, 1.0)

    @property
    def seconds_per_level(self):
        return 0.004

    def bind(self, stage):
        return Load(stage)


class Load(SceneUpdater):
    def __init__(self, stage):
        self.tell = stage.bus.publisher("load", Float32MultiArray)

    def apply(self, value):
        self.tell(floats([value]))


@dataclass(frozen=True, kw_only=True)
class StrainSpec(MeasureSpec):
    """The load, and chance."""

    def bind(self, world):
        return Strain(world)


class Strain(Measure):
    unit = "px"

    def __init__(self, world):
        self.inbox = world.bus.inbox("load", Float32MultiArray)
        self.chance = 0.02 * float(world.stream("strain").normal())
        self.load = 0.0

    def start(self):
        pass

    def update(self):
        for message in self.inbox.take():
            self.load = float(message.data[0])

    @property
    def value(self):
        return 10.0 * (self.load + self.chance)


class Idle:
    """Starts the benchmark, and says that it is lost where the load is above 0.9."""

    def start(self, node):
        from uwsim.messages import Empty

        say = node.publisher("algorithmStatus", String)
        node.subscribe(
            "load", Float32MultiArray,
            lambda m: say(String(data="lost: too much")) if m.data[0] > 0.9 else None,
        )
        node.call("startBench", Empty())


MEASURES, UPDATERS, ALGORITHMS = {"strain": StrainSpec}, {"load": LoadSpec}, {"idle": Idle}
'''

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="idle">
  <measures> <u:strain> <name>strain</name> </u:strain> </measures>
  <startOn> <type>service</type> <target>startBench</target> </startOn>
  <stopOn> <type>never</type> </stopOn>
  <function>strain</function>
  <sceneUpdater> <u:load> NEST </u:load> </sceneUpdater>
</benchmark>
"""
NESTED = """<sceneUpdater> <sceneFogUpdater> <initialValue>0</initialValue>
  <finalValue>1</finalValue> <step>0.5</step> <interval>0.004</interval>
  </sceneFogUpdater> </sceneUpdater>"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "own.py").write_text(PARTS)
    (tmp_path / "b.xml").write_text(BENCHMARK.replace("NEST", ""))
    (tmp_path / "nested.xml").write_text(BENCHMARK.replace("NEST", NESTED))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def envelope(capsys: pytest.CaptureFixture[str], *options: str) -> tuple[int, list[str]]:
    status = main(["envelope", "b.xml", "--plugin", "own.py", "--over", "load", *options])
    captured = capsys.readouterr()
    return status, (captured.out + captured.err).splitlines()


def stored(folder: Path, name: str = "b.envelope") -> dict[str, Any]:
    document: dict[str, Any] = json.loads((folder / name / "envelope.json").read_text())
    return document


@pytest.mark.slow
def test_a_breaking_point_is_one_number_with_its_bound_and_its_runs_are_used_again(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    search = ["--until", "strain > 5", "--repeat", "6", "--tolerance", "0.1", "--to", "0.8"]
    status, said = envelope(capsys, *search)
    assert status == 0, said
    assert said[0].startswith("load 0.5")
    assert said[0].endswith(")")
    assert " N (95 %: 0." in said[0]
    assert said[1].startswith("6 seeds, ")
    found = stored(folder)
    assert found["low"] <= 0.5 <= found["high"]
    assert found["verdict"] == "breaks"
    assert found["confidence_of_limits"] == 1 - 2 / 64
    assert (found["unit"], found["from"], found["to"], found["fixed"]) == ("N", 0.0, 0.8, {})
    assert found["inputs"]["plugins"][0][0] == "own.py"
    assert (folder / "b.envelope" / "envelope.png").stat().st_size > 10_000
    runs = found["evaluations"]
    assert runs == sorted(runs, key=lambda run: (run["level"], run["seed"]))
    assert all(run["broken"] == (run["measures"]["strain"] > 5) for run in runs)

    before = (folder / "b.envelope" / "envelope.json").read_bytes()
    n_units = len(list((folder / "b.envelope" / "units").glob("*.jsonl")))
    assert len(runs) == n_units
    assert envelope(capsys, *search)[0] == 2  # not empty

    status, said = envelope(capsys, *search[:1], "strain > 4", *search[2:], "--resume")
    assert status == 0
    assert said[0].startswith("load 0.4")
    n_more = len(list((folder / "b.envelope" / "units").glob("*.jsonl")))
    assert n_units < n_more < 1.7 * n_units  # the runs of the first search were used
    assert envelope(capsys, *search, "--resume")[0] == 0
    assert (folder / "b.envelope" / "envelope.json").read_bytes() == before

    (folder / "b.envelope" / "envelope.json").unlink()  # as after a search that was killed
    capsys.readouterr()
    assert main(["report", "b.envelope"]) == 2
    how = shlex.join(["uwsim envelope b.xml --plugin own.py --over load", *search]).replace("'", "")
    said_now = capsys.readouterr().err.replace("'", "")
    assert (
        f"but the runs of an envelope: its search was interrupted. Resume with: {how}" in said_now
    )


@pytest.mark.slow
def test_two_workers_find_the_same_bytes_as_one(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    search = ["--until", "strain > 5", "--repeat", "3", "--tolerance", "0.1", "--in-process"]
    assert envelope(capsys, *search)[0] == 0
    assert envelope(capsys, *search, "--out", "two", "--workers", "2")[0] == 0
    for name in ("envelope.json", "units"):
        one, two = folder / "b.envelope" / name, folder / "two" / name
        if one.is_file():
            assert one.read_bytes() == two.read_bytes()
        else:
            files = [sorted((p.name, p.read_bytes()) for p in d.iterdir()) for d in (one, two)]
            assert files[0] == files[1]


def test_runs_that_another_search_writes_are_not_overwritten(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "out" / "units").mkdir(parents=True)
    (folder / "out" / "units" / "00000.jsonl").touch()
    given = ["--plugin", "own.py", "--over", "load", "--until", "strain > 5", "--overwrite"]
    with lock_directory(folder / "out"):
        assert main(["envelope", "b.xml", *given, "--out", "out"]) == 2
    assert "another run is writing into it" in capsys.readouterr().err
    assert (folder / "out" / "units" / "00000.jsonl").exists()


@pytest.mark.parametrize(
    ("options", "wrong"),
    [
        (["--over", "lod"], "--over lod: this benchmark sweeps load. Did you mean 'load'?"),
        (["--until", "strain >> 5"], "'>' is not allowed here"),
        (["--until", "stran > 5"], "Did you mean 'strain'?"),
        (["--from", "-1"], "--from -1: load must be a number >= 0 [N]."),
        (["--from", "1"], "--from and --to are both 1"),
        (["--tolerance", "2"], "--tolerance is 2; expected more than 0 and less than 1."),
        (["--tolerance", "nan"], "--tolerance is nan; expected"),
        (["--tolerance", "1e-12"], "--tolerance 1e-12 is too fine"),
        (["--to", "inf"], "--to is inf; expected a number."),
        (["--to", "1e300"], "--to is 1e+300; no quantity is beyond 1e+09."),
        (["--confidence", "95"], "--confidence is 95; expected"),
        (["--level", "fog=1"], "--level fog: this benchmark sweeps load."),
        (["--level", "load=1"], "--level load: the search varies this parameter itself."),
        (["--resume", "--overwrite"], "--resume and --overwrite exclude each other."),
    ],
)
def test_each_mistake_is_one_clean_error_and_nothing_is_written(
    folder: Path, capsys: pytest.CaptureFixture[str], options: list[str], wrong: str
) -> None:
    given = ["--until", "strain > 5", *options]
    status = main(["envelope", "b.xml", "--plugin", "own.py", "--over", "load", *given])
    said = capsys.readouterr().err
    assert status == 2
    assert wrong in said
    assert not (folder / "b.envelope").exists()


def test_all_mistakes_are_reported_at_once(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["envelope", "b.xml", "--plugin", "own.py", "--over", "load", "--until", "stran > 5"]
    mistakes = [
        "--to",
        "-1",
        "--confidence",
        "95",
        "--level",
        "fog=1",
        "--set",
        "x",
        "--workers",
        "two",
    ]
    assert main([*call, *mistakes]) == 2
    said = capsys.readouterr().err
    assert sum(line.startswith("uwsim: ") for line in said.splitlines()) == 3
    assert main([*call, *mistakes[:6]]) == 2
    said = capsys.readouterr().err
    assert sum(line.startswith("uwsim: ") for line in said.splitlines()) == 4


@pytest.mark.slow
def test_a_second_updater_needs_a_chosen_value(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["envelope", "nested.xml", "--plugin", "own.py", "--over", "load"]
    call += ["--until", "strain > 5", "--repeat", "1", "--tolerance", "0.5", "--in-process"]
    assert main(call) == 2
    assert "also sweeps fog (3 levels); choose one, as --level fog=0" in capsys.readouterr().err
    assert main([*call, "--level", "fog=0.7"]) == 0
    assert stored(folder, "nested.envelope")["fixed"] == {"fog": 0.7}


def test_a_width_is_rounded_down_to_one_two_or_five() -> None:
    assert [round_down(w) for w in (0.013, 0.02, 0.0499, 7.0, 1000.0)] == [
        0.01,
        0.02,
        0.02,
        5,
        1000,
    ]
