"""A node of ROS 1 that needs no ROS installation: XML-RPC and TCPROS, as the ROS wiki defines them.

`Ros1Bridge` connects a bus to a ROS 1 graph. `connect` registers it with the master of
``ROS_MASTER_URI``, or starts a small master if none answers. All servers listen on loopback by
default.
"""

from __future__ import annotations

from .bridge import PeerTimeouts, Ros1Bridge
from .connect import Ros1Options, connect
from .master import Master

__all__ = ["Master", "PeerTimeouts", "Ros1Bridge", "Ros1Options", "connect"]
