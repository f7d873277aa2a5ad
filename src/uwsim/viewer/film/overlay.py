"""Text and drawings over the images of a film: titles, curves, insets, quadrangles."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from ...base.geometry import Array

Pixels = npt.NDArray[np.uint8]
"""An image: red, green and blue, (h, w, 3), or with opacity, (h, w, 4)."""
INK = (240, 244, 248)
"""The colour of text and cursors."""
GREY = (170, 182, 194)
"""The colour of less important text."""
PANEL = (12, 20, 30)
"""The colour of the background behind text and curves."""

TRUTH = (70, 220, 120)
"""The colour of the true quadrangle in a camera's image."""
ESTIMATE = (255, 190, 40)
"""The colour of the estimated quadrangle in a camera's image."""
STATUS = {"ok": (110, 220, 140)}
"""The colour of a level's status, by status; `FAILURE` for all others."""
FAILURE = (255, 120, 100)
"""The colour of the status of a failed level."""
COLOURS = (
    *((90, 190, 255), (255, 180, 80), (150, 230, 120), (240, 130, 200)),
    *((190, 160, 255), (255, 235, 120)),
)
"""The colours of the first, second, ... curve."""


@functools.cache
def font(size: int) -> ImageFont.ImageFont | ImageFont.FreeTypeFont:
    """Return the default font of Pillow at a size [px]."""
    return ImageFont.load_default(size)


@functools.lru_cache(maxsize=512)
def lettering(text: str, size: int, colour: tuple[int, int, int]) -> tuple[Pixels, Array]:
    """Return a line of text as an image, (h, w, 3), and its opacity, (h, w, 1), 0..1."""
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
    """Write a line of text into a frame; return the width of the text [px].

    Text beyond the right or lower edge of the frame is cut off.

    Args:
        frame: the image, (h, w, 3).
        text: the text.
        corner: the column and row of the upper left corner of the text [px].
        size: the height of the letters [px].
        colour: the red, green and blue value.
        right: True if ``corner`` is the upper right corner.
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
    """Copy an image, with a border, into a frame at column x and row y [px]."""
    height, width = image.shape[:2]
    frame[max(0, y - 1) : y + height + 1, max(0, x - 1) : x + width + 1] = GREY
    frame[y : y + height, x : x + width] = image


def draw_quadrangle(image: Pixels, corners: Array, colour: tuple[int, int, int]) -> Pixels:
    """Return an image with a quadrangle, whose corners are (4, 2) [px]; they are clipped."""
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
        curves: for each line its points, (n, 2) [px], with NaN at gaps, and its colour.
    """
    canvas = Image.new("RGBA", (2 * size[0], 2 * size[1]))
    pen = ImageDraw.Draw(canvas)
    for points, colour in curves:
        for piece in line_pieces(points):
            pen.line([(2 * x, 2 * y) for x, y in piece.tolist()], fill=colour, width=3)
    return np.asarray(canvas.resize(size, Image.Resampling.BOX)).copy()


def line_pieces(points: Array) -> list[Array]:
    """Return the pieces of a line, (n, 2), between NaN; each has two or more points."""
    gaps = np.flatnonzero(~np.isfinite(points).all(axis=1))
    parts = np.split(points, gaps)
    pieces = [piece[np.isfinite(piece).all(axis=1)] for piece in parts]
    return [piece for piece in pieces if len(piece) > 1]


def blend(frame: Pixels, drawing: Pixels, x: int, y: int) -> None:
    """Blend a drawing, (h, w, 4), with premultiplied colours over a frame at (x, y) [px]."""
    height, width = drawing.shape[:2]
    region = frame[y : y + height, x : x + width]
    background = (255 - drawing[..., 3:].astype(np.uint16)) * region
    region[:] = np.minimum(drawing[..., :3] + (background + 127) // 255, 255).astype(np.uint8)
