"""``uwsim bench`` with several algorithms, other workers, and algorithms that break."""

import os
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.short_benchmark import fingerprint, write_benchmark
from uwsim.assets.bundled import benchmark_file
from uwsim.cli import main
from uwsim.errors import BadSetting
from uwsim.results.provenance import load_provenance
from uwsim.results.result_file import load
from uwsim.runs.executors.choose import executor_of
from uwsim.runs.executors.executor import SerialExecutor
from uwsim.runs.executors.processes import ProcessExecutor


@pytest.fixture
def benchmark(tmp_path: Path) -> str:
    return str(write_benchmark(tmp_path, "0.2"))


@pytest.mark.slow
def test_each_of_several_algorithms_has_a_result_of_its_own(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    both, alone = tmp_path / "both", tmp_path / "alone"
    names = ["--algorithm", "frozen", "--algorithm", "esm"]
    assert main(["bench", benchmark, *names, "--workers", "2", "--out", str(both)]) == 0
    printed = capsys.readouterr().out
    assert f"compare: uwsim compare {both}/frozen {both}/esm\n" in printed
    assert sorted(os.listdir(both)) == ["esm", "frozen"]
    assert main(["bench", benchmark, "--algorithm", "esm", "--out", str(alone)]) == 0
    assert fingerprint(both / "esm") == fingerprint(alone)
    assert set(os.listdir(both / "esm")) == set(os.listdir(alone))
    assert load_provenance(both / "esm")["workers"] == 2

    assert main(["bench", benchmark, *names, "--out", str(both)]) == 2
    (both / "notes.txt").touch()
    assert main(["bench", benchmark, *names, "--out", str(both), "--overwrite"]) == 2
    assert "holds 'notes.txt'" in capsys.readouterr().err
    assert load(both / "esm").rows


def test_a_port_that_is_taken_leaves_no_folder_and_an_earlier_result_as_it_was(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = str(other.getsockname()[1])
        view = ["--view", "--port", port, "--out", str(tmp_path / "out")]
        assert main(["bench", benchmark, *view]) == 2
        assert capsys.readouterr().err == (
            f"uwsim: --port {port}: cannot be opened: Address already in use.\n"
        )
        assert not (tmp_path / "out").exists()
        assert main(["bench", benchmark, "--level", "fog=0", "--out", str(tmp_path / "out")]) == 0
        before = fingerprint(tmp_path / "out")
        assert main(["bench", benchmark, *view, "--overwrite"]) == 2
        assert fingerprint(tmp_path / "out") == before


def test_an_algorithm_given_twice_is_refused(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    twice = ["--algorithm", "esm", "--algorithm", "esm", "--out", str(tmp_path / "out")]
    assert main(["bench", benchmark, *twice]) == 2
    assert capsys.readouterr().err == "uwsim: --algorithm esm: is given twice.\n"
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_when_every_row_broke_all_is_written_and_the_run_has_failed(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert (
        main(
            [
                "bench",
                benchmark,
                "--algorithm",
                "tests.support.failing:RaisedError",
                "--out",
                str(out),
            ]
        )
        == 3
    )
    said = capsys.readouterr()
    assert (out / "report.html").exists()
    assert f"written: {out}/result.json" in said.out
    *_, line = said.err.splitlines()  # behind how far it is, where that takes long
    assert line.startswith("uwsim: Every row ended in 'algorithm error': ")
    assert "ZeroDivisionError: no focus" in line


def test_all_that_is_wrong_with_a_call_is_reported_at_once_a_line_each(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "notes.txt").touch()
    options = (
        "--workers two --algorithm esm --algorithm orbb --set oceanState.fog.densty=1 --set x "
    )
    options += (
        "--set algorithm.kp=1 --set algorithm.latency_s=-1 --level fogg=1 --level fog=7.0000001 "
    )
    options += "--compat thresh --mode paralel --repeat 100000 --out"
    assert main(["bench", benchmark, *options.split(), str(out)]) == 2
    said = capsys.readouterr().err.splitlines()
    expected = [
        "--workers two: expected", "--set 'x': expected", "there is no <densty>. Did you mean",
        "no parameter 'kp'", "latency_s is -1.0", "--mode is 'paralel'", "Did you mean 'thresholds",
        "--level fogg: this benchmark sweeps fog. Did", "--level fog=7.0000001 is not a level",
        "--repeat 100000: at most", "No algorithm is called 'orbb'. Did", f"--out {out}: not empty",
    ]  # fmt: skip
    assert [sum(words in line for line in said) for words in expected] == [1] * len(expected), said
    assert len(said) == len(expected)
    assert sorted(os.listdir(out)) == ["notes.txt"]


def test_a_setting_of_nothing_is_told_what_may_be_set_updaters_included(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["bench", benchmark, "--algorithm", "esm", "--out", str(tmp_path / "out")]
    assert main([*call, "--set", "sceneFogUpdate.color=1", "--set", "interval=5"]) == 2
    near, unknown = capsys.readouterr().err.splitlines()
    assert "there is no <sceneFogUpdate>. Did you mean 'sceneFogUpdater'? There are: " in near
    assert unknown.endswith("rosInterfaces, vary, forces, sceneFogUpdater, algorithm.")


def test_what_names_a_benchmark_that_is_nowhere_is_reported_with_the_rest(
    capsys: pytest.CaptureFixture[str],
) -> None:
    call = ["bench", "visibilty", "--algorithm", "esmm", "--level", "fog", "--scene", "nowhere.xml"]
    assert main([*call, "--plugin", "a.py", "--plugin", "b.py"]) == 2
    *plugins, named, level = capsys.readouterr().err.splitlines()
    assert [line.split(":")[0] for line in plugins] == ["a.py", "b.py"]
    assert "Did you mean 'visibility'?" in named  # the scene may lie beside it, a plugin know esmm
    assert level == "uwsim: --level 'fog': expected NAME=VALUE."


def test_options_that_cannot_be_read_are_reported_all_at_once(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["bench", "visibility", "--seed", "one", "--repeat", "0"]) == 2
    seed, repeat = capsys.readouterr().err.splitlines()
    assert seed.startswith("uwsim: Invalid value for '--seed': ")
    assert repeat.startswith("uwsim: Invalid value for '--repeat': ")
    assert main(["envelope", "visibility"]) == 2
    said = capsys.readouterr().err
    assert said == "uwsim: Missing option '--over'; uwsim envelope -h shows its options.\n"


DIES = """
import os
import subprocess
import sys
from pathlib import Path

class Dies:
    def start(self, node):
        from uwsim.messages import Empty
        node.call("startBench", Empty())
        is_deadly = Path("deadly").exists()
        node.create_timer(0.02, lambda: os._exit(0) if is_deadly and node.now > 0.3 else None)

ALGORITHMS = {"dies": Dies}
"""


@pytest.mark.slow
def test_an_algorithm_that_ends_its_process_is_exit_status_3_and_is_tried_again(
    benchmark: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("dies.py").write_text(DIES)
    call = ["bench", benchmark, "--algorithm", "dies", "--plugin", "dies.py", "--out"]
    assert main([*call, "whole"]) == 0
    Path("deadly").touch()
    assert main([*call, "out"]) == 3
    died = "dies was stopped at 0.32 s: its process ended (with exit status 0)"
    assert f"uwsim: {died}. Rows are kept; --resume" in capsys.readouterr().err
    first, *others = [load("out").reason(row, "total") for row in range(3)]
    assert first == load("whole").reason(0, "total")
    assert others == [died, died]
    Path("deadly").unlink()
    assert main([*call, "out", "--resume"]) == 0
    assert fingerprint(Path("out")) == fingerprint(Path("whole"))


def test_workers_are_a_number_or_ray() -> None:
    assert isinstance(executor_of("0", 0.0), SerialExecutor)
    assert isinstance(executor_of("1", 0.0), ProcessExecutor)
    assert isinstance(executor_of("2", 600.0), ProcessExecutor)
    for wrong in ("-1", "two", "1.5", "1000000", ""):
        with pytest.raises(BadSetting, match="expected a number from 0 to"):
            executor_of(wrong, 0.0)
    with pytest.raises(BadSetting, match="Did you mean 'ray'"):
        executor_of("Ray", 0.0)


@pytest.mark.parametrize("limit", ["-1", "inf", "nan"])
def test_a_callback_limit_is_a_time(limit: str) -> None:
    with pytest.raises(BadSetting, match=r"--callback-limit .*expected a time"):
        executor_of("1", float(limit))


@pytest.mark.slow
def test_a_clock_that_is_set_back_does_not_change_how_long_a_run_took(
    benchmark: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    days = iter(range(10**6, 0, -1))
    monkeypatch.setattr("time.time", lambda: next(days) * 86_400.0)
    out = tmp_path / "out"
    call = [
        "bench",
        benchmark,
        "--algorithm",
        "tests.support.failing:RaisedError",
        "--level",
        "fog=0",
    ]
    assert main([*call, "--out", str(out)]) == 3
    assert 0.0 < float(str(load_provenance(out)["wall_s"])) < 600.0


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (BadSetting("<u:function> gave 'nan' at 3 s."), "uwsim: <u:function> gave 'nan' at 3 s.\n"),
        (PermissionError(13, "Permission denied", "a.csv"), "uwsim: Permission denied: a.csv\n"),
    ],
)
def test_what_goes_wrong_while_it_is_played_is_a_failed_run_whatever_it_is(
    error: Exception,
    said: str,
    benchmark: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def broken(*_: object) -> Iterator[None]:
        raise error
        yield

    monkeypatch.setattr("uwsim.runs.executors.executor.run_trial", broken)
    call = ["bench", benchmark, "--algorithm", "p", "--level", "fog=0"]
    assert main([*call, "--out", str(tmp_path / "out")]) == 3
    assert capsys.readouterr().err == said


def test_an_unknown_algorithm_of_a_file_is_reported_with_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = benchmark_file("visibility").read_text(encoding="utf-8")
    file = tmp_path / "wrong.xml"
    file.write_text(text.replace('u:algorithm="esm"', 'u:algorithm="emm"'), encoding="utf-8")
    assert main(["bench", str(file), "--out", str(tmp_path / "out")]) == 2
    line = 1 + text[: text.index("<benchmark")].count("\n")
    said = capsys.readouterr().err
    begins = said.split(f"{file}:")[1].split(": No algorithm")[0]
    assert line <= int(begins) <= line + 3
    assert "Did you mean 'esm'?" in said
