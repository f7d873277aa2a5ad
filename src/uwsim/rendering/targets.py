"""Framebuffers with the requested render targets: colour, range and ids."""

from __future__ import annotations

from typing import TypeVar

import moderngl
import numpy as np
import numpy.typing as npt

from ..base.geometry import Intrinsics
from ..base.numerics.jit import njit
from .backdrop import Colours, fill
from .rendered_image import RenderedImage

TARGETS = ("colour", "range", "ids")
"""All targets, in the order of their attachments."""

LIGHT = "light"
"""The format of light through physical water before the exposure: floats, 1 is the radiance of a
white surface in the irradiance 1."""

COLOUR_FORMATS = ("uint8", "linear16", LIGHT)
"""The formats of colour: 8 bit, 16 bit if noise is added before conversion to 8 bit, or light."""

RADIANCE = "radiance"
"""The format of surfaces without water: radiance and range as floats, which are not read back."""

_COLOUR_TYPES = {"uint8": "f1", "linear16": "nu2", LIGHT: "f4", RADIANCE: "f4"}

T = TypeVar("T", bound=np.generic)


def check_targets(names: frozenset[str], colour: str, *, has_physical_water: bool) -> None:
    """Raise ValueError if no image has these targets or colours of this format."""
    if not names or not names <= set(TARGETS) or colour not in COLOUR_FORMATS:
        raise ValueError(f"cannot draw {sorted(names)} as {colour!r}: {TARGETS}, {COLOUR_FORMATS}")
    if colour == LIGHT and not has_physical_water:
        raise ValueError("the fog law has colours, not light; expected physical water")


class Targets:
    """A framebuffer with the requested targets.

    Args:
        context: the context of the renderer.
        size: the width and height [px].
        targets: some of `TARGETS`.
        colour_format: one of `COLOUR_FORMATS`, or `RADIANCE`.
    """

    def __init__(
        self,
        context: moderngl.Context,
        size: tuple[int, int],
        targets: frozenset[str],
        colour_format: str,
    ) -> None:
        names = [name for name in TARGETS if name in targets]
        self.attachments = {name: i for i, name in enumerate(names)}
        """The number of each target's attachment."""
        self._formats = {
            "colour": _COLOUR_TYPES[colour_format],
            "range": "f4",
            "ids": "u2",
        }
        self.framebuffer: moderngl.Framebuffer = context.framebuffer(
            [
                context.texture(size, 4 if name == "colour" else 1, dtype=self._formats[name])
                for name in names
            ],
            context.depth_renderbuffer(size),
        )
        """The framebuffer in which the image is drawn."""
        self._shape = size[1], size[0]
        self._is_read = colour_format != RADIANCE

    @property
    def radiance(self) -> moderngl.Texture:
        """The texture of the colours, for further passes."""
        texture = self.framebuffer.color_attachments[self.attachments["colour"]]
        assert isinstance(texture, moderngl.Texture)
        return texture

    def write_colour_only(self) -> None:
        """Bind the framebuffer, and write no range and ids until `write_all`."""
        self.framebuffer.use()
        self._set_masks(["colour"])

    def write_all(self) -> None:
        """Write all targets again."""
        self._set_masks(list(self.attachments))

    def _set_masks(self, names: list[str]) -> None:
        masks = [(name in names,) * 4 for name in self.attachments]
        if len(masks) == 1:
            self.framebuffer.color_mask = masks[0]
        else:
            self.framebuffer.color_mask = masks  # type: ignore[assignment]  # one for each target

    def read_image(
        self, intrinsics: Intrinsics, background: Colours | None = None
    ) -> RenderedImage:
        """Read all targets back into new arrays.

        Args:
            intrinsics: the pinhole of the camera.
            background: the colours of pixels in which nothing was drawn.
        """
        colour: Colours | None = None
        if "colour" in self.attachments and self._is_read:
            colour = self.read_colours()
            if background is not None:
                fill(colour, background)
            if colour.dtype == np.uint8:
                colour = drop_alpha(colour.view(np.uint8))
        range = ids = None
        if "range" in self.attachments:
            range = self._read("range", np.empty(self._shape, np.float32))
        if "ids" in self.attachments:
            ids = self._read("ids", np.empty(self._shape, np.uint16))
        return RenderedImage(intrinsics=intrinsics, colour=colour, range=range, ids=ids)

    def read_colours(self) -> Colours:
        """Read the colours back, (h, w, 4); with alpha this is several times faster."""
        if self._formats["colour"] == "f1":
            return self._read("colour", np.empty((*self._shape, 4), np.uint8))
        if self._formats["colour"] == "f4":
            return self._read("colour", np.empty((*self._shape, 4), np.float32))
        return self._read("colour", np.empty((*self._shape, 4), np.uint16))

    def read_depths(self) -> npt.NDArray[np.float32]:
        """Read the depth buffer back, (h, w), 0 at the near plane to 1 at the far plane."""
        pixels = np.empty(self._shape, np.float32)
        self.framebuffer.read_into(pixels, components=1, attachment=-1, alignment=1, dtype="f4")
        return pixels

    def _read(self, name: str, pixels: npt.NDArray[T]) -> npt.NDArray[T]:
        self.framebuffer.read_into(
            pixels,
            components=4 if name == "colour" else 1,
            attachment=self.attachments[name],
            alignment=1,
            dtype=self._formats[name],
        )
        return pixels


@njit
def drop_alpha(rgba: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return a copy without the alpha channel, (h, w, 4) to (h, w, 3)."""
    height, width, _ = rgba.shape
    rgb = np.empty((height, width, 3), np.uint8)
    for row in range(height):
        for column in range(width):
            for channel in range(3):
                rgb[row, column, channel] = rgba[row, column, channel]
    return rgb
