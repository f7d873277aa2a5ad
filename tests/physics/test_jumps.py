"""Jumps of kinematic bodies are motion over the time since the one before."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.physics.kinematics.jumps import MAX_JUMP, MAX_JUMP_SPEED, JumpTimes, jump_velocity


@pytest.mark.parametrize("timestep", [0.001, 0.002, 0.02, 0.3, 2.0])
def test_a_jump_takes_the_time_since_the_one_before_and_a_second_at_most(timestep: float) -> None:
    longest = max(1, round(MAX_JUMP / timestep))
    times = JumpTimes(timestep, last_step=0)
    assert times.n_steps == 0
    step = 0
    for pause in (1, 2, longest - 1, longest, longest + 1, 10 * longest, 1):
        step += max(1, pause)
        times.add(step)
        assert times.n_steps == min(max(1, pause), longest)
        assert times.duration == times.n_steps * timestep
        assert [times.age(step), times.age(step + 3)] == [0, 3]


def test_the_first_jump_of_what_was_placed_long_ago_takes_a_second() -> None:
    times = JumpTimes(0.01, n_steps=1)
    times.add(0)
    assert times.n_steps == 100
    times.add(5)
    assert times.n_steps == 5
    times.forget()
    times.add(7)
    assert times.n_steps == 100


def test_several_jumps_in_a_step_take_a_step() -> None:
    times = JumpTimes(0.01, last_step=0)
    times.add(4)
    times.add(4)
    assert times.n_steps == 1


@pytest.mark.parametrize(
    ("speed", "is_motion"),
    [(0.0, True), (MAX_JUMP_SPEED, True), (np.nextafter(MAX_JUMP_SPEED, np.inf), False)],
)
def test_what_is_faster_than_a_body_moves_is_a_placement(speed: float, is_motion: bool) -> None:
    velocity = np.array([speed, 0.0, -1.0])
    assert np.array_equal(jump_velocity(velocity, speed), velocity * is_motion)
