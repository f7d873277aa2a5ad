"""Marine snow and bubbles in the page: the same ones as in the images of the simulation."""

from __future__ import annotations

import base64
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.viewer.live.test_pilot_page import page_of, server
from uwsim.assets.bundled import bundled_files
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession

__all__ = ["server"]
pytestmark = pytest.mark.slow
PARTICLES = re.compile(r"<u:particles>.*</u:particles>", re.DOTALL)
"""The particles of the scene."""
SNOW = "<u:marineSnow/>"
BUBBLES = """<u:bubbles> <u:source> <x>3.05</x> <y>5.35</y> <z>12.9</z> </u:source>
    <u:rate>500</u:rate> </u:bubbles>"""
NEAR_SURFACE = "<u:bubbles> <u:depthScale>20</u:depthScale> </u:bubbles>"


@pytest.mark.parametrize("kinds", [SNOW, BUBBLES, NEAR_SURFACE], ids=["snow", "plume", "bubbles"])
def test_particles_are_those_of_the_simulation(
    browser: Any, server: LiveServer, tmp_path: Path, kinds: str
) -> None:
    text = bundled_files("scenes")["wreck-physical-scene"].read_text()
    path = tmp_path / "scene.xml"
    path.write_text(PARTICLES.sub(f"<u:particles>{kinds}</u:particles>", text))
    session = LiveSession(server, mapping=PilotMapping())
    with uwsim.load(str(path)) as simulation:
        world = simulation.world
        assert world.scenery.particles is not None
        session.open(simulation, "scene")
        page = page_of(browser, server)
        simulation.advance(2.0)
        world.scenery.particles.state.displacement[:] = 0.31, -0.22, 0.13
        world.scenery.particles.state.velocity[:] = 0.2, 0.1, 0.05
        session.view._due = dict.fromkeys(session.view._due, 0.0)
        session.view.publish_due()
        page.wait_for_function("uwsim.page.player.snapshot().drift().velocity[0] > 0.19")
        camera = world.sensors.camera("camera")
        wanted = world.scenery.particles.find_visible(camera.world_from_camera, camera.intrinsics)
        colour = world.scenery.render_clean(
            camera.world_from_camera, camera.intrinsics, targets={"colour"}
        ).colour
        found = np.array(page.evaluate("uwsim.particles('camera')")).reshape(-1, 10)
        pixels = np.frombuffer(base64.b64decode(page.evaluate("uwsim.image('camera')")), np.uint8)
        session.close()
        page.context.close()
    assert wanted is not None
    assert colour is not None
    records = wanted.records.view(np.float32).reshape(-1, 10)
    assert len(records) > 50
    assert abs(len(found) - len(records)) <= 0.01 * len(records)  # those at the limit of the view
    distances = np.linalg.norm(found[:, None, :3] - records[None, :, :3], axis=2)
    nearest = distances.argmin(axis=1)
    assert np.percentile(distances.min(axis=1), 98) < 2e-3  # the row's resolution
    off = np.abs(found - records[nearest])
    assert np.percentile(off[:, 3:], 98, axis=0).max() < 2e-3
    drawn = pixels.reshape(*colour.shape[:2], 4)[..., :3].astype(np.int16)
    assert np.abs(drawn - colour).mean() <= 1.0
