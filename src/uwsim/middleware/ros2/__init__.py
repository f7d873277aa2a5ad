"""The simulator as a node of ROS 2 (`uwsim run --ros2`).

`adapter` connects a bus to a node. There are two implementations of the node, of which `choice`
selects one: `rclpy_node` uses rclpy, where ROS 2 is installed; `dds_node` needs no ROS 2, but the
extra ``ros2`` (Cyclone DDS).
"""

from __future__ import annotations
