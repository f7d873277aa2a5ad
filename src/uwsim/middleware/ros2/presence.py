"""The announcement of a node and its endpoints to other ROS 2 nodes, on ``ros_discovery_info``.

Without it, ``ros2 node list`` does not show the simulator.
"""

from __future__ import annotations

import threading
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from .names import DISCOVERY_TOPIC
from .participant import Participant, guid_of
from .quality import Quality
from .raw_types import raw_type

GID = "rmw_dds_common/msg/Gid"
NODE = "rmw_dds_common/msg/NodeEntitiesInfo"
PARTICIPANT = "rmw_dds_common/msg/ParticipantEntitiesInfo"
TEXTS = {
    GID: "uint8[16] data",
    NODE: (
        "string<=256 node_namespace\nstring<=256 node_name\n"
        f"{GID}[] reader_gid_seq\n{GID}[] writer_gid_seq"
    ),
    PARTICIPANT: f"{GID} gid\n{NODE}[] node_entities_info_seq",
}
"""The message types of ROS 2's package rmw_dds_common, as of Iron and later."""


class Presence:
    """The announced node, and its endpoints."""

    def __init__(self, participant: Participant, name: str, namespace: str = "/") -> None:
        self._store = get_typestore(Stores.ROS2_JAZZY)
        for ros_type, text in TEXTS.items():
            if ros_type not in self._store.types:
                self._store.register(get_types_from_msg(text, ros_type))
        self._guid = participant.guid
        self._name, self._namespace = name, namespace
        self._writer = participant.writer(
            DISCOVERY_TOPIC, raw_type(self._store, PARTICIPANT), Quality(depth=1, is_latched=True)
        )
        self._readers: list[bytes] = []
        self._writers: list[bytes] = []
        self._lock = threading.Lock()
        self.announce_endpoints()

    def add(self, *, readers: tuple[Any, ...] = (), writers: tuple[Any, ...] = ()) -> None:
        """Add endpoints to the node; `announce_endpoints` makes them known."""
        with self._lock:
            self._readers += [guid_of(entity) for entity in readers]
            self._writers += [guid_of(entity) for entity in writers]

    def remove(self, entity: Any) -> None:
        """Remove an endpoint from the node."""
        guid = guid_of(entity)
        with self._lock:
            for guids in (self._readers, self._writers):
                if guid in guids:
                    guids.remove(guid)

    def announce_endpoints(self) -> None:
        """Announce the node and its endpoints."""
        import numpy as np

        types = self._store.types

        def gid(guid: bytes) -> Any:
            return types[GID](data=np.frombuffer(guid, np.uint8))

        with self._lock:
            node = types[NODE](
                node_namespace=self._namespace,
                node_name=self._name,
                reader_gid_seq=[gid(endpoint_guid) for endpoint_guid in self._readers],
                writer_gid_seq=[gid(endpoint_guid) for endpoint_guid in self._writers],
            )
            sample = types[PARTICIPANT](gid=gid(self._guid), node_entities_info_seq=[node])
            self._writer.write(bytes(self._store.serialize_cdr(sample, PARTICIPANT)))
