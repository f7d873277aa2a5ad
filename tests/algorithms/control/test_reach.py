"""The estimate of the water's velocity by which ``reach`` opposes a current."""

from __future__ import annotations

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.control.reach import Reach, ReachProportional
from uwsim.algorithms.grasp.arm import DOWN_POSTURE


@pytest.mark.parametrize(("algorithm", "speed"), [(Reach, 0.02), (ReachProportional, 0.0)])
def test_a_vehicle_that_drifts_is_commanded_against_the_current(
    algorithm: type[Reach], speed: float
) -> None:
    controller = algorithm()
    controller.start(FakeNode())
    handle = np.zeros(9)  # at the tool
    handle[7] = 1.0  # the bar across the closing axis
    values = [handle, DOWN_POSTURE, np.array([-0.2, 0.0, 0.0]), np.zeros(3), np.array([0, 0, 1.0])]
    parts = dict(zip(controller.channels, values, strict=True))
    velocity, turn_rate = controller.command(parts, 0.1)  # a tenth of the time of the filter
    np.testing.assert_allclose(velocity, [speed, 0.0, 0.0], atol=1e-9)
    assert turn_rate == 0.0
