"""Clouds of sediment in the page, in replays and live views, against the images of the renderer."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import uwsim
from tests.simulation.test_scene_particles import LOW_START, climb, load
from tests.viewer.test_surface_page import look_at
from uwsim.particles.puffs import MAX_PUFFS
from uwsim.results.motion import read_track
from uwsim.results.motion.stirred_sediment import MASS_COLUMN, NO_VALUE
from uwsim.runs.trial.motion_events import SedimentLog
from uwsim.runs.trial.motion_recorder import MotionRecorder
from uwsim.viewer.document import document
from uwsim.viewer.film.recorded_puffs import RecordedPuffs
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack

VIEW = look_at((11.0, 2.5, -13.2), (8.5, 5.0, -14.8))
TIMES = (0.3, 1.1, 3.0)
"""The times of images: without clouds, with some, and after the greatest number of puffs [s]."""
CURRENT = """
<u:current> <u:constant>
  <u:velocity> <x>0.1</x> <y>-0.05</y> <z>0</z> </u:velocity>
</u:constant> </u:current>
"""


def open_scene(folder: Path) -> uwsim.Simulation:
    kinds = "<u:marineSnow/><u:sediment/>"
    return load(folder, kinds, current=CURRENT, start=LOW_START)


def draw_scene(simulation: uwsim.Simulation) -> npt.NDArray[np.uint8]:
    lens = simulation.world.sensors.camera(simulation.world.sensors.cameras[0]).intrinsics
    colour = simulation.world.scenery.render_view(VIEW, lens, targets={"colour"}).colour
    assert colour is not None
    return colour.view(np.uint8)


def draw_page(tab: Any, shape: tuple[int, ...]) -> npt.NDArray[np.int16]:
    text = tab.evaluate("(pose) => uwsim.external(pose, false)", VIEW.matrix.ravel().tolist())
    pixels = np.frombuffer(base64.b64decode(text), np.uint8)
    return pixels.reshape(*shape[:2], 4)[..., :3].astype(np.int16)


def make_trial(track: bytes, blob: Blob) -> dict[str, Any]:
    level = {"label": "x", "status": "ok", "why": None, "start": 0.0, "end": 3.0, "values": {}}
    trial = {"title": "x", "motion": blob.add_bytes(track), "levels": [level], "curves": []}
    return trial | {"poses": {}}


def stir(simulation: uwsim.Simulation, n_periods: int) -> None:
    """Add five puffs in each period, more than there may be."""
    particles = simulation.world.scenery.particles
    assert particles is not None
    assert particles.sediment is not None
    puffs, generator = particles.sediment.puffs, np.random.default_rng(1)
    for _ in range(n_periods):
        simulation.advance(0.25)
        for _ in range(5):
            place, velocity = generator.normal(size=3), 0.2 * generator.normal(size=3)
            puffs.add(place, 0.1, 0.01, velocity, -2.0)


def read_puffs(simulation: uwsim.Simulation) -> npt.NDArray[np.float64]:
    particles = simulation.world.scenery.state.particles
    assert particles is not None
    assert particles.sediment is not None
    return particles.sediment.puffs[: particles.sediment.n_puffs].copy()


def read_velocity(simulation: uwsim.Simulation) -> npt.NDArray[np.float64]:
    particles = simulation.world.scenery.state.particles
    assert particles is not None
    return particles.velocity.copy()


@pytest.mark.slow
def test_a_replay_shows_the_clouds_that_thrusters_stirred_up(tab: Any, tmp_path: Path) -> None:
    blob, images = Blob(), []
    with open_scene(tmp_path) as simulation:
        head = scene_head(simulation, "sediment", blob)
        recorder = MotionRecorder(simulation, ())
        recorder.start()
        for time in TIMES:
            climb(simulation, time - simulation.time)
            images.append((simulation.time, draw_scene(simulation)))
        track = recorder.track()
    assert read_track(track).n_frames == 91
    head["trials"] = [make_trial(track, blob)]
    (tmp_path / "page.html").write_text(document("x", make_pack(head, blob)), encoding="utf-8")
    tab.goto((tmp_path / "page.html").as_uri())
    tab.wait_for_function("window.uwsim !== undefined")
    page_images = []
    for time, image in reversed(images):
        tab.evaluate("(time) => uwsim.seek(time)", time)
        page_images.append(draw_page(tab, image.shape))
        off = np.abs(page_images[-1] - image)
        assert off.mean() <= 1.0, time
        assert np.percentile(off, 99) <= 4.0, time
    assert np.abs(page_images[0] - page_images[-1]).mean() > 3.0


@pytest.mark.slow
def test_puffs_merge_and_vanish_in_replays_and_films_as_in_the_simulation(
    tab: Any, tmp_path: Path
) -> None:
    """After more births than there may be puffs, and after a reset of the scene."""
    blob, high_start = Blob(), LOW_START.replace("13.2", "4")
    with load(tmp_path, "<u:sediment/>", current=CURRENT, start=high_start) as simulation:
        head = scene_head(simulation, "sediment", blob)
        recorder = MotionRecorder(simulation, ())
        recorder.start()
        data = simulation.state.to_bytes()
        stir(simulation, 30)
        simulation.advance(0.1)
        puffs = read_puffs(simulation)
        assert len(puffs) == MAX_PUFFS
        end, velocity = simulation.time, read_velocity(simulation)
        track = recorder.track()
        log = SedimentLog(simulation)
        log.update()
        simulation.restore(data)
        log.update()
        particles = simulation.world.scenery.particles
        assert particles is not None
        assert particles.sediment is not None
        births = read_track(track).sediment
        recorded = RecordedPuffs(particles.sediment, births, lambda _: velocity)
        for time in (end, 3.0, end):
            recorded.show(time)
            assert len(read_puffs(simulation)) == (60 if time == 3.0 else MAX_PUFFS)
        np.testing.assert_allclose(read_puffs(simulation), puffs, atol=2e-3)
    table = log.sediment().table
    assert len(table) == MAX_PUFFS + 1
    assert table[-1, MASS_COLUMN] == NO_VALUE
    head["trials"] = [make_trial(track, blob)]
    (tmp_path / "page.html").write_text(document("x", make_pack(head, blob)), encoding="utf-8")
    tab.goto((tmp_path / "page.html").as_uri())
    tab.wait_for_function("window.uwsim !== undefined")
    tab.evaluate("(time) => uwsim.seek(time)", end)
    np.testing.assert_allclose(tab.evaluate("uwsim.puffs()"), puffs, atol=2e-3)
