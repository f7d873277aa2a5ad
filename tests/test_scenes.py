"""Bundled scenes run, and each of their topics carries its type, at its rate, with sound values."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.support.whole_scene import SceneRun, run_scene
from uwsim.assets.bundled import bundled_files
from uwsim.scene.reader import read_scene
from uwsim.sensors.sonar.message import amplitudes
from uwsim.simulation.views import viewer_view

ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
SCENES = bundled_files("scenes")
PAGE = Path(__file__).parent.parent / "docs" / "scenes.md"
QUICK = ("remus-scene", "shapes-scene", "two-vehicles-scene")


def assert_sound(done: SceneRun) -> None:
    assert done.faults == []
    assert done.not_simulated == []
    assert done.n_messages


@pytest.mark.parametrize("name", SCENES)
def test_the_page_of_scenes_shows_each(name: str) -> None:
    assert f"`{name}`" in PAGE.read_text() or f"## {name}" in PAGE.read_text()
    assert f"images/scenes/{name}.jpg" in PAGE.read_text()
    assert (PAGE.parent / "images" / "scenes" / f"{name}.jpg").is_file()


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_each_topic_of_a_bundled_scene_at_once(name: str) -> None:
    assert_sound(run_scene(SCENES[name], 0.2))


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_each_topic_of_a_bundled_scene_for_five_seconds(name: str) -> None:
    assert_sound(run_scene(SCENES[name], 5.0))


@pytest.mark.parametrize(
    ("name", "sensors"),
    [
        pytest.param("survey-scene", ("multibeam",), marks=pytest.mark.slow),
        ("shapes-scene", ("altimeter",)),
        pytest.param("shipwreck-scene", ("altimeter",), marks=pytest.mark.slow),
    ],
)
def test_what_looks_down_sees_the_bottom_and_not_its_vehicle(
    name: str, sensors: tuple[str, ...]
) -> None:
    with open_scene(read_scene(SCENES[name]), is_blind=True) as simulation:
        for sensor in sensors:
            kinds = ("multibeamSensor", "rangeSensor")
            message: Any = simulation.world.sensors.sensor(sensor, kinds).sample(0.0)
            nearest = message.range if hasattr(message, "range") else min(message.ranges)
            assert 1.0 < nearest < 20.0


@pytest.mark.slow
def test_the_side_scan_of_the_survey_hears_no_echo_of_its_vehicle() -> None:
    with open_scene(read_scene(SCENES["survey-scene"]), is_blind=True) as simulation:
        message: Any = simulation.world.sensors.sensor("sidescan", ("u:sideScanSonar",)).sample(0.0)
        echoes = amplitudes(message)
        near = np.asarray(message.ranges) < 2.0
        assert echoes[~near].max() > 30.0 * echoes[near].max()


@pytest.mark.slow
@pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")
@pytest.mark.parametrize("name", ["cirs", "g500ARM5", "trackingScene", "visionBenchmarkScene"])
def test_each_topic_of_an_original_scene_for_ten_seconds(name: str) -> None:
    [path] = Path(ORIGINALS or "").rglob(f"{name}.xml")
    assert_sound(run_scene(path, 10.0))


@pytest.mark.parametrize("shape", [(640, 360), (640, 480)])
@pytest.mark.parametrize("name", sorted(SCENES))
def test_the_first_view_of_a_bundled_scene_has_the_whole_vehicle_and_what_it_is_about(
    name: str, shape: tuple[int, int]
) -> None:
    with open_scene(read_scene(SCENES[name]), is_blind=True) as simulation:
        world = simulation.world
        camera = world.model.scene.camera
        assert camera is not None
        view = viewer_view(simulation, camera, shape)
        camera_from_world = view.world_from_camera.inverse()
        shown = [part for part in world.scenery.parts if part.vehicle == 0]
        shown += [part for part in world.scenery.parts if part.name == "blackbox"]
        for part in shown:
            corners = camera_from_world.transform(world.scenery.corners(part))
            places = view.intrinsics.project(corners)
            assert (places > 0.0).all(), part.name
            assert (places < np.array(shape)).all(), part.name


def test_the_wreck_in_physical_water_rests_on_the_sand() -> None:
    with open_scene(read_scene(SCENES["wreck-physical-scene"])) as scene:
        wreck = scene.world.stage_view.world.body("wreck")
        start = wreck.world_from_body.position
        scene.advance(0.2)
        assert wreck.world_from_body.position == pytest.approx(start, abs=1e-9)
