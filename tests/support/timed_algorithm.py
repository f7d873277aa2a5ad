"""An algorithm that depends on time alone, from its start."""

from __future__ import annotations

from uwsim.bus import Node
from uwsim.messages import Empty, Twist, TwistStamped, Vector3, header

TIMED_PUSH = "tests.support.timed_algorithm:TimedPush"
"""The name for ``--algorithm``, importable from the root of the repository."""
PERIOD = 0.05
"""The period of the commands [s]."""


class TimedPush:
    """An algorithm that commands a velocity that grows with time."""

    def start(self, node: Node) -> None:
        publish = node.publisher("/dataNavigator", TwistStamped)

        def command() -> None:
            if node.now == 0.0:
                node.call("startBench", Empty())
            twist = Twist(linear=Vector3(x=0.01 * node.now, y=0.0, z=0.0))
            publish(TwistStamped(header=header(node.now), twist=twist))

        node.create_timer(PERIOD, command)
