"""A message on its way to web clients, encoded once for all who read it."""

from __future__ import annotations

import base64
import json
import math
from typing import Any

import cv2
import numpy as np

from ..json_encoding import to_json, to_plain
from ..stamps import outward
from .cbor import encode_cbor

COMPRESSIONS = ("none", "png", "cbor")


class Outgoing:
    """One message of a topic.

    Args:
        topic: its name, without a leading slash.
        message: as it is on the bus.
    """

    def __init__(self, topic: str, message: object, size: int) -> None:
        self._topic, self._message = f"/{topic}", message
        self._encoded: dict[str, str | bytes] = {}
        self.size = size
        """About how many bytes it takes."""

    def encoded(self, compression: str) -> str | bytes:
        """Return the frame of the protocol, in one of `COMPRESSIONS`."""
        if compression not in self._encoded:
            self._encoded[compression] = self._frame(compression)
        return self._encoded[compression]

    def _frame(self, compression: str) -> str | bytes:
        if compression == "cbor":
            plain = to_plain(outward(self._message))
            return encode_cbor({"op": "publish", "topic": self._topic, "msg": plain})
        if compression == "png":
            return packed_png(str(self.encoded("none")))
        content = {"op": "publish", "topic": self._topic, "msg": to_json(outward(self._message))}
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
