"""Plugins: a user's parts come in with one file; wrong ones leave with a clean error."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
import textwrap
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from uwsim.benchmark.plugin import Plugin, attribute_errors_to, read_plugin
from uwsim.checks.benchmark_tables import bundled_tables, read_plugins
from uwsim.cli import main
from uwsim.errors import BadSetting, PluginError, RunFailed
from uwsim.results.result import Result
from uwsim.runs.executors.executor import run_all
from uwsim.runs.executors.processes import ProcessExecutor
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan import Plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.runs.run import Run

PARTS = '''
from dataclasses import dataclass
from typing import ClassVar

from uwsim.benchmark.measures import Measure, MeasureSpec
from uwsim.benchmark.triggers import Trigger, TriggerSpec
from uwsim.benchmark.updaters import SceneUpdater, SceneUpdaterSpec
from uwsim.schema import element
from uwsim.world import Stage, World


@dataclass(frozen=True, kw_only=True)
class CountSpec(MeasureSpec):
    """How many steps it was on."""

    weight: float = element(default=1.0, exclusive_minimum=0.0)
    """What a step counts."""

    def bind(self, world: World) -> "Count":
        return Count(self.weight)


class Count(Measure):
    unit = "1"

    def __init__(self, weight: float) -> None:
        self.weight, self.n = weight, 0

    def start(self) -> None:
        pass

    def update(self) -> None:
        self.n += 1

    @property
    def value(self) -> float:
        return self.weight * self.n


@dataclass(frozen=True, kw_only=True)
class LateSpec(TriggerSpec):
    """On from a time on."""

    after: float
    """When [s]."""

    def bind(self, world: World) -> "Late":
        return Late(world, self.after)


class Late(Trigger):
    def __init__(self, world: World, after: float) -> None:
        self.world, self.after = world, after

    def is_on(self) -> bool:
        return self.world.time >= self.after


@dataclass(frozen=True, kw_only=True)
class MurkSpec(SceneUpdaterSpec):
    """Fog in two levels."""

    name: ClassVar[str] = "murk"
    unit: ClassVar[str] = "1/m"
    thick: float = element(minimum=0.0)
    """Fog of the second level [1/m]."""

    def values(self) -> tuple[float, ...]:
        return (0.0, self.thick)

    @property
    def seconds_per_level(self) -> float:
        return 0.1

    def bind(self, stage: Stage) -> "Murk":
        return Murk(stage)


class Murk(SceneUpdater):
    def __init__(self, stage: Stage) -> None:
        self.stage = stage

    def apply(self, value: float) -> None:
        self.stage.set_fog(value)


class Idle:
    """Starts the benchmark and rests."""

    def start(self, node) -> None:
        from uwsim.messages import Empty

        node.call("startBench", Empty())


MEASURES = {"count": CountSpec}
TRIGGERS = {"late": LateSpec}
UPDATERS = {"murk": MurkSpec}
ALGORITHMS = {"idle": Idle}
'''

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="idle"
    u:mode="independent">
  <measures>
    <u:count>
      <name>steps</name> <weight>2</weight>
      <startOn> <type>u:late</type> <after>0.02</after> </startOn>
    </u:count>
  </measures>
  <startOn> <type>service</type> <target>startBench</target> </startOn>
  <stopOn> <type>never</type> </stopOn>
  <function>steps</function>
  <sceneUpdater> <u:murk> <thick>0.5</thick> </u:murk> </sceneUpdater>
</benchmark>
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "parts.py").write_text(PARTS)
    (tmp_path / "b.xml").write_text(BENCHMARK)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def plugin(folder: Path, text: str, name: str = "own.py") -> Path:
    path = folder / name
    path.write_text(textwrap.dedent(text))
    return path


def said(file: Path) -> str:
    with pytest.raises(PluginError) as caught:
        read_plugins([file])
    return str(caught.value)


def plan_of(benchmark: str, *plugins: Path, **changed: Any) -> Plan:
    given: dict[str, Any] = {
        "scene": None, "algorithm": None, "seed": 0, "repeat": 1, "mode": None, "levels": [],
        "settings": [], "compat": [], "data_path": (), "plugins": plugins,
    }  # fmt: skip
    return make_plan(PlanRequest(benchmark=benchmark, **given | changed))


@pytest.mark.slow
def test_a_benchmark_of_nothing_but_own_parts_is_played_by_two_workers(folder: Path) -> None:
    plan = plan_of("b.xml", folder / "parts.py")
    inputs, renderer = hash_inputs(plan)
    run = Run(plan=plan, out=folder / "out", inputs=inputs, renderer=renderer)
    [result] = run_all([run], ProcessExecutor(2))
    assert result.values("murk") == (0.0, 0.5)
    assert result.columns[0].unit == "1/m"
    assert result.numbers("steps") == (100.0, 100.0)  # on at its first step: 0.1 s / 2 ms, twice
    assert result.inputs.plugins == (("parts.py", read_plugin(folder / "parts.py").sha256),)


def test_a_file_that_uses_a_plugin_says_so_when_it_was_not_given(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "b.xml"]) == 2
    printed = capsys.readouterr().out
    assert printed.count("--plugin FILE.py") == 2
    assert main(["check", "b.xml", "--plugin", "parts.py"]) == 0


def test_own_parts_are_listed_with_their_sentences(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for kind, name, sentence in (
        ("measures", "u:count", "How many steps it was on."),
        ("triggers", "u:late", "On from a time on."),
        ("updaters", "u:murk", "Fog in two levels."),
        ("algorithms", "idle", "Starts the benchmark and rests."),
    ):
        assert main(["list", kind, "--plugin", "parts.py"]) == 0
        line = capsys.readouterr().out.splitlines()[-1]
        assert (line.split()[0], line.split(maxsplit=1)[1].strip()) == (name, sentence)


def test_limits_of_own_fields_are_held(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "b.xml").write_text(BENCHMARK.replace("<weight>2", "<weight>0"))
    assert main(["check", "b.xml", "--plugin", "parts.py"]) == 2
    assert "b.xml:5: <weight> is '0'; expected a number > 0" in capsys.readouterr().out


def test_a_plan_brings_its_plugins_to_a_process_that_has_never_seen_them(folder: Path) -> None:
    plan = plan_of("b.xml", folder / "parts.py")
    (folder / "plan.pickle").write_bytes(pickle.dumps({"what": [plan.benchmark.path, plan]}))
    (folder / "parts.py").unlink()
    code = (
        "import pickle; plan = pickle.load(open('plan.pickle', 'rb'))['what'][1]; "
        "names = [type(plan.benchmark.measures[0]).__name__, plan.algorithm.cls.__name__]; "
        "print(*names, plan.plugins)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stdout.strip() == f"CountSpec Idle (Plugin(path='{folder}/parts.py'),)", done.stderr
    assert pickle.loads(pickle.dumps(plan)) == plan
    assert replace(plan, seed=1).plugins == plan.plugins


def test_a_result_without_plugins_does_not_mention_them(folder: Path) -> None:
    inputs, _ = hash_inputs(plan_of("visibility"))
    assert set(inputs.as_dict()) == {"benchmark", "scene", "assets"}


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("x = 1", "own.py: declares none of MEASURES, TRIGGERS, UPDATERS, ALGORITHMS"),
        ("MEASURE = {}", "Did you mean 'MEASURES'?"),
        ("def f(:", "own.py:1: not Python: invalid syntax"),
        ("\n\nimport numpyy", "own.py:3: cannot be imported: ModuleNotFoundError"),
        ("\n1 / 0", "own.py:2: cannot be imported: ZeroDivisionError: division by zero"),
        ("import sys; sys.exit(0)", "own.py:1: cannot be imported: SystemExit: 0"),
        ("MEASURES = [1]", "MEASURES is list; expected a dict"),
        ("MEASURES = {'a': 1}", "MEASURES['a']: is int '1'; expected a class"),
        ("MEASURES = {'a b': int}", "letters and digits only"),
        ("MEASURES = {'u:a': int}", "write 'a'"),
        ("MEASURES = {'a': int}", "MEASURES['a']: int is no MeasureSpec"),
        ("ALGORITHMS = {'a': int}", "ALGORITHMS['a']: int has no start(node)"),
        ("ALGORITHMS = {'a:b': int}", "letters, digits, '_', '.' and '-' only"),
        (
            "ALGORITHMS = {'esm': type('A', (), {'start': print})}",
            "must be at module level",
        ),
        (PARTS + "\nMEASURES = {'count': Count}", "Count is no MeasureSpec; declare its spec"),
        (
            PARTS + "\nclass B(CountSpec):\n    extra: int = 1\nMEASURES = {'b': B}",
            "B lacks @dataclass(frozen=True, kw_only=True)",
        ),
        (PARTS + "\nclass B(MeasureSpec): pass\nMEASURES = {'b': B}", "B lacks bind"),
        (
            PARTS + "\n@dataclass(frozen=True, kw_only=True)\n"
            "class B(CountSpec):\n    extra: 'Nothing'\nMEASURES = {'b': B}",
            "the fields of B cannot be read: NameError",
        ),
        (
            PARTS + "\n@dataclass(frozen=True, kw_only=True)\n"
            "class B(MurkSpec):\n    name: ClassVar[str] = 'a b'\nUPDATERS = {'b': B}",
            "B has the name 'a b'",
        ),
        (
            PARTS.replace("    def values(", "    def faults(self): return ()\n\n    def values("),
            "MurkSpec.faults is not used; rename it to errors",
        ),
        (PARTS + "\nALGORITHMS = {'esm': Idle}", "'esm' is a name of uwsim; choose another name"),
    ],
)
def test_each_mistake_in_a_plugin_is_one_clean_error(tmp_path: Path, text: str, wrong: str) -> None:
    found = said(plugin(tmp_path, text))
    assert wrong in found
    assert len(found.splitlines()) == 1


def test_a_file_that_is_not_there_or_no_file_is_reported(tmp_path: Path) -> None:
    assert "none.py: cannot be read: No such file or directory" in said(tmp_path / "none.py")
    assert "is not a regular file: not a plugin" in said(tmp_path)
    (tmp_path / "bytes.py").write_bytes(b"\xff\xfe\x00")
    assert "bytes.py" in said(tmp_path / "bytes.py")


def test_two_plugins_with_one_name_are_an_error_that_names_both(folder: Path) -> None:
    other = plugin(folder, PARTS + "\n# other\n", "other.py")
    with pytest.raises(PluginError) as caught:
        read_plugins([folder / "parts.py", other])
    lines = str(caught.value).splitlines()
    assert len(lines) == 4
    assert all("is in" in line and "parts.py, too" in line for line in lines)
    assert lines[0].startswith(f"{other}:12: MEASURES['count']")


def test_one_plugin_given_twice_is_an_error(folder: Path) -> None:
    with pytest.raises(BadSetting, match=r"is the same plugin as parts\.py"):
        read_plugins([Path("parts.py"), folder / "parts.py"])


def test_bundled_tables_are_not_changed_by_a_plugin(folder: Path) -> None:
    before = bundled_tables()
    _, tables = read_plugins([folder / "parts.py"])
    assert set(tables.measures) - set(before.measures) == {"u:count"}
    assert bundled_tables() == before


@pytest.mark.parametrize(
    ("was", "now", "wrong"),
    [
        ("return Count(self.weight)", "pass", "CountSpec.bind gives None; expected a Measure"),
        ('unit = "1"', "", "Count has no unit"),
        ("return Late(world, self.after)", "return 1 / 0", "parts.py:48: ZeroDivisionError"),
        ("return Murk(stage)", "return stage", "MurkSpec.bind gives StageView"),
        ("return (0.0, self.thick)", "return ()", "at least one level"),
        ("return (0.0, self.thick)", "return self.thin", "AttributeError: 'MurkSpec' object has"),
    ],
)
def test_what_a_part_gives_is_checked_before_anything_is_played(
    folder: Path, capsys: pytest.CaptureFixture[str], was: str, now: str, wrong: str
) -> None:
    assert was in PARTS
    (folder / "parts.py").write_text(PARTS.replace(was, now))
    assert main(["bench", "b.xml", "--plugin", "parts.py", "--out", "out"]) == 2
    said = capsys.readouterr().err
    assert wrong in said
    assert len(said.splitlines()) == 1
    assert not (folder / "out").exists()


def test_the_line_of_the_plugin_that_raised_is_named(tmp_path: Path) -> None:
    path = plugin(tmp_path, "def f():\n    return {}['x']\nALGORITHMS = {}\n")
    own = read_plugin(path)
    with pytest.raises(PluginError, match=r"own\.py:2: KeyError: 'x'"), attribute_errors_to([own]):
        own.module().f()
    with (
        pytest.raises(RunFailed, match=r"own\.py:2: KeyError: 'x' \(at noon\)"),
        attribute_errors_to([own], describe_progress=lambda: "at noon"),
    ):
        own.module().f()
    with pytest.raises(KeyError), attribute_errors_to([own]):
        {}["y"]
    assert own == Plugin(str(path), path.read_bytes())


@pytest.mark.parametrize(
    ("error", "said"),
    [
        ("ValueError('two\\nlines')", "own.py:2: ValueError: two lines"),
        ("SystemExit(5)", "own.py:2: SystemExit: 5"),
        ("MemoryError", "own.py:2: MemoryError"),
    ],
)
def test_whatever_a_plugin_raises_is_one_line(tmp_path: Path, error: str, said: str) -> None:
    own = read_plugin(plugin(tmp_path, f"def f():\n    raise {error}\nALGORITHMS = {{}}\n"))
    with pytest.raises(RunFailed) as caught, attribute_errors_to([own], describe_progress=str):
        own.module().f()
    assert str(caught.value).endswith(f"{said} ()")


def play(folder: Path, was: str, now: str) -> Result:
    assert was in PARTS
    (folder / "parts.py").write_text(PARTS.replace(was, now))
    plan = plan_of("b.xml", folder / "parts.py", levels=[("murk", 0.0)], in_process=True)
    inputs, renderer = hash_inputs(plan)
    bench = Run(plan=plan, out=folder / "out", inputs=inputs, renderer=renderer)
    return run_all([bench])[0]


def test_a_measure_that_raises_ends_the_run_with_its_line(folder: Path) -> None:
    said = r"parts\.py:33: ZeroDivisionError: division by zero \(level murk=0, seed 0, at 0\.022"
    with pytest.raises(RunFailed, match=said):
        play(folder, "self.n += 1", "self.n = 1 / 0")


@pytest.mark.parametrize(
    ("attribute", "gives", "said"),
    [
        ("details", "[1.0]", "is list; expected a dict by names of details"),
        ("details", "{1: 2.0}", "has the key 1; expected a name"),
        ("detail_units", "{'a': None}", "has NoneType for 'a', no text"),
        ("reasons", "{'fastest': 'asleep'}", "is about 'fastest', which is no detail without a"),
        ("missing_reason", "404", "is int '404'; expected text or None"),
        ("notes", "'slow'", "is str 'slow'; expected a tuple of text"),
        ("ends_level", "7", "is int '7'; expected text or None"),
        ("longest_silence", "None", "is NoneType; expected a time [s]"),
        ("log_values", "(1.0, 2.0)", "has 2 values; log_header has 1 names"),
        ("log_values", "1.0", "is float '1.0'; expected a tuple of numbers"),
        ("log_header", "('a', 'b')", "has 1 values; log_header has 2 names"),
    ],
)
def test_a_measure_that_answers_otherwise_than_promised_ends_the_run_with_its_line(
    folder: Path, attribute: str, gives: str, said: str
) -> None:
    value = "    @property\n    def value(self) -> float:\n"
    own = f"    @property\n    def {attribute}(self):\n        return {gives}\n\n"
    (folder / "b.xml").write_text(BENCHMARK.replace("</name>", "</name> <log>0.02</log>", 1))
    with pytest.raises(RunFailed) as caught:
        play(folder, value, own + value)
    whose = "log_values" if attribute == "log_header" else attribute
    at = value if whose == attribute else "class Count(Measure)"
    line = PARTS.split(at)[0].count("\n") + 1
    expected = re.escape(f"{folder}/parts.py:{line}: Count.{whose} {said}")
    assert re.match(expected, str(caught.value)), str(caught.value)


def test_a_detail_that_is_no_number_leaves_a_reason(folder: Path) -> None:
    value = "    @property\n    def value(self) -> float:\n"
    own = "    @property\n    def details(self):\n        return {'a': 'x', 'b': 1e99, 'c': None}\n"
    result = play(folder, value, own + value)
    assert [result.values(f"steps.{name}") for name in "abc"] == [(None,)] * 3
    assert result.reason(0, "steps.a") == "it gave str 'x', which is no number"
    assert result.reason(0, "steps.b") == "it gave 1e+99, beyond what can be reckoned with (1e+60)"


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ("['kp']", "is list; expected a dict of name -> number or text"),
        ("{'kp': [0.4]}", "has list for 'kp'; expected a name, and a number or text"),
        ("{'kp': float('inf')}", "has float 'inf' for 'kp'; expected"),
        ("{'kp': 10**400}", f"has int '1{'0' * 39}' for 'kp'; expected"),
        ("{'kp': 10**5000}", "has int for 'kp'; expected"),
    ],
)
def test_parameters_that_no_result_can_hold_are_refused_before_the_first_level(
    folder: Path, parameters: str, said: str
) -> None:
    start = "    def start(self, node) -> None:\n"
    with pytest.raises(RunFailed, match=re.escape(f"Idle: its attribute parameters {said}")):
        play(folder, start, f"{start}        self.parameters = {parameters}\n")


@pytest.mark.parametrize(
    ("gives", "said"),
    [
        ("[]", "MurkSpec.files gives list; expected name -> path"),
        ("{'sky': Path('sky.png')}", "MurkSpec.files gives 'sky.png' for 'sky'; expected the path"),
    ],
)
def test_files_of_an_updater_that_are_not_there_are_reported_with_its_line(
    folder: Path, gives: str, said: str
) -> None:
    bind = '    def bind(self, stage: Stage) -> "Murk":\n'
    files = (
        f"    def files(self, stage):\n        from pathlib import Path\n        return {gives}\n"
    )
    with pytest.raises(PluginError, match=rf"parts\.py:\d+: {re.escape(said)}"):
        play(folder, bind, f"{files}\n{bind}")


@pytest.mark.parametrize(
    ("gives", "why"),
    [
        ("float('nan')", "it gave nan"),
        ("'much'", "it gave str 'much', which is no number"),
        ("True", "it gave bool 'True', which is no number"),
        ("10**400", "it gave a whole number beyond float64"),
        ("-1e308", "it gave -1e+308, beyond what can be reckoned with (1e+60)"),
    ],
)
def test_a_measure_that_gives_no_number_leaves_a_reason(folder: Path, gives: str, why: str) -> None:
    result = play(folder, "return self.weight * self.n", f"return {gives}")
    assert result.values("steps") == (None,)
    assert result.reason(0, "steps") == why
