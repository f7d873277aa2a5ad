"""The log of the bridge, as messages on ``/rosout``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..log import Log
from ..stamps import clock_time
from ..types import WireType, ros1_store
from .publication import Publication

TYPE_NAME = "rosgraph_msgs/msg/Log"
"""The message type, which only ROS 1 has."""
WARNING = 4
"""The level of the messages: a warning."""


def publish_log(node: str, log: Log, clock: Callable[[], float], timeout: float) -> Publication:
    """Publish the lines of a log on ``/rosout``.

    Args:
        node: the name of the node.
        log: the log to publish, from now on.
        clock: a function that returns the simulation time [s].
        timeout: the time limit for a subscriber to read a message [s].
    """
    store = ros1_store()
    definition, md5 = store.generate_msgdef(TYPE_NAME, ros_version=1)
    header, message = store.types["std_msgs/msg/Header"], store.types[TYPE_NAME]
    kind = WireType(
        message=message,
        ros1_name=TYPE_NAME.replace("/msg/", "/"),
        md5=md5,
        ros1_definition=definition,
        ros2_name="",
        type_hash="",
        ros2_definition="",
    )

    def encode(line: Any, seq: int) -> memoryview:
        stamp = clock_time(clock())
        log_message = message(
            header=header(seq=seq, stamp=stamp, frame_id=""),
            level=WARNING,
            name=node,
            msg=line,
            file="",
            function="",
            line=0,
            topics=[],
        )
        data: memoryview = store.serialize_ros1(log_message, TYPE_NAME)
        return data

    publication = Publication("/rosout", kind, node, log, timeout, encode=encode)
    log.add_listener(publication.send)
    return publication
