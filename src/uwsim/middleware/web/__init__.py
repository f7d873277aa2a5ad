"""WebSocket: browsers and programs without ROS, by the rosbridge protocol (version 2).

`server` listens, in a thread of its own; `session` is one client with its subscriptions and offers;
`graph`, `readers`, `client_services` and `republications` are shared by the clients; `outgoing`
encodes each message once for all its readers; `queue` limits what waits for a client.
"""

from __future__ import annotations
