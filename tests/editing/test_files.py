"""Checks, files and runs of edited scenes and benchmarks."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from uwsim.editing import Benchmark, Scene, read_benchmark, read_scene
from uwsim.errors import BadSetting, BenchmarkError, SceneError
from uwsim.results.directory import INPUTS_FOLDER
from uwsim.verify.recorded_plan import FileOverrides, plan_of

BOX = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def scene_with_mesh(tmp_path: Path) -> Scene:
    folder = tmp_path / "project" / "scenes"
    folder.mkdir(parents=True)
    (folder / "meshes").mkdir()
    (folder / "meshes" / "plate.obj").write_text(BOX)
    scene = Scene()
    scene.add("object", name="plate", file="meshes/plate.obj")
    (folder / "plate.xml").write_text(scene.to_xml())
    return read_scene(folder / "plate.xml")


def test_a_written_scene_finds_its_files_from_another_folder(
    scene_with_mesh: Scene, tmp_path: Path
) -> None:
    for folder in ("project/other/deep", "project", "project/scenes"):
        target = tmp_path / folder
        target.mkdir(parents=True, exist_ok=True)
        written = read_scene(scene_with_mesh.write(target / "new.xml"))
        assert not [item for item in written.check() if item.severity == "error"]
        with uwsim.load(written) as simulation:
            assert simulation.pose("plate") is not None
    assert scene_with_mesh.object("plate").file == "meshes/plate.obj"


def test_a_file_is_written_to_a_folder_that_exists(tmp_path: Path) -> None:
    scene = read_scene("cirs")
    with pytest.raises(BadSetting, match="there is no folder"):
        scene.write(tmp_path / "missing" / "scene.xml")
    with pytest.raises(BadSetting, match="is a folder; expected the path of a file"):
        scene.write(tmp_path)


def test_names_of_bundled_files_do_not_change(tmp_path: Path) -> None:
    scene = read_scene("cirs")
    assert read_scene(scene.write(tmp_path / "cirs.xml")).spec == scene.spec


def test_a_check_has_the_diagnostics_of_a_file_with_paths_instead_of_lines() -> None:
    scene = read_scene("visibility-scene")
    before = scene.check()
    assert {item.line for item in before} == {None}
    assert before[0].message.startswith("girona500/jointValues: joint 'Elbow' at 2.2")
    scene.vehicle("girona500").add("virtualCamera", name="new", relative_to="nowhere")
    scene.object("blackbox").file = "nowhere.obj"
    messages = [item.message for item in scene.check()]
    assert any(
        message.startswith("girona500/new: <virtualCamera>: 'nowhere'") for message in messages
    )
    assert any(message.startswith("blackbox: model 'nowhere.obj' is not") for message in messages)
    assert not any("uwsim-" in message for message in messages)


def test_errors_of_a_scene_are_reported_together() -> None:
    scene = read_scene("visibility-scene")
    scene.add("uniform", path="object[nothing].position.x", low=0, high=1)
    scene.add("uniform", path="object[blackbox].position.x", low=2, high=1)
    with pytest.raises(SceneError) as caught:
        uwsim.load(scene)
    assert str(caught.value).count("<u:path>") == 2
    with pytest.raises(SceneError):
        scene.write("never.xml")


def test_errors_of_a_benchmark_name_the_element() -> None:
    benchmark = read_benchmark("visibility")
    benchmark.function.text = "corner"
    benchmark.scene_updater.set(initial_value=2)
    with pytest.raises(BenchmarkError) as caught:
        uwsim.bench(benchmark)
    assert "sceneFogUpdater: <finalValue> 1.3 is below" in str(caught.value)
    assert "corner" in str(caught.value)


def test_a_result_keeps_what_it_was_made_from_and_can_be_verified(tmp_path: Path) -> None:
    scene, benchmark = read_scene("visibility-scene"), read_benchmark("visibility")
    scene["girona500/bowtech1"].set(std=0.01, resw=64, resh=48)
    benchmark.scene_updater.set(final_value=0.5, step=0.5, interval=0.2)
    directory = tmp_path / "a.result"
    result = uwsim.bench(benchmark, scene=scene, algorithm="frozen", out=directory)
    inputs = directory / INPUTS_FOLDER
    assert read_scene(inputs / "visibility-scene.xml").spec == scene.spec
    assert read_benchmark(inputs / "visibility.xml").spec == benchmark.spec
    plan = plan_of(uwsim.read_result(directory), directory, FileOverrides())
    assert plan.scene == scene.spec
    again = uwsim.bench(str(inputs / "visibility.xml"), algorithm="frozen")
    assert again.rows == result.rows


def test_a_benchmark_from_nothing_runs_over_a_scene_from_nothing() -> None:
    scene = Scene()
    scene.add("vehicle", name="rov", file="bluerov2_heavy.urdf", position=(0, 0, -2))
    benchmark = Benchmark()
    benchmark.add("time", name="duration")
    benchmark.function.text = "duration"
    benchmark.add("sceneFogUpdater", initial_value=0, final_value=1, step=0.5, interval=0.1)
    result = uwsim.bench(benchmark, scene=scene, algorithm="frozen")
    assert [row[0] for row in result.rows] == [0.0, 0.5, 1.0]


def test_errors_of_a_run_name_the_element_of_the_benchmark() -> None:
    benchmark = read_benchmark("visibility")
    benchmark.scene_updater.set(final_value=0, interval=0.1)
    with pytest.raises(BenchmarkError, match="sceneFogUpdater: The scene has physical"):
        uwsim.bench(benchmark, scene="visibility-physical-scene", algorithm="frozen")


def test_a_table_beside_the_benchmark_is_kept_with_the_result(tmp_path: Path) -> None:
    (tmp_path / "line.csv").write_text("x,y,z\n0,0,0\n1,0,0\n")
    benchmark = Benchmark()
    measure = benchmark.add("pathFollowing", name="path", target="girona500")
    measure.add("path", file="line.csv")
    benchmark.function.text = "path"
    benchmark.add("sceneFogUpdater", initial_value=0, final_value=0, step=1, interval=0.1)
    (tmp_path / "line.xml").write_text(benchmark.to_xml())
    benchmark = read_benchmark(tmp_path / "line.xml")
    uwsim.bench(benchmark, scene="visibility-scene", algorithm="frozen", out=tmp_path / "a.result")
    assert (tmp_path / "a.result" / INPUTS_FOLDER / "line.csv").is_file()


def test_values_of_hydrodynamics_have_no_place_in_a_scene_file() -> None:
    spec = read_scene("bluerov2-scene").spec
    from uwsim.scene.settings import apply_setting

    name = spec.vehicles[0].name
    scene = Scene(apply_setting(spec, f"vehicle[{name}].hydrodynamics.body[base_link].mass", "12"))
    with pytest.raises(BadSetting, match="settings of a hydrodynamics file"):
        scene.to_xml()
