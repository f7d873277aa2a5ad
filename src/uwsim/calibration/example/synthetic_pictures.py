r"""Synthetic pictures of LEDs, boards and the lamp's veil, with the noise of a camera.

A picture is first drawn as light: the radiance of each pixel times its solid angle on the axis. A
camera then gives linear numbers of 12 bit, with the noise of its electrons (`cameras`). The light
comes from functions that the caller gives: the formulas of `optics` for the example, the signals of
the path tracer in the tests.

Not modelled: a lens that is not sharp, vignetting, a Bayer pattern, glare.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...cameras import CameraResponse
from ...cameras.digital_numbers import FULL_SCALE
from ...cameras.noise_words import frame_key
from ...optics.phase_function import FloatArray

SPOT_SIZE = 1.0
"""The standard deviation of an LED's picture [pixels]."""
PADDING = 2
"""The factor by which a picture is padded before it is blurred_radiance."""
INFINITE_CARD = 0.5
"""The brightness of the grey card, between black 0 and white 1."""


@dataclass(frozen=True, kw_only=True)
class SyntheticCamera:
    """A camera for synthetic pictures; the defaults are those of the error budget."""

    rows: int = 384
    """The number of rows."""
    columns: int = 512
    """The number of columns."""
    focal_length: float = 1000.0
    """The focal length in the water [pixels]: 1 mrad for a pixel."""
    full_well: float = 10_000.0
    """The electrons of full scale."""
    read_noise: float = 3.0
    """The standard deviation of the read noise [electrons]."""
    black_level: float = 0.01
    """The black level as a share of full scale."""
    black_drift: float = 0.1
    """The standard deviation of the black level between a picture and its dark frames [e-]."""
    full_scale: int = FULL_SCALE
    """The number of a file at full scale."""

    @property
    def middle(self) -> tuple[float, float]:
        """The column and row of the optical axis [pixels]."""
        return (self.columns - 1) / 2.0, (self.rows - 1) / 2.0

    def expose(
        self, light: FloatArray, exposure: float, n_frames: int, generator: np.random.Generator
    ) -> list[FloatArray]:
        """Take frames of light; the numbers are whole and limited to full scale.

        The black level of frames without any light has no error: it is that of the dark frames.

        Args:
            light: the light of each pixel, as a share of full scale in the exposure time 1.
            exposure: the exposure time.
            n_frames: the number of frames.
            generator: the source of noise.
        """
        drift = self.black_drift * generator.standard_normal() * bool(light.any())
        gain = self.full_well / self.full_scale
        response = CameraResponse(
            exposure_time=exposure,
            sensitivity=self.full_well,
            full_well=2.0 * self.full_well,  # full scale is reached first
            gain=gain,
            read_noise=self.read_noise,
            black_level=self.black_level * self.full_scale + drift / gain,
            output="linear12",
        )
        falloff = np.ones(light.shape, np.float32)
        pixels = light[..., None].astype(np.float32)
        frames: list[FloatArray] = []
        for _ in range(n_frames):
            numbers = response.expose(pixels, falloff, frame_key(generator))
            frames.append(numbers.astype(np.float64))
        return frames


def draw_led(
    camera: SyntheticCamera,
    direct_light: float,
    compute_scattered: Callable[[FloatArray], FloatArray],
    centre: tuple[float, float] | None = None,
) -> FloatArray:
    """Draw an LED: a spot of direct light, and the halo.

    Args:
        camera: the camera.
        direct_light: the direct light.
        compute_scattered: computes the scattered light within half-angles [rad].
        centre: the column and row of the LED; None: the optical axis.
    """
    x0, y0 = camera.middle if centre is None else centre
    rows, columns = np.indices((camera.rows, camera.columns))
    squares = (columns - x0) ** 2 + (rows - y0) ** 2
    spot = np.exp(-0.5 * squares / SPOT_SIZE**2)
    # A ring has the pixels between two whole distances: each gets the same share of its light.
    rings = np.sqrt(squares).astype(int)
    limits = np.arange(1.0, rings.max() + 2)
    shares = np.diff(compute_scattered(np.arctan(limits / camera.focal_length)), prepend=0.0)
    areas = math.pi * np.diff(limits**2, prepend=0.0)
    margin = int(min(x0, y0, camera.columns - 1 - x0, camera.rows - 1 - y0))
    areas[:margin] = np.bincount(rings.ravel())[:margin]
    # The weight of `sum_discs`: the pixel's solid angle and the cosine, relative to the axis.
    cosines = camera.focal_length / np.sqrt(camera.focal_length**2 + squares)
    halo = (shares / areas)[rings] / cosines**4
    return np.asarray(direct_light * spot / spot.sum() + halo)


