"""The bus outside the process: message types as ROS knows them, and what all transports share.

`types` gives each message and service type its names, hashes and definitions in ROS 1 and ROS 2,
`encodings` and `json_encoding` turn messages into bytes and back, `stamps` moves their headers to
the clock of ROS, `bridge` connects a bus to a transport. Each transport is a package of its own.
"""

from __future__ import annotations
