"""``uwsim bench`` with several algorithms, other workers, and algorithms that break."""

import os
from pathlib import Path

import pytest

from short_benchmark import fingerprint, write_benchmark
from uwsim.benchmark.crew import Here
from uwsim.benchmark.processes import Processes
from uwsim.benchmark.provenance import load_provenance
from uwsim.benchmark.result_file import load
from uwsim.cli import main
from uwsim.cli.bench import crew_of
from uwsim.errors import BadSetting


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


def test_an_algorithm_given_twice_is_refused(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    twice = ["--algorithm", "esm", "--algorithm", "esm", "--out", str(tmp_path / "out")]
    assert main(["bench", benchmark, *twice]) == 2
    assert capsys.readouterr().err == "uwsim: --algorithm esm: is given twice.\n"
    assert not (tmp_path / "out").exists()


def test_when_every_row_broke_all_is_written_and_the_run_has_failed(
    benchmark: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert main(["bench", benchmark, "--algorithm", "failing:Raises", "--out", str(out)]) == 3
    said = capsys.readouterr()
    assert (out / "report.html").exists()
    assert f"written: {out}/result.json" in said.out
    [line] = said.err.splitlines()
    assert line.startswith("uwsim: Every row ended in 'algorithm error': ")
    assert "ZeroDivisionError: no focus" in line


def test_workers_are_a_number_or_ray() -> None:
    assert isinstance(crew_of("1"), Here)
    assert isinstance(crew_of("2"), Processes)
    for wrong in ("0", "-1", "two", "1.5", "1000000", ""):
        with pytest.raises(BadSetting, match="expected a number from 1 to"):
            crew_of(wrong)
    with pytest.raises(BadSetting, match="Did you mean 'ray'"):
        crew_of("Ray")
