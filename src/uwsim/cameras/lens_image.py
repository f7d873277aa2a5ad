"""Images through a lens, drawn as images of a wider pinhole and mapped pixel by pixel.

Colours are interpolated between the four nearest pixels (this blurs by up to half a pixel), planar
depths and segmentation IDs are those of the nearest pixel. The wider pinhole has the focal length
of the camera, and pixels that coincide where the lens does not distort.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics
from ..base.numerics.jit import njit
from ..errors import BadSetting

MAX_SIZE_RATIO = 8.0
"""The greatest number of pixels of the wider pinhole's image, over those of the camera's."""
MAX_WIDE_SIZE = 16384
"""The greatest width and height of the wider pinhole's image [px]."""
N_CHECKED = 65
"""The number of pixels in a row or column of the grid of `check_lens`."""
MARGIN = 2
"""The margin around the wider pinhole's image [px]."""

T = TypeVar("T", bound=np.generic)
AnyImage = npt.NDArray[Any]


@dataclass(frozen=True, eq=False)
class LensImage:
    """The map from an image of a wider pinhole to the image of a camera with a lens."""

    pinhole: Intrinsics
    """The wider pinhole."""
    places: npt.NDArray[np.float32]
    """The column and row of each pixel in its image, (h, w, 2) [px]."""
    length_ratios: npt.NDArray[np.float32]
    """The length of the ray of each pixel over that of the nearest pixel of the pinhole, (h, w)."""

    def interpolate(self, image: npt.NDArray[T]) -> npt.NDArray[T]:
        """Return the image of the camera, (h, w, channels), from that of the pinhole.

        Of light, floats, the three channels of colour are returned.
        """
        is_light = image.dtype == np.float32
        n_channels = 3 if is_light else image.shape[2]
        output = np.empty((*self.places.shape[:2], n_channels), image.dtype)
        interpolate = _interpolate_light if is_light else _interpolate_numbers
        interpolate(image, self.places, output)
        return output

    def pick(self, image: npt.NDArray[T]) -> npt.NDArray[T]:
        """Return the nearest pixel of the pinhole's image for each pixel, (h, w)."""
        output = np.empty(self.places.shape[:2], image.dtype)
        _pick(image, self.places, output)
        return output

    def pick_range(self, ranges: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Return the ranges along the rays of the camera, with the planar depth of the nearest."""
        camera_ranges: npt.NDArray[np.float32] = self.pick(ranges) * self.length_ratios
        return camera_ranges


@lru_cache(maxsize=16)
def map_lens(camera: Intrinsics) -> LensImage:
    """Return the map of a camera with a lens.

    Raises:
        BadSetting: a pixel has no direction in the water, or the wider image is too large.
    """
    rays = camera.rays()
    columns, rows, pinhole, (left, top) = _find_places(camera, rays[..., 0], -rays[..., 1])
    places = np.stack([columns - left, rows - top], axis=2).astype(np.float32)
    lengths = np.sqrt((rays * rays).sum(axis=2))
    pinhole_lengths: Array = np.empty(places.shape[:2])
    _pick(pinhole.ray_lengths, places, pinhole_lengths)
    return LensImage(pinhole, places, (lengths / pinhole_lengths).astype(np.float32))


def check_lens(camera: Intrinsics) -> None:
    """Check a camera with a lens by a grid of pixels that includes its border.

    Raises:
        BadSetting: a pixel has no direction in the water, or the wider image is too large.
    """
    assert camera.lens is not None
    u = np.linspace(0.0, camera.width - 1.0, N_CHECKED)
    v = np.linspace(0.0, camera.height - 1.0, N_CHECKED)
    columns, rows = np.meshgrid(u, v)
    y = (rows - camera.cy) / camera.fy
    x = (columns - camera.cx + camera.skew * y) / camera.fx
    _find_places(camera, *camera.lens.undistort(x, y))


def _find_places(
    camera: Intrinsics, x: Array, y: Array
) -> tuple[Array, Array, Intrinsics, tuple[int, int]]:
    """Find the places of directions, right and down, in the image of a wider pinhole.

    Returns:
        The columns and rows in the camera's image [px], the pinhole, and the column and row of the
        camera's image at which its first pixel is.
    """
    is_lost = ~(np.isfinite(x) & np.isfinite(y))
    if is_lost.any():
        raise BadSetting(
            f"The lens has no ray for {100.0 * is_lost.mean():.2g} % of the image: it folds the "
            "image, or light from the water does not get there. Expected less distortion, or a "
            "smaller field of view."
        )
    columns = camera.cx + camera.fx * x - camera.skew * y
    rows = camera.cy + camera.fy * y
    left, top = math.floor(columns.min()) - MARGIN, math.floor(rows.min()) - MARGIN
    width = math.ceil(columns.max()) + MARGIN + 1 - left
    height = math.ceil(rows.max()) + MARGIN + 1 - top
    is_large = width * height > MAX_SIZE_RATIO * camera.width * camera.height + 1e4
    if is_large or max(width, height) > MAX_WIDE_SIZE:
        raise BadSetting(
            f"The lens needs an image of {width} x {height} pixels for a camera of "
            f"{camera.width} x {camera.height}. Expected at most {MAX_SIZE_RATIO:g} times its "
            f"pixels, and {MAX_WIDE_SIZE} in a row or column."
        )
    pinhole = replace(
        camera, width=width, height=height, cx=camera.cx - left, cy=camera.cy - top, lens=None
    )
    return columns, rows, pinhole, (left, top)


@njit
def _interpolate_light(image: AnyImage, places: npt.NDArray[np.float32], output: AnyImage) -> None:
    height, width = output.shape[:2]
    flat_image = image.reshape(-1)
    stride = np.uint32(image.shape[1] * image.shape[2])
    n_stored = np.uint32(image.shape[2])
    unit = np.float32(1)
    for row in range(height):
        places_row, mapped_row = places[row].reshape(-1), output[row].reshape(-1)
        for column in range(np.uint32(width)):
            x, y = places_row[2 * column], places_row[2 * column + 1]
            i, j = np.uint32(y), np.uint32(x)
            v, u = y - np.float32(i), x - np.float32(j)
            upper_right, lower_right = (unit - v) * u, v * u
            upper_left, lower_left = (unit - v) - upper_right, v - lower_right
            upper = i * stride + j * n_stored
            lower = upper + stride
            for channel in range(np.uint32(3)):
                mapped_row[np.uint32(3) * column + channel] = (
                    upper_left * flat_image[upper + channel]
                    + upper_right * flat_image[upper + n_stored + channel]
                    + lower_left * flat_image[lower + channel]
                    + lower_right * flat_image[lower + n_stored + channel]
                )


@njit
def _interpolate_numbers(
    image: AnyImage, places: npt.NDArray[np.float32], output: AnyImage
) -> None:
    height, width, channels = output.shape
    unit = np.float32(1)
    for row in range(height):
        for column in range(width):
            x, y = places[row, column, 0], places[row, column, 1]
            i, j = np.int32(y), np.int32(x)
            v, u = y - np.float32(i), x - np.float32(j)
            for channel in range(channels):
                upper = (unit - u) * np.float32(image[i, j, channel])
                upper += u * np.float32(image[i, j + 1, channel])
                lower = (unit - u) * np.float32(image[i + 1, j, channel])
                lower += u * np.float32(image[i + 1, j + 1, channel])
                value = (unit - v) * upper + v * lower + np.float32(0.5)
                output[row, column, channel] = np.int32(value)


@njit
def _pick(image: AnyImage, places: npt.NDArray[np.float32], output: AnyImage) -> None:
    height, width = output.shape
    half = np.float32(0.5)
    for row in range(height):
        for column in range(width):
            i = np.int32(places[row, column, 1] + half)
            j = np.int32(places[row, column, 0] + half)
            output[row, column] = image[i, j]
