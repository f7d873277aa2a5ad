"""The medium of physical water in live views."""

from __future__ import annotations

import base64
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.support.packs import read_array, unpack
from tests.viewer.live.desk import Desk
from tests.viewer.live.test_pilot_page import page_of, server
from uwsim.optics import find_water
from uwsim.simulation import Simulation
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession
from uwsim.viewer.live.view import HEADER

__all__ = ["server"]
SCENE = "wreck-physical-scene"


def set_medium(simulation: Simulation, name: str, exposure: float = 1.0) -> None:
    state = simulation.world.scenery.state
    assert state.water.physical_water is not None
    optics = replace(state.water.physical_water, medium=find_water(name), exposure=exposure)
    state.water = replace(state.water, physical_water=optics)


def test_a_new_medium_is_sent_once() -> None:
    desk, now = Desk(), [0.0]

    def wall() -> float:
        now[0] += 1.0
        return now[0]

    session = LiveSession(desk, real_time_factor=0.0, wall=wall)  # type: ignore[arg-type]
    with uwsim.load(SCENE) as simulation:
        session.open(simulation, "scene")
        simulation.advance(0.02)
        assert desk.on("medium") == []
        set_medium(simulation, "jerlov-5C")
        simulation.advance(0.05)
        session.close()
    (message,) = desk.on("medium")
    assert message[0] == 5
    content, data = unpack(message[HEADER.size :])
    optics = content["optics"]
    medium = find_water("jerlov-5C")
    assert optics["scattering"] == list(medium.scattering)
    values = read_array(optics["transform"]["values"], data)
    ends = medium.phase_function.compute_transform([0.5, 120.0])
    assert [values[0], values[-1]] == pytest.approx(ends, rel=1e-5)


@pytest.mark.slow
def test_the_page_of_a_running_simulation_shows_the_new_medium(
    browser: Any, server: LiveServer
) -> None:
    session = LiveSession(server, mapping=PilotMapping())
    with uwsim.load(SCENE) as simulation:
        session.open(simulation, "scene")
        page = page_of(browser, server)
        set_medium(simulation, "jerlov-5C", exposure=3.0)
        session.view._due = dict.fromkeys(session.view._due, 0.0)
        session.view.publish_due()
        page.wait_for_function("uwsim.page.picture.media.entries.length === 2")
        page.wait_for_function("uwsim.page.player.snapshot().signal('exposure_level') > 1.5")
        camera = simulation.world.sensors.camera("camera")
        wanted = simulation.world.scenery.render_clean(
            camera.world_from_camera, camera.intrinsics, targets={"colour"}
        ).colour
        assert wanted is not None
        pixels = np.frombuffer(base64.b64decode(page.evaluate("uwsim.image('camera')")), np.uint8)
        session.close()
        page.context.close()
    drawn = pixels.reshape(*wanted.shape[:2], 4)[..., :3].astype(np.int16)
    assert np.abs(drawn - wanted).mean() <= 1.0
