"""Connections of the bus to external programs: message types, encodings and transports.

`types` has the names, hashes and definitions of message and service types in ROS 1 and ROS 2,
`encodings` and `json_encoding` convert messages to bytes and JSON and back, `stamps` converts the
stamps of headers between simulation time and ``/clock``, `bridge` connects a bus to a transport.
Each transport is a package of its own.
"""

from __future__ import annotations
