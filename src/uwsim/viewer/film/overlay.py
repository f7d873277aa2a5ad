"""Text and drawings over a film: title, level, clock, curves, and a camera's image."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from ...base.geometry import Array

Pixels = npt.NDArray[np.uint8]
INK = (240, 244, 248)
GREY = (170, 182, 194)
PANEL = (12, 20, 30)

TRUTH = (70, 220, 120)
ESTIMATE = (255, 190, 40)
STATUS = {"ok": (110, 220, 140)}
FAILURE = (255, 120, 100)
COLOURS = (
    *((90, 190, 255), (255, 180, 80), (150, 230, 120), (240, 130, 200)),
    *((190, 160, 255), (255, 235, 120)),
)
"""The colours of curves, in their order."""


@functools.cache
def font(size: int) -> ImageFont.ImageFont | ImageFont.FreeTypeFont:
    """Return Pillow's own font, at a size [px]."""
    return ImageFont.load_default(size)


@functools.lru_cache(maxsize=512)
def lettering(text: str, size: int, colour: tuple[int, int, int]) -> tuple[Pixels, Array]:
    """Return a line of text as colours (h, w, 3) and opacity (h, w, 1), 0..1."""
    left, _, right, bottom = font(size).getbbox(text)
    height = round(1.35 * size)
    mask = Image.new("L", (max(1, round(right - left)), max(height, round(bottom))))
    ImageDraw.Draw(mask).text((-left, 0), text, fill=255, font=font(size))
    opacity = np.asarray(mask, dtype=np.float64)[..., None] / 255.0
    return np.broadcast_to(np.array(colour, np.uint8), (*mask.size[::-1], 3)), opacity


def write_text(
    frame: Pixels,
    text: str,
    corner: tuple[int, int],
    size: int,
    colour: tuple[int, int, int] = INK,
    *,
    right: bool = False,
) -> int:
    """Write a line of text from its upper left or right corner; return its width.

    The text is cut off at the edge of the frame.
    """
    if not text:
        return 0
    letters, opacity = lettering(text, size, colour)
    x, y = corner[0] - (letters.shape[1] if right else 0), corner[1]
    x = max(0, x)
    region = frame[y : y + letters.shape[0], x : x + letters.shape[1]]
    letters, opacity = letters[: len(region), : region.shape[1]], opacity[: len(region)]
    opacity = opacity[:, : region.shape[1]]
    region[:] = (region * (1.0 - opacity) + letters * opacity + 0.5).astype(np.uint8)
    return int(letters.shape[1])


def paste(frame: Pixels, image: Pixels, x: int, y: int) -> None:
    """Copy an image into a frame, with a thin edge."""
    height, width = image.shape[:2]
    frame[max(0, y - 1) : y + height + 1, max(0, x - 1) : x + width + 1] = GREY
    frame[y : y + height, x : x + width] = image


def draw_quadrangle(image: Pixels, corners: Array, colour: tuple[int, int, int]) -> Pixels:
    """Draw the outline of four corners (4, 2) [px] into an image; clip far coordinates."""
    picture = Image.fromarray(image)
    points = [(float(u), float(v)) for u, v in np.clip(corners, -4096, 4096)]
    ImageDraw.Draw(picture).line([*points, points[0]], fill=colour, width=2)
    return np.asarray(picture).copy()


def draw_lines(
    size: tuple[int, int], curves: Sequence[tuple[Array, tuple[int, int, int]]]
) -> Pixels:
    """Draw smooth lines on a transparent image: colours and opacity, (h, w, 4).

    Args:
        size: the width and height [px].
        curves: the points (n, 2) [px] of each, with NaN at interruptions, and its colour.
    """
    canvas = Image.new("RGBA", (2 * size[0], 2 * size[1]))
    pen = ImageDraw.Draw(canvas)
    for points, colour in curves:
        for piece in line_pieces(points):
            pen.line([(2 * x, 2 * y) for x, y in piece.tolist()], fill=colour, width=3)
    return np.asarray(canvas.resize(size, Image.Resampling.BOX)).copy()


def line_pieces(points: Array) -> list[Array]:
    """Return the pieces of a line (n, 2) between NaN, of two or more points."""
    gaps = np.flatnonzero(~np.isfinite(points).all(axis=1))
    parts = np.split(points, gaps)
    pieces = [piece[np.isfinite(piece).all(axis=1)] for piece in parts]
    return [piece for piece in pieces if len(piece) > 1]


def blend(frame: Pixels, drawing: Pixels, x: int, y: int) -> None:
    """Blend a drawing (h, w, 4) with premultiplied colours over a frame."""
    height, width = drawing.shape[:2]
    region = frame[y : y + height, x : x + width]
    ground = (255 - drawing[..., 3:].astype(np.uint16)) * region
    region[:] = np.minimum(drawing[..., :3] + (ground + 127) // 255, 255).astype(np.uint8)
