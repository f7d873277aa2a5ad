"""The page in a browser without a network."""

from __future__ import annotations

import base64
import random
import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import uwsim
from uwsim.assets.bundled import scene_file
from uwsim.rendering.grey import grey_truncated
from uwsim.results import journal
from uwsim.results.motion import load_track
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack
from uwsim.viewer.replay import Replay

pytestmark = pytest.mark.slow
SCENES = ("currents-scene", "shipwreck-scene", "structured-light-scene", "two-vehicles-scene")
PHYSICAL_SCENES = ("shipwreck-scene", "structured-light-scene", "two-vehicles-scene")
EVERY = "window.uwsim !== undefined"
PLAYED_AND_STOPPED = """() => new Promise(done => {
    const press = () => document.dispatchEvent(new KeyboardEvent("keydown", { key: " " }))
    const look = () => {
        if (uwsim.time() <= 0.2) return requestAnimationFrame(look)
        press()
        done(uwsim.time())
    }
    uwsim.seek(0)
    press()
    look()
})"""
"""Play, and stop in the frame in which 0.2 s are over: a frame is 0.25 s at most."""


@pytest.fixture(scope="module")
def page(stored: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The address of the page with the replay of the result."""
    return Replay(stored).save(tmp_path_factory.mktemp("page") / "replay.html").as_uri()


@pytest.fixture
def replayed(tab: Any, page: str) -> Any:
    """The page with the replay of the result."""
    tab.goto(page)
    tab.wait_for_function(EVERY)
    return tab


def image(tab: Any, camera: dict[str, Any], water: dict[str, float]) -> npt.NDArray[np.int16]:
    text = tab.evaluate("([name, water]) => uwsim.image(name, water)", [camera["name"], water])
    pixels = np.frombuffer(base64.b64decode(text), np.uint8)
    return pixels.reshape(camera["height"], camera["width"], 4)[..., :3].astype(np.int16)


def test_curves_at_the_cursor_are_the_rows_of_the_log(replayed: Any, stored: Path) -> None:
    _, trial = journal.read_any(journal.path_of(stored, 0))
    samples = {  # where one level ends and the next one begins, the later one counts
        round(row.ended_at - row.duration + sample[0], 6): sample[1]
        for row in trial.rows
        for sample in row.logs["corners"]
    }
    chosen = random.Random(1).choices(list(samples.items()), k=100)
    script = "times => times.map(t => { uwsim.seek(t); return uwsim.curves().corners })"
    found = replayed.evaluate(script, [time for time, _ in chosen])
    for value, (time, wanted) in zip(found, chosen, strict=True):
        assert (value is None) == (wanted is None), time
        assert value is None or value == pytest.approx(wanted, rel=1e-6), time


def test_bodies_are_where_the_track_has_them(replayed: Any, stored: Path) -> None:
    track = load_track(stored / "units" / "00000.motion")
    for row in (0, 7, track.n_frames - 1):
        replayed.evaluate("t => uwsim.seek(t)", row / track.rate)
        for number, name in enumerate(track.bodies):
            matrix = replayed.evaluate("name => uwsim.body(name)", name)
            assert [matrix[3], matrix[7], matrix[11]] == pytest.approx(
                track.poses[row, number, :3], abs=1e-9
            )


def test_a_level_is_chosen_by_a_click_and_by_keys(replayed: Any, stored: Path) -> None:
    levels = load_track(stored / "units" / "00000.motion").levels
    replayed.get_by_role("button", name="fog 0.8").click()
    assert replayed.evaluate("uwsim.time()") == pytest.approx(levels[2].start_time)
    replayed.keyboard.press("[")
    assert replayed.evaluate("uwsim.level()") == 1
    replayed.keyboard.press("Home")
    assert replayed.evaluate("uwsim.time()") == 0.0
    replayed.keyboard.press(".")
    assert replayed.evaluate("uwsim.time()") == pytest.approx(1 / 30)


def test_a_link_to_a_level_opens_it(tab: Any, page: str, stored: Path) -> None:
    levels = load_track(stored / "units" / "00000.motion").levels
    tab.goto(page + "#level=2")
    tab.wait_for_function(EVERY)
    assert tab.evaluate("uwsim.time()") == pytest.approx(levels[2].start_time)


def test_it_plays(replayed: Any) -> None:
    replayed.keyboard.press(" ")
    replayed.wait_for_function("uwsim.time() === uwsim.page.player.end")
    stopped = replayed.evaluate(PLAYED_AND_STOPPED)
    assert 0.2 < stopped < 1.0
    replayed.evaluate("() => new Promise(requestAnimationFrame)")
    assert replayed.evaluate("uwsim.time()") == stopped


def test_views_and_switches_are_there_by_key(replayed: Any) -> None:
    def image() -> bytes:
        screenshot: bytes = replayed.locator("#view").screenshot()
        return screenshot

    replayed.evaluate("uwsim.go(2)")
    before = image()
    for key in "bvmof3cx":
        replayed.keyboard.press(key)
        after = image()
        assert after != before, key
        before = after
    replayed.keyboard.press("?")
    assert replayed.get_by_role("dialog").get_by_text("play, pause").is_visible()
    replayed.keyboard.press("Escape")
    theme = "document.documentElement.dataset.theme"
    before_theme = replayed.evaluate(theme)
    replayed.keyboard.press("n")
    assert replayed.evaluate(theme) != before_theme


def test_a_grey_camera_is_grey_in_the_page(tab: Any, tmp_path: Path) -> None:
    """As the simulation makes it grey, near and where there is no surface."""
    blob = Blob()
    with uwsim.load("shipwreck-scene") as simulation:
        head = scene_head(simulation, "grey", blob)
        (camera, *_) = head["cameras"]
        camera["grey"] = True
        path = tmp_path / "page.html"
        path.write_text(document("grey", make_pack(head, blob)), encoding="utf-8")
        tab.goto(path.as_uri())
        tab.wait_for_function(EVERY)
        view = simulation.world.sensors.camera(camera["name"])
        colour = simulation.world.scenery.render_clean(
            view.world_from_camera, view.intrinsics, fog=0.1
        ).colour
        assert colour is not None
        drawn = image(tab, camera, {"fog": 0.1})
    assert (drawn == drawn[..., :1]).all()
    off = np.abs(drawn[..., 0] - grey_truncated(colour.view(np.uint8)).astype(np.int16))
    assert off.mean() <= 1.0
    assert np.percentile(off, 99) <= 5.0


@pytest.mark.parametrize("scene", SCENES)
def test_cameras_see_in_fog_what_the_renderer_draws(tab: Any, scene: str, tmp_path: Path) -> None:
    text = scene_file(scene).read_text(encoding="utf-8")
    path = tmp_path / "scene.xml"
    path.write_text(re.sub("<u:water.*</u:water>", "", text, flags=re.DOTALL), encoding="utf-8")
    check_cameras(tab, str(path), tmp_path / "page.html", [{"fog": 0.0}, {"fog": 0.4}])


@pytest.mark.parametrize("scene", PHYSICAL_SCENES)
def test_cameras_see_what_the_renderer_draws(tab: Any, scene: str, tmp_path: Path) -> None:
    check_cameras(tab, scene, tmp_path / "page.html", [{}])


def check_cameras(tab: Any, scene: str, path: Path, waters: list[dict[str, float]]) -> None:
    """Compare the images of all cameras in some waters with those of the renderer."""
    blob = Blob()
    with uwsim.load(scene) as simulation:
        head = scene_head(simulation, scene, blob)
        path.write_text(document(scene, make_pack(head, blob)), encoding="utf-8")
        tab.goto(path.as_uri())
        tab.wait_for_function(EVERY)
        for camera in head["cameras"]:
            view = simulation.world.sensors.camera(camera["name"])
            for water in waters:
                drawn = simulation.world.scenery.render_clean(
                    view.world_from_camera, view.intrinsics, fog=water.get("fog")
                ).colour
                assert drawn is not None
                off = np.abs(image(tab, camera, water) - drawn)
                assert off.mean() <= 1.0
                assert np.percentile(off, 99) <= 4.0
                assert (off.max(axis=2) > 8).mean() <= 0.005
