"""The position of the joint of an object as a measure."""

from __future__ import annotations

import pytest

from tests.support.fakes import FakeWorld
from uwsim.benchmark.measures import JointPositionSpec
from uwsim.errors import UnknownName


def test_the_extremes_and_the_greatest_speed_are_details() -> None:
    world = FakeWorld(timestep=0.01)
    world.joint_positions["valve"] = 0.1
    measure = JointPositionSpec(name="angle", target="valve").bind(world)
    assert measure.value is None
    assert set(measure.details.values()) == {None}
    measure.start()
    for position in (0.3, -0.1, 0.0):
        world.joint_positions["valve"] = position
        world.advance()
        measure.update()
    assert measure.value == 0.0
    assert measure.details == {"greatest": 0.3, "least": -0.1, "max_speed": pytest.approx(40.0)}


def test_an_object_without_a_joint_is_an_error() -> None:
    with pytest.raises(UnknownName):
        JointPositionSpec(name="angle", target="valv").bind(FakeWorld())
