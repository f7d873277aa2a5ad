r"""Image statistics that determine at which fog density a ZNCC tracker loses its target.

Let S be the contrast of the patch (the standard deviation of its grey levels without noise and
fog), sigma the standard deviation of the noise, z the tracker's threshold, and d the mean distance
from the camera to the patch. Fog of density f leaves the contrast :math:`S e^{-(fd)^2}`, and the
zero-mean normalised cross-correlation (ZNCC) with a noise-free template is

.. math:: \rho = \left(1 + \sigma^2 / (S e^{-(fd)^2})^2\right)^{-1/2}

which falls below z at

.. math:: f^* = \frac{1}{d} \sqrt{\ln\left(\frac{S}{\sigma}\sqrt{1/z^2 - 1}\right)}

Here sigma is the noise of each colour channel of the camera, ``255 std`` grey levels. Grey is a
weighted sum of the three channels, so its noise is smaller by the norm of the weights, 0.669.
``f_star_grey`` is the limit with this noise, for a tracker of grey images. Not modelled are noise
in the template, 8-bit quantisation, and the tracker's own error.

The motion of the target in the image is measured, too, because a benchmark whose target does not
move in the image does not test a tracker.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.linear import length, product
from ...benchmark.ground_truth import CornersFromCameraSpec, GroundTruth
from ...benchmark.measures import EuclideanNormSpec
from ...simulation import Simulation
from ..planning.plan import Plan

GREY = np.array([0.299, 0.587, 0.114])
"""Weights of red, green and blue in grey (ITU-R BT.601)."""
Fact = tuple[float, str]
"""A value that holds for a whole trial, and its unit."""


def visibility_facts(
    simulation: Simulation, plan: Plan, parameters: Mapping[str, float | str]
) -> dict[str, Fact]:
    """Measure S, sigma, d and f* of the first target whose corners are tracked in a camera.

    Returns:
        ``S``, ``sigma`` and ``sigma_grey`` [grey level], ``d`` [m], ``z`` [1], ``f_star`` and
        ``f_star_grey`` [1/m]. The last three exist only for an algorithm with the parameter
        ``zncc_threshold``. Empty if no measure uses corners in a camera.
    """
    for spec in plan.benchmark.measures:
        if not isinstance(spec, EuclideanNormSpec):
            continue
        truth = spec.ground_truth
        if not isinstance(truth, CornersFromCameraSpec):
            continue
        corners = truth.bind(simulation.world.measure_view, spec.truth).read()
        if corners is None:
            continue
        camera = simulation.world.sensors.camera(truth.camera)
        image = simulation.world.scenery.render_clean(
            camera.world_from_camera,
            camera.intrinsics,
            fog=0.0,
            is_polished=camera.is_polished,
        )
        assert image.range is not None
        assert image.colour is not None
        mask = quad_mask(corners.reshape(4, 2), image.range.shape)
        mask &= np.isfinite(image.range)
        if not mask.any():
            continue
        grey = product(image.colour[..., :3].astype(np.float64), GREY)
        contrast = float(grey[mask].std())
        distance = float(image.range[mask].mean())
        sigma = 255.0 * camera.state.std
        sigma_grey = sigma * length(GREY)
        threshold_setting = parameters.get("zncc_threshold")
        facts: dict[str, Fact] = {
            "S": (contrast, "grey level"),
            "sigma": (sigma, "grey level"),
            "sigma_grey": (sigma_grey, "grey level"),
            "d": (distance, "m"),
        }
        if not isinstance(threshold_setting, float | int):
            return facts
        threshold = float(threshold_setting)
        facts["z"] = (threshold, "1")
        for name, noise in (("f_star", sigma), ("f_star_grey", sigma_grey)):
            limit = fog_of_loss(contrast, noise, distance, threshold)
            if limit is not None:
                facts[name] = (limit, "1/m")
        return facts
    return {}


class TargetMotion:
    """The range of motion, in the image, of the first target whose corners are tracked.

    The corners are sampled at every 16th step.
    """

    SAMPLE_PERIOD = 16
    """The number of steps from one sample to the next."""

    def __init__(self, simulation: Simulation, plan: Plan) -> None:
        self._truth = _first_truth(simulation, plan)
        # the range of each coordinate of the corners so far, (8,) [px]
        self._low = self._high = np.zeros(0)
        self._steps = 0
        if self._truth is not None:
            simulation.watch(self.tick)

    def tick(self) -> None:
        """Sample the corners after one more step."""
        self._steps += 1
        if self._steps % self.SAMPLE_PERIOD or self._truth is None:
            return
        corners = self._truth.read()
        if corners is not None:
            self._low = np.minimum(self._low, corners) if self._low.size else corners
            self._high = np.maximum(self._high, corners) if self._high.size else corners

    @property
    def facts(self) -> dict[str, Fact]:
        """``shift`` [px]: the widest range of a corner's x or y; empty if none was visible."""
        if not self._low.size:
            return {}
        return {"shift": (float((self._high - self._low).max()), "px")}


def _first_truth(simulation: Simulation, plan: Plan) -> GroundTruth | None:
    for spec in plan.benchmark.measures:
        if isinstance(spec, EuclideanNormSpec) and isinstance(
            spec.ground_truth, CornersFromCameraSpec
        ):
            return spec.ground_truth.bind(simulation.world.measure_view, spec.truth)
    return None


def fog_of_loss(contrast: float, noise: float, distance: float, threshold: float) -> float | None:
    """Return the fog density f* [1/m] at which the ZNCC falls to the threshold, if it does."""
    if noise <= 0.0 or distance <= 0.0 or not 0.0 < threshold < 1.0 or contrast <= 0.0:
        return None
    ratio = contrast * math.sqrt(1.0 / threshold**2 - 1.0) / noise
    return math.sqrt(math.log(ratio)) / distance if ratio > 1.0 else 0.0


def quad_mask(corners: Array, shape: tuple[int, ...]) -> npt.NDArray[np.bool_]:
    """Return the mask (h, w) of the pixels whose centres are in a convex quadrangle (4, 2) [px]."""
    v, u = np.mgrid[0 : shape[0], 0 : shape[1]]
    sides = [
        (b[0] - a[0]) * (v - a[1]) - (b[1] - a[1]) * (u - a[0])
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
    ]
    products = np.stack(sides)
    mask: npt.NDArray[np.bool_] = np.logical_or(
        (products >= 0.0).all(axis=0), (products <= 0.0).all(axis=0)
    )
    return mask
