"""A node of rospy with a period below 10 ms, as the original's dynamics, keeps simulation time."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.ros1_peers import PYTHON, needs_ros1, peers
from tests.support.waiting import LIMIT, wait_until
from uwsim.bus import Bus
from uwsim.messages import Float64
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import Ros1Bridge

pytestmark = [needs_ros1, pytest.mark.slow]

DYNAMICS = """
import sys
import rospy
from std_msgs.msg import Float64

period = float(sys.argv[1])
rospy.init_node("dynamics")
publish = rospy.Publisher("/integrated", Float64, queue_size=100).publish
rate, integrated = rospy.Rate(1.0 / period), 0.0
while not rospy.is_shutdown():
    integrated += period
    publish(integrated)
    WAIT
"""
"""Integrates with a fixed step, its period: it never asks how much time has passed."""
N_STEPS = 400
ANSWER_S = 0.05
"""How long a step waits for the loop, so that a loaded computer does not slow the node down [s]."""
SLEEP_S = 0.003
"""How long the loop may take from its answer to its sleep, which begins at the newest time [s]."""


@pytest.mark.parametrize(
    ("timestep", "wait"),
    [
        (0.001, "rospy.sleep(period)"),
        (0.001, "rate.sleep()"),
        (0.002, "rospy.sleep(period)"),
        (0.002, "rate.sleep()"),
    ],
)
def test_the_time_that_it_integrates_is_that_of_the_simulation(
    tmp_path: Path, timestep: float, wait: str
) -> None:
    program = tmp_path / "dynamics.py"
    program.write_text(DYNAMICS.replace("WAIT", wait))
    bus = Bus()
    inbox = bus.inbox("integrated", Float64)
    with peers(tmp_path) as graph:
        log = Log("test", lambda line: None)
        bridge = Ros1Bridge(bus, lambda: bus.step * timestep, master=graph.uri, log=log)
        try:
            bridge.step()
            assert bridge.wait(LIMIT)

            def step() -> None:
                n_before = bridge.arrivals.n_arrived["integrated"]
                bus.step += 1
                bus.deliver()
                bridge.step()
                bridge.wait_for(
                    lambda: bridge.arrivals.n_arrived["integrated"] > n_before, ANSWER_S
                )
                bridge.wait_for(lambda: False, SLEEP_S)

            def has_integrated() -> float:
                return inbox.last_message.data if inbox.last_message is not None else 0.0

            graph.start(PYTHON, str(program), str(timestep))
            wait_until(lambda: has_integrated() > 10 * timestep, step)
            value_before = has_integrated()
            for _ in range(N_STEPS):
                step()
            assert has_integrated() - value_before == pytest.approx(N_STEPS * timestep, rel=0.02)
        finally:
            bridge.close()
