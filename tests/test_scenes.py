"""Bundled scenes run, and each of their topics carries its type, at its rate, with sound values."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.whole_scene import SceneRun, run_scene
from uwsim.assets.bundled import bundled

ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
SCENES = bundled("scenes")
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


@pytest.mark.slow
@pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")
@pytest.mark.parametrize("name", ["cirs", "g500ARM5", "trackingScene", "visionBenchmarkScene"])
def test_each_topic_of_an_original_scene_for_ten_seconds(name: str) -> None:
    [path] = Path(ORIGINALS or "").rglob(f"{name}.xml")
    assert_sound(run_scene(path, 10.0))
