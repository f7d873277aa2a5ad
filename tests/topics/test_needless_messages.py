"""What nobody reads is not measured where that changes nothing; `latest` has it all the same."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import uwsim
from uwsim.messages import JointState, Odometry, WrenchStamped
from uwsim.simulation import Simulation

READABLE = {
    "girona500/finger1": WrenchStamped,
    "girona500/joint_state": JointState,
    "truth/odometry": Odometry,
}


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    with uwsim.load("grasp-scene") as simulation:
        yield simulation


@pytest.mark.parametrize("topic", READABLE)
def test_the_newest_message_is_there_for_who_asks_later(simulation: Simulation, topic: str) -> None:
    simulation.advance(0.1)
    assert isinstance(simulation.latest_message(topic), READABLE[topic])


def test_in_a_trial_nothing_is_measured_for_nobody(simulation: Simulation) -> None:
    """What compiled steps sample, such as joints, is there all the same."""
    simulation.bus.keeps_unread_messages = False
    simulation.advance(0.1)
    assert simulation.bus.unread_message("girona500/finger1") is None


@pytest.mark.parametrize("topic", READABLE)
def test_in_a_trial_each_sample_comes_to_who_reads(simulation: Simulation, topic: str) -> None:
    simulation.bus.keeps_unread_messages = False
    simulation.advance(0.1)
    read: list[object] = []
    simulation.bus.subscribe(topic, READABLE[topic], read.append)
    simulation.advance(0.1)
    assert len(read) == 5


def test_a_sensor_with_noise_draws_it_for_nobody_too(simulation: Simulation) -> None:
    simulation.bus.keeps_unread_messages = False
    simulation.advance(0.1)
    assert simulation.bus.unread_message("girona500/imu") is not None