@dataclass(frozen=True)
class BoardLayout:
    """The places of checkers on a board."""

    sides: tuple[float, ...]
    """The side of a square of each checker [m]."""
    centres: tuple[tuple[float, float], ...]
    """The centre of each checker from the optical axis, right and down [m]."""


LAYOUT = BoardLayout((0.15, 0.04, 0.01), ((-0.08, 0.0), (0.15, -0.06), (0.15, 0.06)))
"""A layout that fits into the picture at 1 m: the checkers do not meet."""


def draw_board(
    camera: SyntheticCamera,
    layout: BoardLayout,
    distance: float,
    compute_transfer: Callable[[FloatArray], FloatArray],
    compute_irradiance: Callable[[FloatArray, FloatArray], FloatArray],
    reflectances: tuple[float, float] = (0.9, 0.05),
) -> FloatArray:
    """Draw a board through the water.

    Args:
        camera: the camera.
        layout: the checkers.
        distance: the distance of the board's plane [m].
        compute_transfer: computes the modulation transfer at frequencies [cycles/rad].
        compute_irradiance: computes the irradiance at places on the board, right and down [m].
        reflectances: those of white and black.
    """
    height, width = PADDING * camera.rows, PADDING * camera.columns
    x0, y0 = camera.middle
    top, left = (height - camera.rows) // 2, (width - camera.columns) // 2
    scale = distance / camera.focal_length
    x = (np.arange(width) - left - x0) * scale
    y = (np.arange(height) - top - y0) * scale
    grid_x, grid_y = np.meshgrid(x, y)
    white, black = reflectances
    reflectance = black + (white - black) * draw_pattern(layout, grid_x, grid_y, scale)
    radiance = reflectance * compute_irradiance(grid_x, grid_y) / math.pi
    frequencies = (
        np.hypot(np.fft.fftfreq(height)[:, None], np.fft.rfftfreq(width)[None, :])
        * camera.focal_length
    )
    table = np.append(0.0, np.geomspace(0.05, frequencies.max() * 1.01, 200))
    transfer = np.interp(frequencies, table, compute_transfer(table))
    blurred_radiance = np.fft.irfft2(np.fft.rfft2(radiance) * transfer, s=radiance.shape)
    picture: FloatArray = blurred_radiance[top : top + camera.rows, left : left + camera.columns]
    return picture


def draw_pattern(layout: BoardLayout, x: FloatArray, y: FloatArray, pixel: float) -> FloatArray:
    """Draw checkers on a grey card, 0 black and 1 white, with the edges of pixels averaged."""
    pattern = np.full(x.shape, INFINITE_CARD)
    for side, (centre_x, centre_y) in zip(layout.sides, layout.centres, strict=True):
        u, v = x - centre_x, y - centre_y
        coverage = _cover(u, side, pixel) * _cover(v, side, pixel)
        signs = np.clip(2.0 * u / pixel, -1.0, 1.0) * np.clip(2.0 * v / pixel, -1.0, 1.0)
        pattern = pattern + 0.5 * coverage * signs
    return pattern


def compute_board_irradiance(
    places: Sequence[FloatArray], distance: float, lamp_position: Sequence[float]
) -> tuple[FloatArray, FloatArray]:
    """Compute the distances of places on a board from a lamp [m], and cos(i) / d^2."""
    x, y = places
    depth = distance - lamp_position[2]
    lengths = np.sqrt((x - lamp_position[0]) ** 2 + (y - lamp_position[1]) ** 2 + depth**2)
    factors: FloatArray = depth / lengths**3
    return lengths, factors


def _cover(place: FloatArray, half_size: float, pixel: float) -> FloatArray:
    """Return the share of a pixel within a half size of zero."""
    share: FloatArray = np.clip((half_size - np.abs(place)) / pixel + 0.5, 0.0, 1.0)
    return share
