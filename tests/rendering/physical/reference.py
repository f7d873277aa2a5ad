"""The image model of physical water in numpy, with true Gaussians, as reference for the shaders."""

from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import gaussian_filter

from tests.rendering.physical.photographs import FloatArray
from uwsim.base.geometry import Intrinsics
from uwsim.optics.transmission import compute_direct
from uwsim.rendering.physical.blur_plan import plan_blur
from uwsim.rendering.physical.blur_weights import (
    N_RANGES,
    compute_weight_table,
    find_table_scale,
)
from uwsim.rendering.physical.physical_water import PhysicalWater
from uwsim.rendering.physical.transfer_curve import encode


def compose(
    water: PhysicalWater,
    intrinsics: Intrinsics,
    radiance: FloatArray,
    range_: FloatArray,
    open_water: FloatArray,
    veil: FloatArray,
) -> FloatArray:
    """Return the stored values of an image, 0..1.

    Args:
        water: the water.
        intrinsics: the pinhole of the camera.
        radiance: the radiance of surfaces without water, (h, w, 3).
        range_: their ranges, (h, w) [m]; inf: no surface.
        open_water: the radiance of open water behind each pixel, (h, w, 3).
        veil: the veil of lamps, (h, w, 3).
    """
    is_surface = np.isfinite(range_)
    ranges = np.where(is_surface, range_, 0.0)
    excess = np.where(is_surface[..., None], radiance - open_water, 0.0)
    light = open_water + compute_direct(water.medium, ranges) * excess
    focal = math.sqrt(intrinsics.fx * intrinsics.fy)
    plan, scale = plan_blur(intrinsics, has_blur=True), find_table_scale(water.medium)
    table = compute_weight_table(water.medium, plan.sigmas, plan.highest_frequency)
    rows = zip(table, (0.0, *plan.sigmas), (1.0, *plan.reach), strict=True)
    for row, sigma, reach in rows:
        places = reach * ranges
        places = places / (places + scale) * (N_RANGES - 1)
        for channel in range(3):
            weights = np.interp(places, np.arange(N_RANGES), row[:, channel])
            light[..., channel] += gaussian_filter(
                weights * excess[..., channel], sigma * focal, mode="nearest", truncate=4.0
            )
    return encode((light + veil) * water.exposure)
