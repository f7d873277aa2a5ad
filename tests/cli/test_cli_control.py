"""The control that is played beside a tracker sees the pictures that the tracker is told of."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import pytest

from short_benchmark import bench_of, write_benchmark
from uwsim.cli.bench import control_of

SCENES = Path(str(resources.files("uwsim"))) / "data" / "scenes"


@pytest.mark.parametrize(
    ("topic", "parameters"),
    [("/front/image", {"image_topic": "/front/image"}), ("uwsim/camera1", {})],
)
def test_the_control_waits_for_pictures_of_the_camera_of_the_truth(
    topic: str, parameters: dict[str, str], tmp_path: Path
) -> None:
    scene = (SCENES / "visibility-scene.xml").read_text()
    (tmp_path / "own.xml").write_text(scene.replace("/uwsim/camera1<", f"{topic}<"))
    benchmark = write_benchmark(tmp_path, "0.2")
    benchmark.write_text(benchmark.read_text().replace("visibility-scene.xml", "own.xml"))
    run = bench_of(benchmark, tmp_path / "out")
    assert run.plan.told_topic == topic
    assert control_of(run).plan.parameters == parameters
