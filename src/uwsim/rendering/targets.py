"""What a picture is drawn into: only the targets asked for."""

from __future__ import annotations

import moderngl
import numpy as np
import numpy.typing as npt

from ..jit import njit

TARGETS = ("colour", "range", "ids")
"""All targets, in the order of their attachments."""

STORES = ("uint8", "linear16")
"""How colour may be stored: 8 bit, or 16 bit for noise to be added first."""


class Targets:
    """A framebuffer of one size with some of colour, range and ids, and its read-back buffers."""

    def __init__(
        self,
        context: moderngl.Context,
        size: tuple[int, int],
        wanted: frozenset[str],
        store: str,
    ) -> None:
        width, height = size
        self.places = {name: i for i, name in enumerate(n for n in TARGETS if n in wanted)}
        """Which attachment each target is."""
        self._kinds: dict[str, str] = {
            "colour": "f1" if store == "uint8" else "nu2",
            "range": "f4",
            "ids": "u2",
        }
        self._textures = [
            context.texture(size, 4 if name == "colour" else 1, dtype=self._kinds[name])
            for name in self.places
        ]
        self._depth = context.depth_renderbuffer(size)
        self.framebuffer = context.framebuffer(self._textures, self._depth)
        self._store = store
        self._size = size
        self._scratch = np.empty((height, width, 4), np.uint8)

    def read(self, name: str) -> npt.NDArray[np.generic]:
        """The pixels of one target, row 0 at the top, as an array of their own."""
        width, height = self._size
        if name == "colour" and self._store == "uint8":
            # RGBA is read several times faster than RGB; the alpha goes in the packing.
            self._read_into(self._scratch, name)
            return without_alpha(self._scratch)
        shape = (height, width, 4) if name == "colour" else (height, width)
        pixels = np.empty(shape, np.float32 if name == "range" else np.uint16)
        self._read_into(pixels, name)
        return pixels

    def _read_into(self, pixels: npt.NDArray[np.generic], name: str) -> None:
        self.framebuffer.read_into(
            pixels,
            components=4 if name == "colour" else 1,
            attachment=self.places[name],
            alignment=1,
            dtype=self._kinds[name],
        )

    def release(self) -> None:
        """Give the graphics memory back."""
        self.framebuffer.release()
        self._depth.release()
        for texture in self._textures:
            texture.release()


@njit
def without_alpha(rgba: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """The first three of four channels, (h, w, 4) to (h, w, 3)."""
    height, width, _ = rgba.shape
    rgb = np.empty((height, width, 3), np.uint8)
    for row in range(height):
        for column in range(width):
            for channel in range(3):
                rgb[row, column, channel] = rgba[row, column, channel]
    return rgb
