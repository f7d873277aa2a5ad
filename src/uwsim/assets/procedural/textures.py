"""Procedural textures from named random streams: the same bytes in every run."""

from __future__ import annotations

from functools import cache, lru_cache

import cv2
import numpy as np
import numpy.typing as npt

from ...base import rng
from ..mesh import Texture

Grey = npt.NDArray[np.float32]
"""(h, w), about 0..1."""
Pixels = npt.NDArray[np.float32]
"""(h, w, 3), 0..1, red green blue, row 0 at the top."""
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
    """Smooth noise, about zero mean and unit deviation.

    The sum of random grids, each finer and weaker than the one before.

    Args:
        name: Names the chance it is drawn from.
        height: Rows.
        width: Columns.
        cells: Cells of the coarsest grid along the shorter side.
        octaves: How many grids, each with cells half as large as the one before.
        gain: Weight of each grid relative to the one before.
        tiles: Whether opposite sides fit together.
    """
    draw = rng.stream(0, f"assets/{name}")
    short = min(height, width)
    rows, columns = round(cells * height / short), round(cells * width / short)
    total = draw.standard_normal((rows, columns), dtype=np.float32)
    weight = 1.0
    for _ in range(octaves - 1):
        if 2 * rows > height or 2 * columns > width:
            break
        rows, columns, weight = 2 * rows, 2 * columns, weight * gain
        total = _stretched(total, rows, columns, tiles)
        total += np.float32(weight) * draw.standard_normal((rows, columns), dtype=np.float32)
    total -= total.mean()
    total /= total.std()
    return _stretched(total, height, width, tiles)


def _stretched(grid: Grey, height: int, width: int, tiles: bool) -> Grey:
    """A grid at a higher resolution, bicubic; across the borders too when it tiles."""
    rows, columns = grid.shape
    if (rows, columns) == (height, width):
        return grid
    if not tiles:
        whole = cv2.resize(grid, (width, height), interpolation=cv2.INTER_CUBIC)
        return np.asarray(whole, dtype=np.float32)
    wrapped = cv2.copyMakeBorder(grid, 2, 2, 2, 2, cv2.BORDER_WRAP)
    tall, wide = round(height * (rows + 4) / rows), round(width * (columns + 4) / columns)
    big = cv2.resize(wrapped, (wide, tall), interpolation=cv2.INTER_CUBIC)
    top, left = (tall - height) // 2, (wide - width) // 2
    return np.ascontiguousarray(big[top : top + height, left : left + width])


def plain(height: int, width: int, colour: Colour) -> Pixels:
    """An image of one colour."""
    return np.broadcast_to(np.array(colour, dtype=np.float32), (height, width, 3)).copy()


def mixed(first: Pixels | Colour, second: Pixels | Colour, amount: Grey) -> Pixels:
    """``first`` where ``amount`` is 0, ``second`` where it is 1."""
    a, b = np.asarray(first, dtype=np.float32), np.asarray(second, dtype=np.float32)
    blend: Pixels = a + (b - a) * amount[:, :, None]
    return blend


def step(low: float, high: float, value: Grey) -> Grey:
    """0 below ``low``, 1 above ``high``, smooth between."""
    t = np.clip((value - np.float32(low)) / np.float32(high - low), 0.0, 1.0)
    smooth: Grey = t * t * (3.0 - 2.0 * t)
    return smooth


def lit(height_map: Grey, strength: float, *, tiles: bool = False) -> Grey:
    """Shading of a relief, about 1: brighter on the slopes that face the top left."""
    border = cv2.BORDER_WRAP if tiles else cv2.BORDER_REFLECT
    padded = cv2.copyMakeBorder(height_map, 1, 1, 1, 1, border)
    slope = padded[2:, 2:] - padded[:-2, :-2]
    slope *= np.float32(strength)
    slope += np.float32(1.0)
    shade: Grey = np.clip(slope, 0.35, 1.7, out=slope)
    return shade


def finished(name: str, image: Pixels, *, repeats: bool = True) -> Texture:
    """The image as a texture, clipped to 0..1 and rounded to 8 bit."""
    pixels = cv2.convertScaleAbs(np.clip(image, 0.0, 1.0), alpha=255.0)
    return Texture(name=name, pixels=np.ascontiguousarray(pixels, dtype=np.uint8), repeats=repeats)


@lru_cache(maxsize=64)
def lettering(text: str, size: int) -> Grey:
    """Words as an image, 1 where there is ink, cropped to the ink; no system font is needed."""
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


def write(
    image: Pixels,
    text: str,
    centre: tuple[float, float],
    *,
    width: float | None = None,
    height: float | None = None,
    colour: Colour = (0.0, 0.0, 0.0),
    quarter_turns: int = 0,
) -> None:
    """Paint words onto an image; places and sizes are fractions of its width and height.

    One of ``width`` and ``height`` of the (turned) words must be given; both stretch them.
    """
    ink = np.rot90(lettering(text, 96), quarter_turns)
    h, w = image.shape[:2]
    if width is not None and height is not None:
        size = (round(width * w), round(height * h))
    elif width is not None:
        size = (round(width * w), round(width * w * ink.shape[0] / ink.shape[1]))
    else:
        tall = (height or 0.1) * h
        size = (round(tall * ink.shape[1] / ink.shape[0]), round(tall))
    small = cv2.resize(np.ascontiguousarray(ink), size, interpolation=cv2.INTER_AREA)
    left, top = round(centre[0] * w - size[0] / 2), round(centre[1] * h - size[1] / 2)
    rows = slice(max(top, 0), min(top + size[1], h))
    columns = slice(max(left, 0), min(left + size[0], w))
    part = small[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left]
    patch = image[rows, columns]
    image[rows, columns] = mixed(patch, colour, part.astype(np.float32))


@cache
def worn(name: str, colour: Colour, *, size: int = 256, grain: float = 0.06) -> Texture:
    """Paint or metal that has been used: cloudy, with fine scratches."""
    clouds = noise(f"{name}/clouds", size, size, cells=3, octaves=6)
    image = plain(size, size, colour) * (1.0 + np.float32(grain) * clouds)[:, :, None]
    streak = cv2.GaussianBlur(
        noise(f"{name}/streaks", size, size, cells=size // 2, octaves=1), (25, 1), 0
    )
    image *= (1.0 + np.float32(grain * 1.2) * streak / streak.std())[:, :, None]
    return finished(name, image)


@cache
def concrete(name: str, colour: Colour, *, size: int = 512, joints: int = 0) -> Texture:
    """Cement, with stains and pores; ``joints`` tiles along each side when not 0."""
    clouds = noise(f"{name}/clouds", size, size, cells=2, octaves=7, gain=0.62)
    pores = noise(f"{name}/pores", size, size, cells=size // 4, octaves=2)
    image = plain(size, size, colour) * (1.0 + 0.07 * clouds)[:, :, None]
    image *= (1.0 - 0.30 * step(1.9, 2.6, pores) + 0.02 * pores)[:, :, None]
    if joints:
        draw = rng.stream(0, f"assets/{name}/tiles")
        shade = draw.normal(1.0, 0.035, (joints, joints)).astype(np.float32)
        image *= cv2.resize(shade, (size, size), interpolation=cv2.INTER_NEAREST)[:, :, None]
        edge = (np.arange(size) * joints / size) % 1.0
        near = np.minimum(edge, 1.0 - edge) * size / joints  # pixels to the nearest joint
        gap = np.minimum(near[:, None], near[None, :]).astype(np.float32)
        image *= (1.0 - 0.45 * (1.0 - step(0.8, 2.4, gap)))[:, :, None]
    return finished(name, image)
