"""Images of cameras from rendered images: noise or response, and the lens."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics, Pose
from ...cameras.digital_numbers import light_table
from ...cameras.exposure import Displacement, Exposure, PlainExposure, take_image
from ...cameras.lens_image import LensImage
from ...cameras.response import Pixels
from ...rendering.grey import grey_truncated
from ...rendering.noise import add_noise
from ...rendering.physical.physical_water import PhysicalWater
from ...rendering.rendered_image import RenderedImage


class DrawColours(Protocol):
    """A function that draws the colours of a camera, (h, w, channels), in a format."""

    def __call__(
        self, pose: Pose, colour_format: str, displacement: Displacement | None = None, /
    ) -> npt.NDArray[np.generic]:
        """Draw the colours at a pose of the camera, while a vehicle is displaced."""


def take_pixels(
    exposure: Exposure | PlainExposure,
    draw: DrawColours,
    draw_depth: Callable[[Pose, Intrinsics], Array],
    water: PhysicalWater | None,
) -> Pixels:
    """Take an image with the noise or the response of a camera, (h, w, 3), or (h, w) if grey.

    Colours of the fog law are light by the sRGB curve.

    Args:
        exposure: the image.
        draw: draws colours.
        draw_depth: draws planar depths (h, w) [m] of a pinhole.
        water: the physical water; None: the fog law.
    """
    if isinstance(exposure, PlainExposure):
        colours = draw(exposure.world_from_camera, "linear16" if exposure.std > 0.0 else "uint8")
        if colours.dtype == np.uint16:
            pixels = add_noise(colours.view(np.uint16), exposure.std, exposure.rng)
        else:
            pixels = colours.view(np.uint8)
        return grey_truncated(pixels) if exposure.is_grey else pixels

    def draw_light(pose: Pose, displacement: Displacement | None) -> npt.NDArray[np.float32]:
        colours = draw(pose, "linear16" if water is None else "light", displacement)
        light = light_table()[colours.view(np.uint16)] if water is None else colours
        return light.view(np.float32)

    return take_image(exposure, draw_light, draw_depth, 1.0 if water is None else water.exposure)


def map_image(image: RenderedImage, camera: Intrinsics, lens_image: LensImage) -> RenderedImage:
    """Return the image of a camera with a lens from that of its wider pinhole."""
    colour, ranges, ids = image.colour, image.range, image.ids
    if colour is not None:
        if colour.dtype == np.float32:
            colour = lens_image.interpolate(colour.view(np.float32))
        elif colour.dtype == np.uint16:
            colour = lens_image.interpolate(colour.view(np.uint16))
        else:
            colour = lens_image.interpolate(colour.view(np.uint8))
    return replace(
        image,
        intrinsics=camera,
        colour=colour,
        range=None if ranges is None else lens_image.pick_range(ranges),
        ids=None if ids is None else lens_image.pick(ids),
    )
