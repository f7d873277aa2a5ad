"""The water's surface and the sky in the page, against the images of the renderer."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import uwsim
from uwsim.base.geometry import Pose
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.simulation import Simulation
from uwsim.simulation.tracked_state import WAVE_SCALE, TrackedState
from uwsim.viewer.caustics import describe_focusing_waves
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack
from uwsim.viewer.surface import describe_moving_surface

SCENE = "pier-waves-scene"
SEED = 5
"""The seed of the second trial."""
SCALE = 1.3
"""The factor on the amplitudes of waves in the initial state."""
VIEWS = {
    "above": ((13.0, -9.0, 2.2), (0.0, 0.0, 0.6)),
    "below": ((6.0, -7.0, -4.0), (1.0, -1.0, -0.2)),
    "window": ((3.0, -4.0, -5.0), (2.0, -3.5, 0.0)),
    "line": ((8.0, -6.0, 0.1), (0.0, 0.0, 0.2)),
}
"""The positions of cameras in W and the points at which they look [m]."""


def look_at(eye: tuple[float, ...], point: tuple[float, ...]) -> Pose:
    back = np.subtract(eye, point)
    back /= np.linalg.norm(back)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    return Pose(np.array(eye), np.stack([right, np.cross(back, right), back], axis=1))


def draw_scene(simulation: Simulation, pose: Pose, time: float) -> npt.NDArray[np.uint8]:
    """Return the image of the renderer with the surface at a time."""
    world = simulation.world
    surface = MovingSurface(
        time=time,
        waves=world.water.waves,
        wave_scale=float(world.water.state.wave_scale[0]),
        seed=world.model.seed,
    )
    world.scenery.set_surface(lambda: surface)
    lens = world.sensors.camera(world.sensors.cameras[0]).intrinsics
    colour = world.scenery.render_view(pose, lens, targets={"colour"}).colour
    assert colour is not None
    return colour.view(np.uint8)


def draw_page(tab: Any, pose: Pose, shape: tuple[int, ...]) -> npt.NDArray[np.int16]:
    text = tab.evaluate("(pose) => uwsim.external(pose, false)", pose.matrix.ravel().tolist())
    pixels = np.frombuffer(base64.b64decode(text), np.uint8)
    return pixels.reshape(*shape[:2], 4)[..., :3].astype(np.int16)


def make_trial(title: str) -> dict[str, Any]:
    level = {"label": title, "status": "ok", "why": None, "start": 0.0, "end": 9.0, "values": {}}
    return {"title": title, "motion": None, "levels": [level], "curves": [], "poses": {}}


@pytest.mark.slow
def test_the_page_shows_the_surface_of_the_renderer(tab: Any, tmp_path: Path) -> None:
    """At two times, from above, from below and at the water line, and with another seed."""
    blob, poses = Blob(), {name: look_at(*view) for name, view in VIEWS.items()}
    cases = [(0, "above", 0.0), (0, "below", 0.0), (0, "window", 4.5), (0, "line", 4.5)]
    cases += [(1, "above", 2.25), (1, "below", 2.25)]
    with uwsim.load(SCENE) as first, uwsim.load(SCENE, seed=SEED) as second:
        for simulation in (first, second):
            simulation.world.water.state.wave_scale[0] = SCALE
        head = scene_head(first, SCENE, blob)
        entries = {
            "surface": describe_moving_surface(second.world, blob),
            "caustics": describe_focusing_waves(second.world, blob),
        }
        head["trials"] = [make_trial("first"), make_trial("second") | entries]
        wanted = [draw_scene((first, second)[i], poses[name], time) for i, name, time in cases]
    (tmp_path / "page.html").write_text(document(SCENE, make_pack(head, blob)), encoding="utf-8")
    tab.goto((tmp_path / "page.html").as_uri())
    tab.wait_for_function("window.uwsim !== undefined")
    assert np.abs(wanted[0].astype(np.int16) - wanted[4]).mean() > 3.0
    for (trial, name, time), image in zip(cases, wanted, strict=True):
        tab.evaluate("(level) => uwsim.go(level)", trial)
        tab.evaluate("(time) => uwsim.seek(time)", time)
        off = np.abs(draw_page(tab, poses[name], image.shape) - image)
        assert image.mean() > 50.0
        assert off.mean() <= 1.0, (trial, name)
        assert np.percentile(off, 99) <= 4.0, (trial, name)


def test_the_scale_of_the_waves_is_recorded() -> None:
    with uwsim.load(SCENE) as simulation:
        state = TrackedState(simulation.world)
        simulation.world.water.state.wave_scale[0] = SCALE
        names = [signal.name for signal in state.signals]
        values = state.row()[-len(names) :]
        assert values[names.index(WAVE_SCALE)] == SCALE
    with uwsim.load("shapes-scene") as simulation:
        names = [signal.name for signal in TrackedState(simulation.world).signals]
        assert WAVE_SCALE not in names
