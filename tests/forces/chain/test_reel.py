"""The segments of a winch: their lengths add up, and new nodes lie on the tether."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.forces.chain.reel import LONGEST_SHARE, SHORTEST_SHARE, change_length

UNIT = 0.5


def chain(n_segments: int, capacity: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    positions = np.zeros((capacity + 1, 3))
    positions[: n_segments + 1, 0] = UNIT * np.arange(n_segments + 1)
    velocities = np.zeros_like(positions)
    velocities[: n_segments + 1, 1] = np.arange(n_segments + 1.0)
    return positions, velocities, np.full(capacity, UNIT)


def test_paying_out_and_hauling_in_keep_the_sum_of_the_lengths() -> None:
    positions, velocities, lengths = chain(4, 20)
    n, total = 4, 4 * UNIT
    for change in [0.07] * 90 + [-0.05] * 120:
        n = change_length(positions, velocities, lengths, n, UNIT, change)
        total += change
        assert lengths[:n].sum() == pytest.approx(total, rel=1e-12)
        assert lengths[: n - 1].tolist() == [UNIT] * (n - 1)
        assert SHORTEST_SHARE * UNIT <= lengths[n - 1] <= LONGEST_SHARE * UNIT


def test_a_new_node_lies_on_the_last_segment_with_the_velocity_there() -> None:
    positions, velocities, lengths = chain(4, 20)
    n = change_length(positions, velocities, lengths, 4, UNIT, 0.61 * UNIT)
    assert n == 5
    share = 1.0 / 1.61
    assert positions[4] == pytest.approx([UNIT * (3.0 + share), 0.0, 0.0])
    assert velocities[4] == pytest.approx([0.0, 3.0 + share, 0.0])
    assert positions[5].tolist() == [4 * UNIT, 0.0, 0.0]


def test_the_last_segment_grows_beyond_the_limit_where_no_node_is_left() -> None:
    positions, velocities, lengths = chain(4, 4)
    assert change_length(positions, velocities, lengths, 4, UNIT, UNIT) == 4
    assert lengths[3] == 2 * UNIT
