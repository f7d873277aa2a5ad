"""Rendered images through the lens of a camera."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...base.geometry import Intrinsics
from ...cameras.lens_image import LensImage
from ...rendering.rendered_image import RenderedImage


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
