"""A file is named by a Path or by text; what is handed over wrongly is told what was expected."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.assets.bundled import benchmark_file, scene_file
from uwsim.benchmark.reader import read_benchmark
from uwsim.errors import BadSetting, FileError, UwsimError
from uwsim.physics.compile_scene import compile_scene
from uwsim.results.log import load_log
from uwsim.results.result_file import load
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import find_vehicle
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.reader import read_urdf
from uwsim.simulation import Simulation

READERS: list[Callable[[str], object]] = [
    read_scene, read_benchmark, read_urdf, read_vehicle, load, load_log,
]  # fmt: skip


@pytest.mark.parametrize("read", READERS, ids=lambda read: read.__name__)
def test_a_missing_file_is_reported_whether_named_by_text_or_path(
    read: Callable[..., object],
) -> None:
    said = []
    for name in ("no/such/file.xml", Path("no/such/file.xml")):
        with pytest.raises(UwsimError) as caught:
            read(name)
        said.append(str(caught.value))
    assert said[0] == said[1]
    assert "no/such/file.xml" in said[0]


def test_files_named_by_text_are_read() -> None:
    scene, benchmark = scene_file("currents-scene"), benchmark_file("currents")
    assert read_scene(str(scene)) == read_scene(scene)
    assert read_benchmark(str(benchmark)) == read_benchmark(benchmark)
    assert read_vehicle(str(find_vehicle("g500_physical"))).bodies


def test_a_file_of_the_wrong_kind_is_reported_with_its_kind() -> None:
    with pytest.raises(FileError, match="benchmark"):
        read_scene(str(benchmark_file("currents")))
    with pytest.raises(FileError, match="UWSimScene"):
        read_benchmark(str(scene_file("currents-scene")))


@pytest.mark.parametrize("scene", ["scene.xml", Path("scene.xml"), None, "x" * 10_000])
@pytest.mark.parametrize(
    ("make", "takes"), [(compile_scene, "read_scene"), (Simulation, "compile_scene")]
)
def test_a_simulation_of_something_else_than_a_scene_says_what_it_takes(
    scene: object, make: Callable[[object], object], takes: str
) -> None:
    with pytest.raises(BadSetting, match=f"which {takes} returns") as caught:
        make(scene)
    assert len(str(caught.value)) < 200


def test_folders_of_data_may_be_text(tmp_path: Path) -> None:
    scene = read_scene(scene_file("currents-scene"))
    open_scene(scene, data_path=(str(tmp_path),), is_blind=True).close()  # type: ignore[arg-type]
