"""WebSocket: browsers and programs without ROS, by the rosbridge protocol (version 2).

`server` listens, in a thread of its own; `session` is one client with what it has asked for;
`graph`, `readers`, `client_services` and `republications` are what the clients share; `outgoing`
encodes each message once for all who read it; `queue` bounds what waits for a client.
"""

from __future__ import annotations
