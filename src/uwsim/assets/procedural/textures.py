"""Procedural textures from named random streams: the same bytes in every run."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
import numpy.typing as npt

from ...base import rng
from ..images import PixelImage
from ..mesh import Texture

Grey = npt.NDArray[np.float32]
"""A grey image, (h, w), about 0..1."""
Pixels = npt.NDArray[np.float32]
"""A colour image, (h, w, 3), 0..1, red green blue, row 0 at the top."""
Colour = tuple[float, float, float]


def noise(
    name: str,
    height: int,
    width: int,
    *,
    cells: int = 4,
    octaves: int = 5,
    gain: float = 0.55,
    tiles: bool = True,
) -> Grey:
    """Return smooth noise, about zero mean and unit deviation.

    The sum of random grids, each finer and weaker than the one before.

    Args:
        name: The name of the random stream.
        height: The number of rows.
        width: The number of columns.
        cells: The number of cells of the coarsest grid along the shorter side.
        octaves: The number of grids, each with cells half as large as the one before.
        gain: The weight of each grid relative to the one before.
        tiles: True if opposite sides fit together.
    """
    stream = rng.stream(0, f"assets/{name}")
    short_side = min(height, width)
    rows, columns = round(cells * height / short_side), round(cells * width / short_side)
    total = stream.standard_normal((rows, columns), dtype=np.float32)
    weight = 1.0
    for _ in range(octaves - 1):
        if 2 * rows > height or 2 * columns > width:
            break
        rows, columns, weight = 2 * rows, 2 * columns, weight * gain
        total = _resize(total, rows, columns, tiles)
        total += np.float32(weight) * stream.standard_normal((rows, columns), dtype=np.float32)
    total -= total.mean()
    total /= total.std()
    return _resize(total, height, width, tiles)


def _resize(grid: Grey, height: int, width: int, tiles: bool) -> Grey:
    """Resize a grid to a higher resolution, bicubic; across the borders too when it tiles."""
    rows, columns = grid.shape
    if (rows, columns) == (height, width):
        return grid
    if not tiles:
        image = cv2.resize(grid, (width, height), interpolation=cv2.INTER_CUBIC)
        return np.asarray(image, dtype=np.float32)
    wrapped_grid = cv2.copyMakeBorder(grid, 2, 2, 2, 2, cv2.BORDER_WRAP)
    full_height, full_width = (
        round(height * (rows + 4) / rows),
        round(width * (columns + 4) / columns),
    )
    full_image = cv2.resize(wrapped_grid, (full_width, full_height), interpolation=cv2.INTER_CUBIC)
    top, left = (full_height - height) // 2, (full_width - width) // 2
    return np.ascontiguousarray(full_image[top : top + height, left : left + width])


def fill(height: int, width: int, colour: Colour) -> Pixels:
    """Return an image of one colour."""
    return np.broadcast_to(np.array(colour, dtype=np.float32), (height, width, 3)).copy()


def mix(start: Pixels | Colour, end: Pixels | Colour, amount: Grey) -> Pixels:
    """Mix two images: ``start`` where ``amount`` is 0, ``end`` where it is 1."""
    a, b = np.asarray(start, dtype=np.float32), np.asarray(end, dtype=np.float32)
    blend: Pixels = a + (b - a) * amount[:, :, None]
    return blend


def to_texture(name: str, image: Pixels, *, repeats: bool = True) -> Texture:
    """Convert an image to a texture, clipped to 0..1 and rounded to 8 bit."""
    pixels = cv2.convertScaleAbs(np.clip(image, 0.0, 1.0), alpha=255.0)
    image_pixels = np.ascontiguousarray(pixels, dtype=np.uint8)
    return Texture(name=name, image=PixelImage(image_pixels), repeats=repeats)


@lru_cache(maxsize=64)
def lettering(text: str, size: int) -> Grey:
    """Return a text as an image, 1 where there is ink, cropped; no system font is needed."""
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.load_default(size=size)
    box = ImageDraw.Draw(Image.new("L", (1, 1))).textbbox((0, 0), text, font=font, stroke_width=1)
    width, height = int(box[2] - box[0]) + 2, int(box[3] - box[1]) + 2
    canvas = Image.new("L", (width, height), 0)
    ImageDraw.Draw(canvas).text(
        (1 - box[0], 1 - box[1]), text, fill=255, font=font, stroke_width=max(1, size // 28)
    )
    ink: Grey = np.asarray(canvas, dtype=np.float32) / 255.0
    return ink


def paint_text(
    image: Pixels,
    text: str,
    centre: tuple[float, float],
    *,
    width: float | None = None,
    height: float | None = None,
    colour: Colour = (0.0, 0.0, 0.0),
    quarter_turns: int = 0,
) -> None:
    """Paint a text onto an image; positions and sizes are fractions of the image's size.

    One of ``width`` and ``height`` of the (rotated) text is required; both together stretch it.
    """
    ink = np.rot90(lettering(text, 96), quarter_turns)
    h, w = image.shape[:2]
    if width is not None and height is not None:
        size = (round(width * w), round(height * h))
    elif width is not None:
        size = (round(width * w), round(width * w * ink.shape[0] / ink.shape[1]))
    else:
        text_height = (height or 0.1) * h
        size = (round(text_height * ink.shape[1] / ink.shape[0]), round(text_height))
    text_image = cv2.resize(np.ascontiguousarray(ink), size, interpolation=cv2.INTER_AREA)
    left, top = round(centre[0] * w - size[0] / 2), round(centre[1] * h - size[1] / 2)
    rows = slice(max(top, 0), min(top + size[1], h))
    columns = slice(max(left, 0), min(left + size[0], w))
    part = text_image[
        rows.start - top : rows.stop - top, columns.start - left : columns.stop - left
    ]
    patch = image[rows, columns]
    image[rows, columns] = mix(patch, colour, part.astype(np.float32))
