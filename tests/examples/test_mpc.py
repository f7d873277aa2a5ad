"""The controller of examples/learning/mpc.py."""

from __future__ import annotations

import runpy
from pathlib import Path

import gymnasium
import numpy as np
import pytest

import uwsim.envs  # noqa: F401  # registers the environments

pytest.importorskip("casadi", reason="the example needs CasADi, which uwsim does not")

PATH = Path(__file__).parents[2] / "examples" / "learning" / "mpc.py"
LAYOUT = {
    "positionError": slice(0, 3),
    "heading": slice(3, 5),
    "gravity": slice(5, 8),
    "linearVelocity": slice(8, 11),
    "angularVelocity": slice(11, 14),
}


def test_the_model_moves_as_the_rows_but_for_the_lag_of_the_rotors() -> None:
    model = runpy.run_path(str(PATH))["Model"]()
    rows = gymnasium.make_vec("uwsim/StationKeeping-v0", num_envs=1, stepper="rows")
    observations, _ = rows.reset(seed=0, options={"level": {"current": 0.0}})
    heading = observations[0, LAYOUT["heading"]]
    state = np.zeros(12)
    state[5] = np.arctan2(heading[1], heading[0])
    command = np.array([0.1, 0.2, 0.1, 0.2, 0.15, 0.15, 0.15, 0.15])
    thrusts = np.interp(command, model.commands, model.thrusts)
    for _ in range(40):
        observations, *_ = rows.step(command[None])
        state = np.array(model.step(state, thrusts, np.zeros(6), 0.05)).ravel()
    twist = np.concatenate([observations[0, 8:11], observations[0, 11:14]])
    np.testing.assert_allclose(state[6:], twist, atol=0.02)
    rows.close()


def test_the_controller_is_at_its_place_within_four_seconds_in_a_current() -> None:
    controller = runpy.run_path(str(PATH))["Mpc"]()
    controller.layout = LAYOUT
    rows = gymnasium.make_vec("uwsim/StationKeeping-v0", num_envs=1, stepper="rows")
    observations, _ = rows.reset(seed=0, options={"level": {"current": 0.2}})
    assert np.linalg.norm(observations[0, :3]) > 0.5
    for _ in range(80):
        observations, *_ = rows.step(controller(observations[0])[None])
    assert np.linalg.norm(observations[0, :3]) < 0.02
    rows.close()
