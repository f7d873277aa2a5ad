"""The control that is played beside a tracker sees the images that the tracker is told of."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest

import uwsim
from tests.support.short_benchmark import bench_of, write_benchmark
from tests.support.short_trial import with_algorithm
from uwsim.cli import main
from uwsim.runs import execute
from uwsim.runs.control_run import control_run_of, image_topic
from uwsim.runs.executors.background import BackgroundJob, BackgroundProcess
from uwsim.runs.run import Run

SCENES = Path(str(resources.files("uwsim"))) / "data" / "scenes"


@pytest.mark.parametrize(
    ("topic", "parameters"),
    [("/front/image", {"image_topic": "/front/image"}), ("uwsim/camera1", {})],
)
def test_the_control_waits_for_images_of_the_camera_of_the_truth(
    topic: str, parameters: dict[str, str], tmp_path: Path
) -> None:
    scene = (SCENES / "visibility-scene.xml").read_text()
    (tmp_path / "own.xml").write_text(scene.replace("/uwsim/camera1<", f"{topic}<"))
    benchmark = write_benchmark(tmp_path, "0.2")
    benchmark.write_text(benchmark.read_text().replace("visibility-scene.xml", "own.xml"))
    run = bench_of(benchmark, tmp_path / "out")
    assert image_topic(run.plan) == topic
    assert control_run_of(run).plan.algorithm.parameters == parameters


@pytest.mark.slow
def test_a_control_that_fails_is_a_warning_and_the_run_is_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def bound_to_fail(run: Run) -> Run:
        found = control_run_of(run)
        no_images = with_algorithm(found.plan, parameters={"image_topic": "/uwsim/camera1_info"})
        return replace(found, plan=no_images)

    monkeypatch.setattr(execute, "control_run_of", bound_to_fail)
    path, out = write_benchmark(tmp_path, "0.2"), tmp_path / "out"
    assert main(["bench", str(path), "--level", "fog=0", "--out", str(out)]) == 0
    said = capsys.readouterr()
    assert "warning: the report lacks the control run 'frozen', which failed: Topic '" in said.err
    assert f"report: {out}/report.html" in said.out
    assert (out / "report.html").is_file()
    uwsim.bench(path, levels={"fog": [0]}, out=tmp_path / "python")
    assert "warning: the report lacks the control run 'frozen', which" in capsys.readouterr().err
    assert (tmp_path / "python" / "report.html").is_file()


@pytest.mark.slow
@pytest.mark.parametrize(("workers", "jobs"), [("1", [Path]), ("2", [Run, Path])])
def test_the_background_process_runs_the_control_of_trials_of_workers_alone(
    workers: str, jobs: list[type], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[type] = []
    submit = BackgroundProcess.submit

    def record(self: BackgroundProcess, job: BackgroundJob) -> None:
        asked.append(type(job) if isinstance(job, Run) else Path)
        submit(self, job)

    monkeypatch.setattr(BackgroundProcess, "submit", record)
    path, out = write_benchmark(tmp_path, "0.2"), tmp_path / "out"
    arguments = ["--level", "fog=0", "--workers", workers, "--out", str(out)]
    assert main(["bench", str(path), *arguments]) == 0
    assert asked == jobs
    assert (out / "control" / "result.json").is_file()
