"""Clouds of sediment in live views: their puffs are sent when they have moved."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.simulation.test_scene_particles import LOW_START, climb, load, state_of
from tests.viewer.live.desk import Desk
from tests.viewer.live.test_pilot_page import page_of, server
from uwsim.particles.puffs import N_COLUMNS
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession
from uwsim.viewer.live.view import HEADER, SEDIMENT

__all__ = ["server"]


@pytest.mark.slow
def test_the_puffs_of_the_simulation_are_sent(tmp_path: Path) -> None:
    desk, now = Desk(), [0.0]

    def wall() -> float:
        now[0] += 1.0
        return now[0]

    session = LiveSession(
        desk,  # type: ignore[arg-type]
        mapping=PilotMapping(),
        real_time_factor=0.0,
        wall=wall,
    )
    with load(tmp_path, "<u:sediment/>", start=LOW_START) as simulation:
        session.open(simulation, "scene")
        climb(simulation, 0.1)
        assert desk.on("sediment") == []
        climb(simulation, 1.0)
        state = state_of(simulation).sediment
        assert state is not None
        assert state.n_puffs > 0
        messages = desk.on("sediment")
        session.close()
    assert 2 <= len(messages) <= 4  # four times a second
    assert messages[-1][0] == SEDIMENT
    numbers = np.frombuffer(messages[-1][HEADER.size :], "<f8")
    assert numbers[0] == state.time
    np.testing.assert_array_equal(numbers[1:].reshape(-1, N_COLUMNS), state.puffs[: state.n_puffs])


@pytest.mark.slow
def test_the_page_has_the_puffs_of_the_simulation(
    browser: Any, server: LiveServer, tmp_path: Path
) -> None:
    session = LiveSession(server, mapping=PilotMapping())
    with load(tmp_path, "<u:sediment/>", start=LOW_START) as simulation:
        session.open(simulation, "scene")
        page = page_of(browser, server)
        climb(simulation, 0.6)
        session.view._due = dict.fromkeys(session.view._due, 0.0)
        session.view.publish_due()
        state = state_of(simulation).sediment
        assert state is not None
        assert state.n_puffs > 0
        page.wait_for_function(f"uwsim.puffs().length === {state.n_puffs}")
        np.testing.assert_allclose(page.evaluate("uwsim.puffs()"), state.puffs[: state.n_puffs])
        session.close()
        page.context.close()
