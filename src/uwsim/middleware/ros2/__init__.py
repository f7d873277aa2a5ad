"""The simulator as a node of ROS 2 (`uwsim run --ros2`).

`adapter` connects a bus to a node, of which there are two (`choice`): `rclpy_node` is one of rclpy,
where ROS 2 is installed; `dds_node` needs the extra ``ros2`` (Cyclone DDS), and no ROS 2.
"""

from __future__ import annotations
