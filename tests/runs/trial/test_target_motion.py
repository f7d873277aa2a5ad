"""How far a target moves in its image while a benchmark is played."""

from pathlib import Path

import pytest

from tests.support.short_benchmark import bench_of, write_benchmark
from uwsim.runs.executors.executor import run_all


@pytest.mark.parametrize(
    ("scene", "least", "most"),
    [
        pytest.param("visibility-scene.xml", 0.0, 0.05, marks=pytest.mark.slow),
        ("visibility-moving-scene.xml", 1.0, 200.0),
    ],
)
def test_the_result_says_how_far_the_target_moved(
    scene: str, least: float, most: float, tmp_path: Path
) -> None:
    file = write_benchmark(tmp_path, "0.5")
    file.write_text(file.read_text().replace("visibility-scene.xml", scene))
    bench = bench_of(file, tmp_path / "o", mode="independent", levels=["fog=0"])
    [result] = run_all([bench])
    found = result.fact("shift")
    assert found is not None
    assert least <= found[0] <= most
    assert found[1] == "px"
