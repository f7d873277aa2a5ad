"""What the bridge reports, as messages on ``/rosout``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..log import Log
from ..stamps import clock_time
from ..types import WireType, ros1_store
from .publication import Publication

NAME = "rosgraph_msgs/msg/Log"
"""Its type, which only ROS 1 has."""
WARNING = 4
"""Level of its messages."""


def rosout(node: str, log: Log, clock: Callable[[], float], send_timeout: float) -> Publication:
    """Return the publication on ``/rosout`` of a log's lines.

    Args:
        node: name of the node.
        log: whose lines are published from now on.
        clock: returns the simulation time [s].
        send_timeout: how long a subscriber may take to read a message [s].
    """
    store = ros1_store()
    definition, md5 = store.generate_msgdef(NAME, ros_version=1)
    header, message = store.types["std_msgs/msg/Header"], store.types[NAME]
    kind = WireType(
        message=message,
        ros1_name=NAME.replace("/msg/", "/"),
        md5=md5,
        ros1_definition=definition,
        ros2_name="",
        type_hash="",
        ros2_definition="",
    )

    def encode(line: Any, seq: int) -> memoryview:
        stamp = clock_time(clock())
        found = message(
            header=header(seq=seq, stamp=stamp, frame_id=""),
            level=WARNING,
            name=node,
            msg=line,
            file="",
            function="",
            line=0,
            topics=[],
        )
        encoded: memoryview = store.serialize_ros1(found, NAME)
        return encoded

    publication = Publication("/rosout", kind, node, log, send_timeout, encode=encode)
    log.add_listener(publication.send)
    return publication
