"""Rows of free vehicles: independence, agreement with the step, rewards and ends of episodes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.envs.batch.batch_rows import FACTORS, LEVEL, RANGES, bluerov2, station_rows
from uwsim.envs.batch import columns as c
from uwsim.envs.batch.rows import Rows
from uwsim.envs.batch.task import Channel, Term, Trajectory
from uwsim.errors import BadSetting, UnknownName
from uwsim.physics.hydrodynamics.columns import WATER_COLUMNS
from uwsim.physics.hydrodynamics.kernel.free_rows import simulate_rows
from uwsim.physics.hydrodynamics.kernel.free_step import ACTUATORS


def actions_of(row: int, n_steps: int) -> np.ndarray:
    return np.random.default_rng(row).uniform(-1.0, 1.0, (n_steps, 8))


def run(rows: Rows, first: int = 0, n_steps: int = 30) -> list[bytes]:
    """Return the bytes of each row after some steps."""
    rows.reset(seeds=range(first, first + rows.n))
    tables = np.array([actions_of(first + i, n_steps) for i in range(rows.n)])
    rewards = np.zeros(rows.n)
    for k in range(n_steps):
        rows.step(tables[:, k])
        rewards += rows.rewards
    return [
        rows.states[i].tobytes() + rows.observations[i].tobytes() + rewards[i].tobytes()
        for i in range(rows.n)
    ]


@pytest.mark.parametrize("ranges", [RANGES, {**RANGES, **FACTORS}], ids=["nominal", "varied"])
def test_the_bytes_of_a_row_depend_on_its_seed_and_actions_alone(
    ranges: dict[str, tuple[float, float]],
) -> None:
    all_bytes = run(station_rows(256, ranges=ranges))

    assert run(station_rows(256, threads=2, ranges=ranges)) == all_bytes
    assert run(station_rows(7, ranges=ranges)) == all_bytes[:7]
    assert run(station_rows(1, ranges=ranges), first=100) == all_bytes[100:101]


def test_4096_rows_on_two_threads_have_the_bytes_of_single_rows() -> None:
    all_bytes = run(station_rows(4096, threads=2), n_steps=3)

    for i in (0, 2047, 2048, 4095):
        assert run(station_rows(1), first=i, n_steps=3) == all_bytes[i : i + 1]


def test_a_row_moves_as_the_step_of_a_free_vehicle() -> None:
    rows = station_rows(1)
    rows.reset(seeds=[3])
    states, levels = rows.states.copy(), rows.levels
    speed, heading = levels["current_speed"][0], levels["current_heading"][0]
    water = np.zeros(WATER_COLUMNS)
    water[:2] = speed * math.cos(heading), speed * math.sin(heading)
    actions = actions_of(3, 20)
    path = np.empty((1, 101, ACTUATORS))

    simulate_rows(bluerov2(), states, np.repeat(actions, 5, axis=0)[None], water, 0.01, path)
    for action in actions:
        rows.step(action[None])

    assert rows.states.tobytes() == states.tobytes()


def test_an_observation_has_the_error_in_base_axes() -> None:
    rows = station_rows(1, ranges={})
    levels = {"start_x": -1.0, "start_yaw": math.pi / 2.0}

    observation = rows.reset(seeds=[0], levels=levels)[0]

    # the base looks along y of W, its y axis (right) along x of W
    assert observation[:3] == pytest.approx([0.0, 1.0, 0.0], abs=1e-7)
    half = math.sqrt(0.5)
    assert np.abs(observation[3:7]) == pytest.approx([half, 0.0, 0.0, half], abs=1e-7)
    assert observation[6] > 0.0  # a turn to the right, about the axis down, leads to the goal


def test_the_reward_is_the_sum_of_its_terms() -> None:
    terms = (
        Term(name="constant", weight=2.0),
        Term(name="distance", weight=-3.0, scale=0.5),
        Term(name="effort", weight=-0.25),
        Term(name="closeness", weight=1.0, scale=2.0),
    )
    rows = station_rows(1, ranges={"start_x": (0.8, 0.8)}, terms=terms)
    rows.reset(seeds=[0])

    rows.step(np.full((1, 8), 0.5))

    error = float(np.linalg.norm(rows.states[0, :3] - (1.0, 2.0, -10.0)))
    expected = 2.0 - 3.0 * error / 0.5 - 0.25 * 0.25 + 1.0 / (1.0 + (error / 2.0) ** 2)
    assert rows.rewards[0] == pytest.approx(expected, rel=1e-12)
    assert rows.tallies[0, c.LAST_ERROR] == pytest.approx(error, rel=1e-12)


def test_a_row_that_leaves_the_region_terminates_and_others_are_truncated() -> None:
    rows = station_rows(2, ranges={}, max_steps=3, exit_distance=2.0)
    rows.reset(seeds=[0, 1], levels={"start_x": [2.5, 0.0]})

    ends = []
    for _ in range(3):
        rows.step(np.zeros((2, 8)))
        ends.append((rows.terminated.tolist(), rows.truncated.tolist()))

    assert ends[0] == ([True, False], [False, False])
    assert ends[2] == ([True, False], [False, True])


def test_a_row_at_the_goal_succeeds_after_the_steps_to_hold() -> None:
    rows = station_rows(1, ranges={}, tolerance=0.5, hold_steps=3, ends_on_success=True)
    rows.reset(seeds=[0])

    ends = [bool(rows.step(np.zeros((1, 8))) is not None and rows.terminated[0]) for _ in range(3)]

    assert ends == [False, False, True]
    assert rows.successes[0]


def test_a_masked_row_keeps_its_state() -> None:
    rows = station_rows(2)
    rows.reset(seeds=[0, 1])
    states = rows.states.copy()

    rows.step(np.ones((2, 8)), mask=np.array([True, False]))

    assert rows.states[0].tobytes() != states[0].tobytes()
    assert rows.states[1].tobytes() == states[1].tobytes()
    assert rows.steps.tolist() == [1, 0]


def test_a_delayed_action_acts_after_its_steps() -> None:
    rows = station_rows(2, ranges={})
    rows.reset(seeds=[0, 1], levels={"delay": [0.0, 2.0]})

    rows.step(np.ones((2, 8)))
    rows.step(np.ones((2, 8)))
    assert rows.states[:, ACTUATORS].tolist() == [pytest.approx(1.0, abs=0.05), 0.0]
    rows.step(np.zeros((2, 8)))
    assert rows.states[1, ACTUATORS] > 0.5


def test_a_dead_thruster_changes_the_motion_and_a_factor_of_one_does_not() -> None:
    rows = station_rows(3, ranges={})
    rows.reset(
        seeds=[0, 0, 0],
        levels={"lost_thruster": [-1.0, 2.0, -1.0], "loss": 1.0, "drag": 1.0, "mass": [1, 1, 1.0]},
    )
    for _ in range(10):
        rows.step(np.full((3, 8), 0.5))

    assert rows.states[0].tobytes() == rows.states[2].tobytes()
    assert rows.states[0].tobytes() != rows.states[1].tobytes()


@pytest.mark.parametrize("kind", ["circle", "helix", "lemniscate"])
def test_the_velocity_of_a_goal_is_the_rate_of_its_position(kind: str) -> None:
    channels = (
        Channel(name="position_error", frame="world"),
        Channel(name="position_error", frame="world", lead_time=1e-2),
        Channel(name="goal_velocity", frame="world"),
    )
    path = Trajectory(
        kind=kind, radius=2.0, period=20.0, climb=0.1, heading=0.7, phase=0.4, level=LEVEL
    )
    rows = station_rows(1, ranges={}, channels=channels, trajectory=path)

    now, next_error, velocity = rows.reset(seeds=[0])[0].reshape(3, 3)

    assert now == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert (next_error - now) / 1e-2 == pytest.approx(velocity, abs=3e-3)
    assert velocity[2] == pytest.approx(0.1 if kind == "helix" else 0.0)


def test_unknown_names_are_errors_with_the_nearest_valid_name() -> None:
    with pytest.raises(UnknownName, match="position_error"):
        station_rows(1, channels=(Channel(name="positon_error"),))
    with pytest.raises(UnknownName, match="effort"):
        station_rows(1, terms=(Term(name="efort"),))
    with pytest.raises(UnknownName, match="current_speed"):
        station_rows(1, ranges={"current_sped": (0.0, 1.0)})
    with pytest.raises(BadSetting, match="rows"):
        station_rows(0)
    with pytest.raises(BadSetting, match="seeds"):
        station_rows(1).reset()
