"""A node of ROS 1 without any ROS: XML-RPC and TCPROS, as in the ROS wiki's technical overview.

`Ros1Bridge` connects a bus to a ROS 1 graph: it registers with the master of ``ROS_MASTER_URI``, or
starts a small one if there is none. All servers listen on loopback by default.
"""

from __future__ import annotations

from .bridge import PeerTimeouts, Ros1Bridge
from .connect import Ros1Options, connect
from .master import Master

__all__ = ["Master", "PeerTimeouts", "Ros1Bridge", "Ros1Options", "connect"]
