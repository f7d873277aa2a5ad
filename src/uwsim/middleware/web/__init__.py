"""WebSocket connections of browsers and programs without ROS: the rosbridge protocol (version 2).

`server` listens, in a thread of its own; `session` handles one client with its subscriptions and
services; `graph`, `readers`, `client_services` and `republications` are shared by all clients;
`outgoing` encodes each message once for all its readers; `queue` limits the messages that wait for
a client.
"""

from __future__ import annotations
