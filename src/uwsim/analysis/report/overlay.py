"""The overlay of true and estimated corners on a camera's image.

As in `uwsim.base.geometry.Intrinsics`, image coordinates count from the centre of the top left
pixel. The truth is green and solid, the estimate orange and dashed, so that both can be
distinguished in print and by colour-blind readers. Lines have a dark rim.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

Quad = Sequence[float]

TRUTH_COLOUR, ESTIMATE_COLOUR, RIM = (0, 200, 140), (255, 140, 0), (10, 20, 30)


def overlay(
    image: npt.NDArray[np.uint8],
    *,
    truth: Quad | None = None,
    estimate: Quad | None = None,
    label: str = "",
    scale: int = 2,
) -> npt.NDArray[np.uint8]:
    """Draw quadrangles and a label on an image, enlarged so that half pixels are visible.

    Args:
        image: the image, (h, w, 3) RGB or (h, w) grey.
        truth: the true corners x, y, x, y, ... [px]; None for none.
        estimate: the estimated corners, in the same order [px]; None for none.
        label: the text in the top left corner, such as ``fog 0.5 1/m``.
        scale: the factor by which the drawing is larger [1]; pixels are repeated, not blurred.

    Returns:
        The drawing, (h * scale, w * scale, 3).
    """
    grey_or_colour = Image.fromarray(image).convert("RGB")
    size = (grey_or_colour.width * scale, grey_or_colour.height * scale)
    drawing = grey_or_colour.resize(size, Image.Resampling.NEAREST)
    pen = ImageDraw.Draw(drawing)
    if truth is not None:
        _draw_outline(pen, _drawing_points(truth, scale), TRUTH_COLOUR, scale, is_dashed=False)
    if estimate is not None:
        _draw_outline(pen, _drawing_points(estimate, scale), ESTIMATE_COLOUR, scale, is_dashed=True)
    if label:
        _write_label(pen, label, scale)
    pixels: npt.NDArray[np.uint8] = np.asarray(drawing).copy()
    return pixels


def _drawing_points(quad: Quad, scale: int) -> list[tuple[float, float]]:
    """Return the corners in pixels of the drawing; the centre of PIL's first pixel is 0."""
    if len(quad) != 8:
        raise ValueError(f"expected 8 numbers of a quadrangle, not {len(quad)}")
    coordinates = [(value + 0.5) * scale - 0.5 for value in quad]
    return list(zip(coordinates[0::2], coordinates[1::2], strict=True))


def _draw_outline(
    pen: ImageDraw.ImageDraw,
    points: list[tuple[float, float]],
    colour: tuple[int, int, int],
    scale: int,
    *,
    is_dashed: bool,
) -> None:
    width = max(2, round(1.5 * scale))
    for begin, end in zip(points, points[1:] + points[:1], strict=True):
        for a, b in _dashes(begin, end, 6.0 * scale if is_dashed else math.inf):
            pen.line([a, b], fill=RIM, width=width + 2)
            pen.line([a, b], fill=colour, width=width)


def _dashes(
    begin: tuple[float, float], end: tuple[float, float], dash: float
) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    """Yield the dashes of a line, with gaps of half their length; at most 1000."""
    length = math.dist(begin, end)
    if length <= dash:
        yield begin, end
        return
    dash = max(dash, length / 1000)
    for k in range(math.ceil(length / (1.5 * dash))):
        cuts = (k * 1.5 * dash / length, min(1.0, (k * 1.5 + 1.0) * dash / length))
        a, b = (tuple(p + t * (q - p) for p, q in zip(begin, end, strict=True)) for t in cuts)
        yield (a[0], a[1]), (b[0], b[1])


def _write_label(pen: ImageDraw.ImageDraw, label: str, scale: int) -> None:
    font = ImageFont.load_default(size=8 * scale)
    corner, white = (3 * scale, 2 * scale), (255, 255, 255)
    pen.text(corner, label, font=font, fill=white, stroke_width=scale, stroke_fill=RIM)
