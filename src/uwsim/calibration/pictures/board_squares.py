"""The squares of checkers on a board: where they are, and how bright."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import BadSetting
from ...optics.phase_function import FloatArray
from ..checker import INNER_SHARE
from .led_discs import Sum
from .linear_picture import LinearPicture

MIN_PIXELS = 4
"""The least number of pixels in the inner part of a square."""
SURROUND = 1.4
"""The half side of the region around a checker that must be grey, in sides of a square."""
MIN_CONTRAST = 0.1
"""The least difference of white and black of a checker that is found, as a share of the largest."""
MIN_UNIFORMITY = 0.6
"""The least difference in whole squares, as a share of that in their quarters at the centre."""


MAX_SCALE_ERROR = 0.08
"""The greatest difference of the size of squares from that of the set-up, relative."""
MIN_SCALED_PIXELS = 20
"""The least size of squares whose size is compared with the set-up [pixels]."""


@dataclass(frozen=True)
class Checker:
    """A checker in a picture."""

    corners: FloatArray
    """The outer corners: top left, top right, bottom right, bottom left; (4, 2) [pixels]."""
    sign: float
    """1 if the squares at top left and bottom right are white, else -1."""

    @property
    def square_centres(self) -> FloatArray:
        """The centres of the four squares, column and row, (4, 2) [pixels]."""
        places = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
        return _project(_find_homography(self.corners), places)


def find_checkers(
    picture: LinearPicture, sides: Sequence[float], scale: float, *, is_clear: bool = False
) -> dict[float, Checker]:
    """Find checkers of given sizes that are upright within a few degrees, on a grey card.

    A checker of the side s has the greatest difference of opposite quadrants of the size s, less
    what the same quadrants have outside of it: larger checkers fill the outside, smaller ones do
    not fill the quadrants.

    Args:
        picture: the picture, best the one through the clearest water.
        sides: the sides of a square [m].
        scale: the pixels of a metre on the board.
        is_clear: True for the reference water, in which the size of squares is compared with that
            of the set-up; blur widens them by 10 % at c R = 2.

    Raises:
        BadSetting: a checker is not found, or has another size.
    """
    values = np.where(picture.is_valid, picture.values, picture.values.max())
    sizes = [round(side * scale) for side in sides]
    margin = max(round(SURROUND * size) - size for size in sizes) + 1
    values = np.pad(values, margin, mode="edge")
    integral = np.pad(values.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    checkers: dict[float, Checker] = {}
    differences: dict[float, float] = {}
    for side, size in zip(sides, sizes, strict=True):
        if size < 3 or 2 * size >= min(picture.values.shape):
            raise BadSetting(
                f"a square of {side * 100:g} cm is {size} pixels; expected at least 3, and at most "
                "half of the picture."
            )
        (x, y), difference = _find_centre(integral, size)
        half = side * scale
        places = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
        corners = places + np.array([x - margin, y - margin])
        checkers[side] = Checker(corners, math.copysign(1.0, difference))
        differences[side] = abs(difference)
    for side, difference in differences.items():
        if not difference > MIN_CONTRAST * max(differences.values()):
            raise BadSetting(
                f"no checker of {side * 100:g} cm was found; give its corners in the set-up."
            )
    side, size = max(zip(sides, sizes, strict=True))
    if is_clear and size >= MIN_SCALED_PIXELS:
        _check_scale(integral, checkers[side].corners.mean(axis=0) + margin, side, size)
    return checkers


def _check_scale(integral: FloatArray, centre: FloatArray, side: float, size: int) -> None:
    """Compare the size of a checker in the picture with that of the set-up.

    The sum over its squares grows with their size up to the true one, and is constant beyond.
    """
    column, row = (round(float(number) + 0.5) for number in centre)

    def sum_squares(half: int) -> float:
        return float(abs(_compute_quadrants(integral, half)[row - half, column - half]))

    inner_size, outer_size = max(size // 2, 1), round(SURROUND * size)
    true_size = math.sqrt(sum_squares(outer_size) / (sum_squares(inner_size) / inner_size**2))
    if abs(true_size / size - 1.0) > MAX_SCALE_ERROR:
        words = "at least " if true_size > size else ""
        raise BadSetting(
            f"squares of {side * 100:g} cm are {words}{true_size:.0f} pixels; the distance and "
            f"<focalLength> give {size}. The focal length is that in the water."
        )


def _find_centre(integral: FloatArray, size: int) -> tuple[tuple[float, float], float]:
    """Find the centre of the checker with a size of squares [pixels].

    Returns:
        The column and row of the centre, and the difference of its squares; 0 if they are not
        uniform, as in a smaller checker, which fills only their quarters at the centre.
    """
    outer_size = max(round(SURROUND * size), size + 1)
    inner_sums = _compute_quadrants(integral, size)
    outer_sums = _compute_quadrants(integral, outer_size)
    step = outer_size - size
    inner_sums = inner_sums[step : step + outer_sums.shape[0], step : step + outer_sums.shape[1]]
    outer_area = outer_size**2 - size**2
    score = np.abs(inner_sums) / size**2 - np.abs(outer_sums - inner_sums) / outer_area
    row, column = np.unravel_index(int(np.argmax(score)), score.shape)
    difference = float(inner_sums[row, column]) / size**2 / 2.0
    half_size = max(size // 2, 1)
    offset = outer_size - half_size
    central_sum = float(_compute_quadrants(integral, half_size)[row + offset, column + offset])
    if abs(difference) < MIN_UNIFORMITY * abs(central_sum) / half_size**2 / 2.0:
        difference = 0.0
    return (float(column) + outer_size - 0.5, float(row) + outer_size - 0.5), difference


def read_difference(picture: LinearPicture, checker: Checker) -> Sum:
    """Read the difference of white and black: the means of the inner halves of the squares.

    Raises:
        BadSetting: a square is outside of the picture, too small, or saturated.
    """
    low = np.floor(checker.corners.min(axis=0)).astype(int)
    high = np.ceil(checker.corners.max(axis=0)).astype(int) + 1
    height, width = picture.values.shape
    if low.min() < 0 or high[0] > width or high[1] > height:
        raise BadSetting("a checker leaves the picture.")
    columns, rows = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    inverse = np.linalg.inv(_find_homography(checker.corners))
    places = _project(inverse, np.stack([columns.ravel(), rows.ravel()], axis=1))
    window = (slice(low[1], high[1]), slice(low[0], high[0]))
    values, variances = picture.values[window].ravel(), picture.variances[window].ravel()
    is_valid = picture.is_valid[window].ravel()
    black_errors = picture.black_errors[window].ravel()
    total, variance, black = 0.0, 0.0, 0.0
    for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
        distance = np.abs(places - (x, y)).max(axis=1)
        is_inner = distance < INNER_SHARE / 2.0
        n_pixels = int(is_inner.sum())
        if n_pixels < MIN_PIXELS:
            raise BadSetting(
                f"the inner half of a square has {n_pixels} pixels; expected at least {MIN_PIXELS}."
            )
        if not is_valid[is_inner].all():
            raise BadSetting("a square is saturated; use a shorter exposure.")
        sign = checker.sign * math.copysign(1.0, x * y)
        total += sign * float(values[is_inner].mean())
        variance += float(variances[is_inner].sum()) / n_pixels**2
        black += sign * float(black_errors[is_inner].mean())
    return Sum(total / 2.0, math.hypot(math.sqrt(variance), black) / 2.0)


def _compute_quadrants(integral: FloatArray, size: int) -> FloatArray:
    """Compute the sum of two opposite quadrants less that of the others, at every corner of pixels.

    Entry (i, j) is that of the point between rows i + size - 1 and i + size, and columns alike.
    """
    height, width = integral.shape

    def sum_box(row: int, column: int) -> FloatArray:
        n_rows, n_columns = height - 2 * size, width - 2 * size
        top, left = slice(row, row + n_rows), slice(column, column + n_columns)
        bottom = slice(row + size, row + size + n_rows)
        right = slice(column + size, column + size + n_columns)
        box: FloatArray = (
            integral[bottom, right] - integral[top, right] - integral[bottom, left]
            + integral[top, left]
        )  # fmt: skip
        return box

    return sum_box(0, 0) + sum_box(size, size) - sum_box(0, size) - sum_box(size, 0)


def _find_homography(corners: FloatArray) -> FloatArray:
    """Find the matrix from the checker, whose corners are at -1 and 1, to the picture."""
    places = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    rows, targets = [], []
    for (x, y), (u, v) in zip(places, corners.tolist(), strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        targets += [u, v]
    numbers = np.linalg.solve(np.array(rows), np.array(targets))
    return np.append(numbers, 1.0).reshape(3, 3)


def _project(homography: npt.NDArray[Any], places: npt.NDArray[Any]) -> FloatArray:
    """Project places, (n, 2)."""
    points = np.column_stack([places, np.ones(len(places))]) @ homography.T
    projections: FloatArray = points[:, :2] / points[:, 2:]
    return projections
