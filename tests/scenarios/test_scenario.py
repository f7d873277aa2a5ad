"""Scenarios: a mission that was recorded in a scene becomes a benchmark with the same scores."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.bags import IMAGE, write_bag
from uwsim.assets.bundled import scene_file
from uwsim.base.files.input_files import compute_hash
from uwsim.benchmark.number_table import read_numbers
from uwsim.cli import main
from uwsim.devices.motion.scripted_motion import read_poses
from uwsim.errors import AssetError, BadSetting, UnknownName
from uwsim.messages.bag_camera import Recording
from uwsim.scenarios import Levels, ScenarioRequest, make_scenario
from uwsim.scene.reader import read_scene

ODOMETRY = (
    "<PATToROSOdom> <topic>/girona500/odom</topic> <vehicleName>girona500</vehicleName> "
    "<rate>50</rate> </PATToROSOdom>"
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The scene of ``visibility-moving`` with odometry, and the recording of 2.5 s in it."""
    folder = tmp_path_factory.mktemp("mission")
    text = scene_file("visibility-moving-scene", ()).read_text()
    text = text.replace("<rosInterfaces>", f"<rosInterfaces>\n    {ODOMETRY}", 1)
    (folder / "tank.xml").write_text(text)
    command = ["run", str(folder / "tank.xml"), "--for", "2.5s", "--seed", "3"]
    assert main([*command, "--record", str(folder / "dive.mcap")]) == 0
    return folder


def request(folder: Path, out: Path, **settings: object) -> ScenarioRequest:
    values = {
        "log": folder / "dive.mcap", "out": out, "scene": str(folder / "tank.xml"), "seed": 3,
        "images": "/uwsim/camera1", "target": "blackbox", "levels": Levels(0.0, 0.4, 0.4),
    }  # fmt: skip
    return ScenarioRequest(**(values | settings))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def scenario(folder: Path) -> Path:
    out = folder / "scenario"
    result = make_scenario(request(folder, out))
    assert (result.n_images, result.n_poses) == (76, 127)
    assert [path.name for path in result.benchmarks] == ["benchmark.xml", "benchmark-rendered.xml"]
    return out


def score(benchmark: Path, result: Path, *options: str) -> list[float]:
    assert main(["bench", str(benchmark), "--out", str(result), *options]) == 0
    rows = read_rows(result)
    assert {row["status"] for row in rows} == {"ok"}
    return [row["total"] for row in rows]


def read_rows(result: Path) -> list[dict[str, Any]]:
    document = json.loads((result / "result.json").read_text())
    names = [column["name"] for column in document["columns"]]
    return [dict(zip(names, row, strict=True)) for row in document["rows"]]


@pytest.mark.slow
def test_a_tracker_scores_on_the_scenario_as_in_the_scene_of_the_mission(
    folder: Path, scenario: Path, tmp_path: Path
) -> None:
    recorded = score(scenario / "benchmark.xml", tmp_path / "recorded.result")
    rendered = score(scenario / "benchmark-rendered.xml", tmp_path / "rendered.result")
    # the original: the same motion, fog and measure, with other noise and another first image
    command = ["--scene", str(folder / "tank.xml"), "--seed", "3", "--level"]
    originals = []
    for fog in ("0", "0.4"):
        result = tmp_path / f"original-{fog}.result"
        arguments = ["bench", "visibility-moving", *command, f"fog={fog}", "--out", str(result)]
        assert main(arguments) == 0
        originals.append(read_rows(result)[0]["cornersFace"])
    assert recorded == pytest.approx(originals, abs=0.15)  # [px]
    assert rendered == pytest.approx(originals, abs=0.15)


@pytest.mark.slow
def test_the_folder_can_be_moved_and_gives_the_same_scores(
    folder: Path, scenario: Path, tmp_path: Path
) -> None:
    copy = tmp_path / "elsewhere" / "copy"
    shutil.copytree(scenario, copy)
    before = score(scenario / "benchmark.xml", tmp_path / "a.result", "--level", "fog=0.4")
    assert score(copy / "benchmark.xml", tmp_path / "b.result", "--level", "fog=0.4") == before


def test_two_scenarios_of_one_mission_have_the_same_bytes(
    folder: Path, scenario: Path, tmp_path: Path
) -> None:
    make_scenario(request(folder, tmp_path / "again"))
    assert compute_hash(tmp_path / "again") == compute_hash(scenario)


def test_the_files_are_listed_with_their_hashes(folder: Path, scenario: Path) -> None:
    provenance = json.loads((scenario / "provenance.json").read_text())
    files = {path.name for path in scenario.iterdir()} - {"provenance.json"}
    assert set(provenance["files"]) == files
    for name, digest in provenance["files"].items():
        assert compute_hash(scenario / name) == digest
    assert provenance["log"]["sha256"] == compute_hash(folder / "dive.mcap")
    assert str(folder) not in (scenario / "provenance.json").read_text()


def test_the_trajectory_begins_with_the_first_image_and_has_the_poses_of_the_log(
    folder: Path, scenario: Path
) -> None:
    times, positions, _ = read_poses(scenario / "trajectory.csv", name="t")
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(76 / 30, abs=2e-3)
    scene = read_scene(scenario / "scene.xml")
    sways = read_scene(folder / "tank.xml").vehicles[0].parts
    assert len(scene.vehicles[0].parts) == len(sways) - 3 + 1, "one motion instead of three sways"
    assert np.ptp(positions[:, 0]) > 0.01


