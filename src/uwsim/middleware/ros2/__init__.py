"""The simulator as a node of ROS 2, on DDS (`uwsim run --ros2`).

It needs the extra ``ros2`` (Cyclone DDS), and no ROS 2. `adapter` connects a bus; `participant` and
`presence` make a node that ROS 2 knows as one of its own.
"""

from __future__ import annotations
