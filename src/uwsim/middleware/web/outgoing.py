"""A message to web clients, encoded once for all its readers."""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np

from ..encodings import to_cdr
from ..json_encoding import to_json, to_plain
from ..stamps import to_ros_time
from .cbor import encode_cbor

COMPRESSIONS = ("none", "png", "cbor", "cbor-raw")
"""The encodings of messages that a client may select, as rosbridge names them."""


class EncodedMessage:
    """A message of a topic, encoded once for all clients.

    Args:
        topic: the name of the topic, without a leading slash.
        message: the message on the bus.
        size: the approximate size of the message [bytes].
        convert: a function that converts the message on the bus to the message to send; it is
            called once, in the thread that sends.
        wrap: a function that returns the fields of a message that contains the given fields; not
            applied for ``cbor-raw``.
    """

    def __init__(
        self,
        topic: str,
        message: object,
        size: int,
        convert: Callable[[Any], object] = lambda message: message,
        wrap: Callable[[dict[str, Any]], dict[str, Any]] = lambda fields: fields,
    ) -> None:
        self._topic, self._source, self._convert = f"/{topic}", message, convert
        self._sent_message: object = None
        self._wrap = wrap
        self._frames: dict[str, str | bytes] = {}
        self.size = size
        """The approximate size of the message [bytes]."""

    def frame(self, compression: str) -> str | bytes:
        """Return the frame of the protocol, in one of `COMPRESSIONS`."""
        if compression not in self._frames:
            self._frames[compression] = self._encode(compression)
        return self._frames[compression]

    @property
    def _message(self) -> object:
        """The message to send, with its stamps in the time of ``/clock``."""
        if self._sent_message is None:
            self._sent_message = to_ros_time(self._convert(self._source))
        return self._sent_message

    def _encode(self, compression: str) -> str | bytes:
        if compression == "cbor":
            plain_fields = self._wrap(to_plain(self._message))
            return encode_cbor({"op": "publish", "topic": self._topic, "msg": plain_fields})
        if compression == "cbor-raw":  # the message as CDR, as rosbridge of ROS 2 sends it
            cdr_bytes = np.frombuffer(to_cdr(self._message), np.uint8)
            content = {"secs": 0, "nsecs": 0, "bytes": cdr_bytes}
            return encode_cbor({"op": "publish", "topic": self._topic, "msg": content})
        if compression == "png":
            return encode_png_frame(str(self.frame("none")))
        fields = self._wrap(to_json(self._message))
        content = {"op": "publish", "topic": self._topic, "msg": fields}
        return json.dumps(content, separators=(",", ":"), allow_nan=False)


def encode_png_frame(text: str) -> str:
    """Encode a frame in rosbridge's compression ``png``: the text is the pixels of an image."""
    data = text.encode()
    width = max(1, math.isqrt(math.ceil(len(data) / 3)))
    height = math.ceil(len(data) / 3 / width)
    pixels = np.frombuffer(data.ljust(3 * width * height, b"\n"), np.uint8)
    _, png = cv2.imencode(".png", pixels.reshape(height, width, 3)[..., ::-1])
    frame: dict[str, Any] = {"op": "png", "data": base64.b64encode(png.tobytes()).decode()}
    return json.dumps(frame)
