"""The template of a tracker: the pixels of one image inside a quad, at one pyramid level.

The template consists of pixels of the image without interpolation, which would change their noise.
In each row of pixels, a convex quad contains one run of adjacent pixels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from .pyramid import Grey

Runs = npt.NDArray[np.int64]
"""The first and one-past-last column of the run of pixels in each row, (h, 2)."""


@dataclass(frozen=True, eq=False)
class Template:
    """The pixels inside a quad, normalised, with their derivatives.

    The array has h rows and w columns, those of the quad's bounding box. Normalised coordinates u
    and v are from -1 to 1 over this box.
    """

    left: int
    """The column of the image that is column 0 of the template."""
    top: int
    """The row of the image that is row 0 of the template."""
    runs: Runs
    """The first and one-past-last column inside the quad, for each row, (h, 2)."""
    values: Grey
    """The pixels, with zero mean and unit variance inside the quad, 0 outside, (h, w)."""
    slope_u: Grey
    """The derivative of ``values`` with respect to the normalised coordinate u, by central
    differences, (h, w)."""
    slope_v: Grey
    """The derivative of ``values`` with respect to the normalised coordinate v, by central
    differences, (h, w)."""
    mean: float
    """The mean of the pixels before the normalisation [grey level]."""
    contrast: float
    """The standard deviation of the pixels before the normalisation [grey level]."""
    image_from_normalised: Array
    """The homography from normalised coordinates to image points [px], (3, 3)."""

    @property
    def n(self) -> int:
        """The number of pixels inside the quad."""
        return int((self.runs[:, 1] - self.runs[:, 0]).sum())


def runs_in_quad(quad: Array, width: int, height: int) -> tuple[int, Runs]:
    """Return the first row of a convex quad (4, 2) [px], and the run of pixels in each row.

    A pixel is in the quad if its centre is in the quad. Pixels at the border of an image of
    ``width`` x ``height`` pixels are omitted, since they have no central difference.
    """
    top = max(int(np.ceil(quad[:, 1].min())), 1)
    bottom = min(int(np.floor(quad[:, 1].max())), height - 2)
    runs = np.zeros((max(bottom - top + 1, 0), 2), dtype=np.int64)
    for row in range(runs.shape[0]):
        v = top + row
        crossings = []
        for (u0, v0), (u1, v1) in zip(quad, np.roll(quad, -1, axis=0), strict=True):
            if min(v0, v1) <= v <= max(v0, v1) and v0 != v1:
                crossings.append(u0 + (u1 - u0) * (v - v0) / (v1 - v0))
        if crossings:
            start = max(int(np.ceil(min(crossings))), 1)
            runs[row] = start, max(min(int(np.floor(max(crossings))), width - 2) + 1, start)
    return top, runs


def extract_template(image: Grey, quad: Array) -> Template | None:
    """Extract the pixels of ``image`` inside the convex ``quad`` (4, 2) [px].

    Returns None if the quad has fewer than 8 rows or columns of pixels, or no contrast.
    """
    top, runs = runs_in_quad(quad, image.shape[1], image.shape[0])
    has_pixels = runs[:, 1] > runs[:, 0]
    if np.count_nonzero(has_pixels) < 8:
        return None
    first_row = int(np.argmax(has_pixels))
    runs = runs[first_row : len(has_pixels) - int(np.argmax(has_pixels[::-1]))]
    top += first_row
    left, right = int(runs[:, 0].min()), int(runs[:, 1].max())
    if right - left < 8:
        return None
    runs = runs - left
    height, width = runs.shape[0], right - left

    box = image[top - 1 : top + height + 1, left - 1 : right + 1].astype(np.float64)
    is_inside = (np.arange(width) >= runs[:, :1]) & (np.arange(width) < runs[:, 1:])
    pixels = box[1:-1, 1:-1]
    mean, contrast = float(pixels[is_inside].mean()), float(pixels[is_inside].std())
    if contrast < 1e-3:
        return None
    matrix = np.array(
        [
            [width / 2.0, 0.0, left + (width - 1) / 2.0],
            [0.0, height / 2.0, top + (height - 1) / 2.0],
            [0.0, 0.0, 1.0],
        ]
    )
    slope_u = (box[1:-1, 2:] - box[1:-1, :-2]) / 2.0 / contrast * matrix[0, 0]
    slope_v = (box[2:, 1:-1] - box[:-2, 1:-1]) / 2.0 / contrast * matrix[1, 1]
    return Template(
        left=left,
        top=top,
        runs=runs,
        values=((pixels - mean) / contrast * is_inside).astype(np.float32),
        slope_u=(slope_u * is_inside).astype(np.float32),
        slope_v=(slope_v * is_inside).astype(np.float32),
        mean=mean,
        contrast=contrast,
        image_from_normalised=matrix,
    )
