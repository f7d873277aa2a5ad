"""Sand that a dredge took is missing in replays, films and live views at the right time."""

from __future__ import annotations

import struct
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.devices.test_dredge_tool import scene
from tests.runs.trial.test_motion_of_sand import recorded
from tests.support.opened import open_scene
from tests.viewer.live.desk import Desk
from uwsim.results.motion import read_track
from uwsim.simulation import Simulation
from uwsim.viewer.document import document
from uwsim.viewer.film.trial_scene import TrialScene
from uwsim.viewer.head import scene_head
from uwsim.viewer.live.session import LiveSession
from uwsim.viewer.pack import Blob, make_pack
from uwsim.viewer.recorded import RecordedTrial


def page_of(simulation: Simulation, motion: bytes, title: str = "dredge") -> str:
    """A replay of one trial without levels."""
    blob = Blob()
    head = scene_head(simulation, title, blob)
    trial = {"title": title, "motion": blob.add_bytes(motion), "levels": [], "curves": []}
    return document(title, make_pack({**head, "trials": [trial]}, blob))


def test_a_film_shows_the_sand_of_its_moment(tmp_path: Path) -> None:
    motion, frames = recorded(tmp_path)
    trial = RecordedTrial(
        directory=tmp_path,
        index=0,
        title="dredge",
        seed=0,
        scene=scene(tmp_path, 1.0),
        timestep=0.002,
        compatibility=frozenset(),
        data_path=(),
        track=read_track(motion),
        levels=(),
    )
    shown = TrialScene(trial)
    other = TrialScene(replace(trial, title="of the same scene"), shown.simulation)
    (heap,) = shown.simulation.world.scenery.heaps
    for frame in (0, 4, 12, len(frames) - 1, 2):
        other.show_time(0.3)
        shown.show_time((frame + 0.5) / 30.0)
        assert (heap.heights == frames[frame]).all(), frame
    shown.close()


@pytest.mark.slow
def test_the_page_shows_the_sand_of_its_moment(tab: Any, tmp_path: Path) -> None:
    motion, frames = recorded(tmp_path)
    path = tmp_path / "page.html"
    with open_scene(scene(tmp_path, 1.0)) as simulation:
        path.write_text(page_of(simulation, motion), encoding="utf-8")
        tab.goto(path.as_uri())
        tab.wait_for_function("window.uwsim !== undefined")
        (heap,) = simulation.world.scenery.heaps
        seen = {}
        for frame in (0, 4, 12, len(frames) - 1, 2):
            tab.evaluate("t => uwsim.seek(t)", frame / 30.0 + 1e-4)
            found = np.array(tab.evaluate("uwsim.sand(0)")).reshape(heap.heights.shape)
            assert found == pytest.approx(frames[frame], abs=1e-6), frame
            seen[frame] = tab.locator("#image").screenshot()
        assert seen[0] != seen[12] != seen[len(frames) - 1]


def test_a_live_view_sends_a_heap_when_it_has_changed(tmp_path: Path) -> None:
    desk, now = Desk(), [0.0]

    def wall() -> float:
        now[0] += 0.1
        return now[0]

    session = LiveSession(desk, real_time_factor=0.0, wall=wall)  # type: ignore[arg-type]
    spec = scene(tmp_path, 1.0)
    with open_scene(spec, is_blind=True) as simulation:
        session.open(simulation, "scene")
        simulation.advance(0.1)
        assert desk.on("sand/0") == []
        (heap,) = simulation.world.scenery.heaps
        heap.dig(heap.corner + np.array([0.3, 0.3, 0.1]))
        simulation.advance(0.1)
        assert len(desk.on("sand/0")) == 1
        assert struct.unpack_from("<BB", desk.on("sand/0")[0]) == (4, 0)
        heights = np.frombuffer(desk.on("sand/0")[0], "<f4", offset=16)
        assert heights == pytest.approx(heap.heights.ravel(), abs=1e-6)
