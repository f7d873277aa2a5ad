"""An algorithm that acts by the time alone, from its start."""

from __future__ import annotations

from uwsim.bus import Node
from uwsim.messages import Empty, Twist, TwistStamped, Vector3, header

TIMED = "tests.support.timed_algorithm:TimedPush"
"""Its name for ``--algorithm``; the tests are found from the root of the repository."""
PERIOD = 0.05
"""How often it commands [s]."""


class TimedPush:
    """Commands a velocity that grows with the time."""

    def start(self, node: Node) -> None:
        say = node.publisher("/dataNavigator", TwistStamped)

        def command() -> None:
            if node.now == 0.0:
                node.call("startBench", Empty())
            twist = Twist(linear=Vector3(x=0.01 * node.now, y=0.0, z=0.0))
            say(TwistStamped(header=header(node.now), twist=twist))

        node.create_timer(PERIOD, command)
