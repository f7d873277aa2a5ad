"""A lamp is as bright as it was told last, and fully until then."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.test_lamp import LAMP, brightness, night
from tests.support.opened import open_scene
from uwsim.messages import Float64
from uwsim.simulation.tracked_state import TrackedState

TOPIC = "headlight/brightness"


def test_light_is_in_proportion_to_the_brightness_that_is_commanded() -> None:
    with open_scene(night(replace(LAMP, intensity=1.0))) as simulation:
        simulation.advance(0.01)
        full = brightness(simulation)
        simulation.publish(TOPIC, Float64(data=0.5))
        simulation.advance(0.01)
        assert brightness(simulation) == pytest.approx(0.5 * full, abs=1.5)
        simulation.publish(TOPIC, Float64(data=0.0))
        simulation.advance(0.01)
        assert brightness(simulation).max() <= 1.0
        simulation.publish(TOPIC, Float64(data=1.0))
        simulation.advance(0.01)
        assert np.array_equal(brightness(simulation), full)


@pytest.mark.parametrize(
    ("told", "shines"), [(-2.0, 0.0), (7.0, 1.0), (math.inf, 1.0), (math.nan, 0.25)]
)
def test_what_is_beyond_the_range_is_its_end_and_no_number_changes_nothing(
    told: float, shines: float
) -> None:
    with open_scene(night(LAMP), is_blind=True) as simulation:
        (lamp,) = simulation.world.scenery.mounted_lamps
        for value in (0.25, told):
            simulation.publish(TOPIC, Float64(data=value))
            simulation.advance(0.01)
        assert lamp.intensity == shines * LAMP.intensity


def test_brightness_is_saved() -> None:
    scene = night(LAMP)
    with open_scene(scene, is_blind=True) as first, open_scene(scene, is_blind=True) as second:
        first.publish(TOPIC, Float64(data=0.3))
        first.advance(0.1)
        second.restore(first.save())
        (lamp,) = second.world.scenery.mounted_lamps
        assert lamp.intensity == 0.3 * LAMP.intensity


def test_a_live_view_gets_the_brightness() -> None:
    with open_scene(night(LAMP), is_blind=True) as simulation:
        state = TrackedState(simulation.world)
        assert state.signals[-1].name == "lamp/headlight"
        assert state.row()[-1] == 1.0
        simulation.publish(TOPIC, Float64(data=0.3))
        simulation.advance(0.01)
        assert state.row()[-1] == 0.3


def test_the_topic_is_listed() -> None:
    (topic,) = LAMP.topics
    assert (topic.name, topic.is_subscribed) == (TOPIC, True)
    with open_scene(night(LAMP), is_blind=True) as simulation:
        assert simulation.topics[TOPIC] == "std_msgs/msg/Float64"
