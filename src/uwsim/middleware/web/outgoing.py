"""A message on its way to web clients, encoded once for all who read it."""

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
from ..stamps import to_ros_clock
from .cbor import encode_cbor

COMPRESSIONS = ("none", "png", "cbor", "cbor-raw")


class Outgoing:
    """One message of a topic.

    Args:
        topic: its name, without a leading slash.
        message: as it is on the bus.
        size: about how many bytes it takes.
        convert: makes of it the message that is sent; called once, in the thread that sends.
        wrap: puts its fields into those of another message; not for ``cbor-raw``.
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
        self._converted: object = None
        self._wrap = wrap
        self._encoded: dict[str, str | bytes] = {}
        self.size = size
        """About how many bytes it takes."""

    def encoded(self, compression: str) -> str | bytes:
        """Return the frame of the protocol, in one of `COMPRESSIONS`."""
        if compression not in self._encoded:
            self._encoded[compression] = self._frame(compression)
        return self._encoded[compression]

    @property
    def _message(self) -> object:
        """The message that is sent, with its stamps on the clock of ROS."""
        if self._converted is None:
            self._converted = to_ros_clock(self._convert(self._source))
        return self._converted

    def _frame(self, compression: str) -> str | bytes:
        if compression == "cbor":
            plain = self._wrap(to_plain(self._message))
            return encode_cbor({"op": "publish", "topic": self._topic, "msg": plain})
        if compression == "cbor-raw":  # the message as CDR, as rosbridge of ROS 2 sends it
            raw = np.frombuffer(to_cdr(self._message), np.uint8)
            content = {"secs": 0, "nsecs": 0, "bytes": raw}
            return encode_cbor({"op": "publish", "topic": self._topic, "msg": content})
        if compression == "png":
            return packed_png(str(self.encoded("none")))
        fields = self._wrap(to_json(self._message))
        content = {"op": "publish", "topic": self._topic, "msg": fields}
        return json.dumps(content, separators=(",", ":"), allow_nan=False)


def packed_png(text: str) -> str:
    """Return a frame in rosbridge's compression ``png``: the text is the pixels of an image."""
    data = text.encode()
    width = max(1, math.isqrt(math.ceil(len(data) / 3)))
    height = math.ceil(len(data) / 3 / width)
    pixels = np.frombuffer(data.ljust(3 * width * height, b"\n"), np.uint8)
    _, png = cv2.imencode(".png", pixels.reshape(height, width, 3)[..., ::-1])
    packed: dict[str, Any] = {"op": "png", "data": base64.b64encode(png.tobytes()).decode()}
    return json.dumps(packed)