def test_truth_and_depth_are_those_of_each_image(scenario: Path) -> None:
    table = read_numbers("truth.csv", str(scenario / "benchmark.xml"), max_rows=1000)
    assert len(table.rows) == 76
    assert np.isfinite(table.rows).all()
    recording = Recording(
        scenario / "recording.mcap", "/uwsim/camera1", "/uwsim/camera1_info", "/depth"
    )
    frames = list(recording.frames())
    depth = frames[0].decode_depth()
    recording.close()
    assert len(frames) == 76
    for frame, row in zip(frames[::25], table.rows[::25], strict=True):
        assert frame.time * 1e-9 == pytest.approx(row[0], abs=1e-6)
    assert depth is not None
    corners = table.rows[0, 1:].reshape(4, 2)
    u, v = corners.mean(axis=0).round().astype(int)
    # the top of the box is nearer than the floor beside it
    assert depth[v, u] == pytest.approx(depth.min(), abs=0.1)
    assert 0.9 < depth[v, u] < 1.5


def test_without_images_the_views_are_rendered(folder: Path, tmp_path: Path) -> None:
    result = make_scenario(request(folder, tmp_path / "s", images="", end=1.5))
    assert [path.name for path in result.benchmarks] == ["benchmark.xml"]
    assert not (tmp_path / "s" / "recording.mcap").exists()
    assert result.duration == pytest.approx(1.5, abs=0.01)


def test_without_a_target_estimates_of_the_position_are_scored(
    folder: Path, tmp_path: Path
) -> None:
    make_scenario(request(folder, tmp_path / "s", images="", target=None))
    text = (tmp_path / "s" / "benchmark.xml").read_text()
    assert "relativeLocation" in text
    assert "positionTopic" in text
    assert main(["check", str(tmp_path / "s" / "benchmark.xml")]) == 0


def test_files_of_the_user_are_copied_and_the_water_is_replaced(
    folder: Path, tmp_path: Path
) -> None:
    own = tmp_path / "own"
    (own / "robots").mkdir(parents=True)
    robot = '<robot name="r"><link name="part0"/></robot>'
    (own / "robots" / "girona.urdf").write_text(robot)
    text = (
        (folder / "tank.xml").read_text().replace("data/scenes/g500ARM5.urdf", "robots/girona.urdf")
    )
    start, end = text.index("<jointValues>"), text.index("</jointValues>")
    (own / "tank.xml").write_text(text[:start] + text[end + len("</jointValues>") :])
    water = {
        "uwsim_water": 1, "name": "pool", "absorption": [0.3, 0.1, 0.05],
        "scattering": [0.2, 0.2, 0.2],
        "phase_function": {"type": "HenyeyGreenstein", "asymmetry": 0.9},
    }  # fmt: skip
    (tmp_path / "pool.json").write_text(json.dumps(water))
    out = tmp_path / "s"
    make_scenario(
        request(
            folder,
            out,
            images="",
            scene=str(own / "tank.xml"),
            levels=None,
            water=tmp_path / "pool.json",
        )
    )
    assert (out / "robots" / "girona.urdf").read_text() == robot
    scene = read_scene(out / "scene.xml")
    assert scene.ocean_state.water is not None
    assert scene.ocean_state.water.file == "pool.json"
    assert 'u:quantity="scale"' in (out / "benchmark.xml").read_text()


def test_nothing_is_overwritten_and_a_failure_leaves_nothing(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "s").mkdir()
    with pytest.raises(BadSetting, match="exists; a scenario is written into a new folder"):
        make_scenario(request(folder, tmp_path / "s"))
    with pytest.raises(UnknownName, match=r"'blackbix'.*blackbox"):
        make_scenario(request(folder, tmp_path / "t", target="blackbix"))
    with pytest.raises(UnknownName, match="'/uwsim/camera'"):
        make_scenario(request(folder, tmp_path / "t", images="/uwsim/camera"))
    with pytest.raises(BadSetting, match="carries no images"):
        make_scenario(request(folder, tmp_path / "t", images="/uwsim/camera1_info"))
    with pytest.raises(BadSetting, match=r"expected 0\.1 s to 600 s"):
        make_scenario(request(folder, tmp_path / "t", images="", start=1.0, end=0.9))
    assert [path.name for path in tmp_path.iterdir()] == ["s"]


def test_images_of_another_size_are_refused(folder: Path, tmp_path: Path) -> None:
    scene = (folder / "tank.xml").read_text().replace("<resw>320</resw>", "<resw>160</resw>")
    (folder / "small.xml").write_text(scene)
    with pytest.raises(BadSetting, match="An image has 320x240 pixels; bowtech1 of the scene has"):
        make_scenario(request(folder, tmp_path / "s", scene=str(folder / "small.xml")))
    assert not list(tmp_path.iterdir())


def test_a_recording_without_poses_is_refused(tmp_path: Path) -> None:
    frames = [(0.0, np.zeros((4, 5, 3), np.uint8)), (0.1, np.zeros((4, 5, 3), np.uint8))]
    path = write_bag(tmp_path, "ros1", frames)
    with pytest.raises((AssetError, BadSetting)):
        make_scenario(ScenarioRequest(log=path, out=tmp_path / "s", images=IMAGE))


@pytest.mark.parametrize("text", ["", "0:1", "0:1:0", "1:0:0.1", "0:nan:1", "0:1:1e-9", "a:b:c"])
def test_invalid_levels_are_one_clear_error(text: str) -> None:
    with pytest.raises(BadSetting, match="Levels"):
        Levels.parse(text)
