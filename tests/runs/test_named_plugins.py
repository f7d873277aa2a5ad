"""A benchmark file names its plugin: it is found beside the file, announced, refused, verified."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from tests.benchmark.test_plugin import BENCHMARK, PARTS
from uwsim.cli import main
from uwsim.cli.verify import same_sample_command
from uwsim.errors import UwsimError
from uwsim.results.interrupted import resume_command
from uwsim.results.provenance import save_provenance
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest

Said = pytest.CaptureFixture[str]


def named(folder: Path, plugin: str = "parts.py", *, place: str = "") -> Path:
    """A benchmark that names its plugin, which is in a folder below it."""
    (folder / place).mkdir(parents=True, exist_ok=True)
    (folder / place / "parts.py").write_text(PARTS)
    path = folder / "b.xml"
    path.write_text(BENCHMARK.replace(" u:mode", f' u:plugin="{plugin}" u:mode'))
    return path


@pytest.mark.parametrize(("plugin", "place"), [("parts.py", ""), ("own/parts.py", "own")])
def test_a_plugin_beside_the_benchmark_is_found_from_any_folder(
    plugin: str, place: str, tmp_path: Path, capsys: Said
) -> None:
    path = named(tmp_path, plugin, place=place)
    plan = make_plan(PlanRequest(benchmark=str(path)))
    assert [Path(each.path).name for each in plan.plugins] == ["parts.py"]
    assert plan.benchmark.plugin == (plugin,)
    said = capsys.readouterr().err
    assert f"runs Python code: {plugin} in {tmp_path / place / 'parts.py'}" in said
    both = PlanRequest(benchmark=str(path), plugins=[tmp_path / place / "parts.py"])
    assert len(make_plan(both).plugins) == 1


@pytest.mark.parametrize("plugin", ["prts.py", "../../etc/parts.py", "b.xml"])
def test_a_plugin_that_is_not_there_is_an_error_of_the_file(plugin: str, tmp_path: Path) -> None:
    path = named(tmp_path, plugin)
    with pytest.raises(UwsimError, match=r"b\.xml:\d+: u:plugin names[^\n]*$"):
        make_plan(PlanRequest(benchmark=str(path)))


def test_a_plugin_that_a_file_names_is_refused_with_no_code(tmp_path: Path) -> None:
    path = named(tmp_path)
    with pytest.raises(UwsimError, match=r"'parts\.py', which --no-code refuses"):
        make_plan(PlanRequest(benchmark=str(path), no_code=True))


def test_check_does_not_run_the_plugin_and_says_so(tmp_path: Path, capsys: Said) -> None:
    path = named(tmp_path)
    (tmp_path / "parts.py").write_text("raise SystemExit('it ran')\n")
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().out + capsys.readouterr().err
    assert "it ran" not in said
    (tmp_path / "parts.py").write_text(PARTS)
    assert main(["check", str(path), "--plugin", str(tmp_path / "parts.py")]) == 0


@pytest.mark.slow
@pytest.mark.parametrize("is_named", [True, False])
def test_a_result_with_a_plugin_is_verified_without_naming_it_again(
    is_named: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Said
) -> None:
    path = named(tmp_path)
    options = []
    if not is_named:
        path.write_text(BENCHMARK)
        options = ["--plugin", str(tmp_path / "parts.py")]
    out = tmp_path / "r"
    assert main(["bench", str(path), *options, "--out", str(out)]) == 0
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    capsys.readouterr()
    assert main(["verify", str(out), "--sample", "1"]) == 0
    said = capsys.readouterr().out
    (line,) = [each for each in said.splitlines() if "the same again: " in each]
    command = shlex.split(line.partition("the same again: ")[2])
    assert main(command[1:]) == 0
    assert line in capsys.readouterr().out


@pytest.mark.parametrize(
    ("typed", "again"),
    [
        ("verify r --sample 5", "verify r --sample 5 --sample-seed 7"),
        ("verify r --sample-seed 3 --sample 5", "verify r --sample 5 --sample-seed 7"),
        ("verify 'a b' --sample-seed=3", "verify 'a b' --sample-seed 7"),
        ("verify r --plugin p.py", "verify r --plugin p.py --sample-seed 7"),
    ],
)  # fmt: skip
def test_the_command_that_verify_prints_has_all_options(typed: str, again: str) -> None:
    assert same_sample_command(shlex.split(typed), 7) == f"uwsim {again}"


@pytest.mark.parametrize(
    "typed", ["bench b", "bench b --out old.result", "bench b --out=old.result --overwrite"]
)
def test_the_command_that_resumes_writes_to_where_the_result_is_now(
    typed: str, tmp_path: Path
) -> None:
    directory = tmp_path / "moved.result"
    (directory / "units").mkdir(parents=True)
    (directory / "units" / "00000.jsonl").write_text('{"unit":{"run":{"seed":0},"seed":0}}\n')
    save_provenance({"command": shlex.split(typed)}, directory)
    command = resume_command(directory)
    assert command is not None
    words = shlex.split(command.replace("--out=", "--out "))
    assert words[words.index("--out") + 1] == str(directory)
    assert words.count("--out") == 1
    assert words[-1] == "--resume"
    assert "--overwrite" not in words
