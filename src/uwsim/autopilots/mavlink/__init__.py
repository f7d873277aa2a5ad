"""MAVLink: messages as values, their bytes, and the messages of vehicles under water.

Bytes are encoded and decoded by pymavlink, of the optional dependency ``uwsim[mavlink]``.
"""

from __future__ import annotations

from .codec import Codec, Identity
from .message import Message
from .stream import MessageReader

__all__ = ["Codec", "Identity", "Message", "MessageReader"]
