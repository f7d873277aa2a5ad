r"""The light of lamps in water: on targets, and scattered into the camera.

A lamp of radiant intensity :math:`I(\alpha)` lights a target at distance :math:`d`, which the
camera sees at distance :math:`l`. The radiance of a white surface whose lit field is much wider
than the blur is

.. math::
    S = \frac{I(\alpha)}{\pi} \frac{\cos i}{d^2} e^{-(c - b e)(d + l)}, \quad
    e = EE(\gamma) - A - k_L \sqrt{a (d + l)}

with the half-angle :math:`\gamma` of the lamp, :math:`A_0 = 0.65\, b_b/b + 0.25\, (1 - g)`,
:math:`A = \min(A_0, 0.03 + A_0 / 4)` and :math:`k_L = 0.13\, (1 - g)`: light that is scattered
forward still lights the target. The direct light alone is 20 % of the signal at c R = 1.

The veil of the lamp along a ray of the camera is single scattering in which forward-scattered light
counts as not scattered. With the foot distance :math:`h` of the lamp from the ray, the distance
:math:`t_0` of the foot, :math:`t = t_0 + h \tan\eta` and :math:`d = h / \cos\eta`:

.. math::
    V = \frac{b}{h} \int_{\eta_0}^{\eta_1} p\left(\tfrac{\pi}{2} + \eta\right)
        e^{-c_v (t + d)} I(\alpha)\, d\eta, \quad c_v = c - 0.97\, b

The limits are the part of the ray in the lamp's cone and before the surface; the integral has four
points of Gauss and Legendre, which are exact to 0.5 %.

Errors, within 22 degrees of the lamp's axis and to an optical depth of 4 of the range: S 10 %;
V 6 % for c to 0.5/m and 16 % for c to 1/m. At c = 2/m, 91 % of the cases of the reference are
within 15 %, and the worst is 31 % off: with the lamp 0.3 m or more beside the camera, most light is
scattered many times. For phase functions with bb/b above 0.05, V is up to 20 % too large.

Not modelled: the veil on rays that never enter the cone, light that the target reflects before the
water scatters it (2 to 7 % of S), shadows, the size of the lamp.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import arctan, exp
from ..errors import BadSetting, ErrorCollector
from .medium import Medium
from .phase_function import FloatArray, PhaseFunction

MIN_DISTANCE = 0.01
"""The minimum distance to a lamp [m]; smaller ones are set to it."""
MIN_FOOT_DISTANCE = 1e-3
"""The minimum distance of a lamp from a ray [m]."""
VEIL_FORWARD_SHARE = 0.97
"""The fraction of scattered light that counts as not scattered in the veil."""
NODES = (-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526)
"""The points of Gauss and Legendre in -1..1."""
WEIGHTS = (0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538)
"""The weights of the points."""


@dataclass(frozen=True, kw_only=True)
class Lamp:
    """A lamp in water: a point that shines into a cone, with the same colour in all directions.

    Raises:
        BadSetting: a number is invalid.
        SeveralErrors: several are.
    """

    position: tuple[float, float, float]
    """The position [m], in the frame of the points and rays that it lights."""
    direction: tuple[float, float, float]
    """The direction of the axis of the cone, not zero."""
    intensity: tuple[float, ...]
    """The radiant intensity on the axis, per channel of the water [W/sr]."""
    half_angle: float
    """The angle between axis and edge of the cone [rad], at most pi (all directions)."""
    softness: float = 0.0
    """The fraction of the half-angle over which the light decreases to zero at the edge, 0..1."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        for is_valid, text in (
            (
                all(math.isfinite(value) for value in self.position),
                f"The position of a lamp is {self.position}; expected finite numbers.",
            ),
            (
                0.0 < math.hypot(*self.direction) < math.inf,
                f"The direction of a lamp is {self.direction}; expected a vector that is not zero.",
            ),
            (
                all(0.0 <= value < math.inf for value in self.intensity),
                f"The intensity of a lamp is {self.intensity}; expected 0 W/sr or more.",
            ),
            (
                0.0 < self.half_angle <= math.pi,
                f"The half-angle of a lamp is {self.half_angle:g} rad; expected 0 to pi.",
            ),
            (
                0.0 <= self.softness <= 1.0,
                f"The softness of a lamp is {self.softness:g}; expected 0 to 1.",
            ),
        ):
            with errors.collect():
                if not is_valid:
                    raise BadSetting(text)
        errors.raise_errors()

    @property
    def axis(self) -> FloatArray:
        """The unit vector of the direction, (3,)."""
        axis: FloatArray = np.array(self.direction) / math.hypot(*self.direction)
        return axis

    def compute_lobe(self, cosine: npt.ArrayLike) -> FloatArray:
        """Compute the intensity relative to that on the axis.

        It is 1 inside of the soft edge, 0 outside of the cone, and a smooth step of the cosine
        between, as in the other lamps of this package.

        Args:
            cosine: the cosines of the angles from the axis.
        """
        cosines = np.asarray(cosine, dtype=np.float64)
        edge_cosine = math.cos(self.half_angle)
        bright_cosine = math.cos((1.0 - self.softness) * self.half_angle)
        if bright_cosine - edge_cosine < 1e-9:
            return np.where(cosines >= edge_cosine - 1e-12, 1.0, 0.0)
        share = np.clip((cosines - edge_cosine) / (bright_cosine - edge_cosine), 0.0, 1.0)
        lobe: FloatArray = share * share * (3.0 - 2.0 * share)
        return lobe


def compute_target_radiance(
    water: Medium, lamp: Lamp, points: FloatArray, normals: FloatArray, camera: Sequence[float]
) -> FloatArray:
    """Compute the radiance S of a white surface in a lamp's light, as the camera sees it.

    Multiply by the albedo. The camera's veil is not in it.

    Args:
        water: the water, of n channels.
        lamp: the lamp.
        points: the points on the surface, (..., 3) [m].
        normals: the unit normals of the surface, (..., 3).
        camera: the position of the camera, (3,) [m].

    Returns:
        The radiance [W/sr/m^2], (..., n).
    """
    lengths = _measure_lengths(points - np.array(camera))
    distances, factor = _compute_geometry(lamp, points, normals)
    paths = distances + lengths
    attenuation = compute_lamp_attenuation(water, lamp.half_angle, paths)
    radiance: FloatArray = (
        np.array(lamp.intensity) * factor / math.pi * exp(-attenuation * paths[..., None])
    )
    return radiance


def compute_lamp_irradiance(
    water: Medium, lamp: Lamp, points: FloatArray, normals: FloatArray
) -> FloatArray:
    """Compute the irradiance of a surface by a lamp, for an image that is blurred afterwards.

    The factor of the way from the lamp is that of `compute_target_radiance`, for a camera at the
    distance of the lamp; the way to the camera is left to `blur`. The blurred image of a lit plane
    is 2 to 8 % below the traced one.

    Args:
        water: the water, of n channels.
        lamp: the lamp.
        points: the points on the surface, (..., 3) [m].
        normals: the unit normals of the surface, (..., 3).

    Returns:
        The irradiance [W/m^2], (..., n).
    """
    distances, factor = _compute_geometry(lamp, points, normals)
    attenuation = compute_lamp_attenuation(water, lamp.half_angle, 2.0 * distances)
    irradiance: FloatArray = (
        np.array(lamp.intensity) * factor * exp(-attenuation * distances[..., None])
    )
    return irradiance


def compute_lamp_attenuation(
    water: Medium, half_angle: float, path_length: npt.ArrayLike
) -> FloatArray:
    """Compute the attenuation c - b e of a lamp's light on a wide target [1/m].

    Args:
        water: the water, of n channels.
        half_angle: the half-angle of the lamp [rad].
        path_length: the lengths of the ways lamp-target-camera [m], (...).
    """
    paths = np.asarray(path_length, dtype=np.float64)[..., None]
    share, factor = find_lamp_coefficients(water.phase_function, half_angle)
    absorption, scattering = np.array(water.absorption), np.array(water.scattering)
    energy = share - factor * np.sqrt(absorption * paths)
    attenuation: FloatArray = absorption + scattering * (1.0 - energy)
    return attenuation


def find_lamp_coefficients(phase: PhaseFunction, half_angle: float) -> tuple[float, float]:
    """Return EE(half-angle) - A, and k_L, of the light on a lamp's target.

    The smaller loss of phase functions with bb/b above 0.024 was fitted to the path tracer.
    """
    spread = 1.0 - phase.mean_cosine
    narrow_loss = 0.65 * phase.backscatter_ratio + 0.25 * spread
    loss = min(narrow_loss, 0.03 + 0.25 * narrow_loss)
    return float(phase.compute_encircled_energy(half_angle)) - loss, 0.13 * spread


def compute_lamp_veil(
    water: Medium,
    lamp: Lamp,
    camera: Sequence[float],
    rays: FloatArray,
    distance: npt.ArrayLike,
) -> FloatArray:
    """Compute the radiance V that the water scatters from a lamp into the camera.

    Args:
        water: the water, of n channels.
        lamp: the lamp.
        camera: the position of the camera, (3,) [m].
        rays: the unit directions of the camera's rays, (..., 3).
        distance: the ranges of the surfaces along the rays [m], (...); infinite for open water.

    Returns:
        The radiance [W/sr/m^2], (..., n).
    """
    offset = np.array(camera) - np.array(lamp.position)  # (3,), from the lamp to the camera
    foot = -_project(rays, offset)  # (...) [m], along the ray
    foot_vector = offset + foot[..., None] * rays
    height = np.maximum(_measure_lengths(foot_vector), MIN_FOOT_DISTANCE)
    start, end = find_lit_part(lamp, offset, rays, np.asarray(distance, dtype=np.float64))
    low, high = arctan((start - foot) / height), arctan((end - foot) / height)
    scattering = np.array(water.scattering)
    attenuation = water.beam_attenuation - VEIL_FORWARD_SHARE * scattering  # (n,)
    total: FloatArray = np.zeros((*foot.shape, water.n_channels))
    for node, weight in zip(NODES, WEIGHTS, strict=True):
        angle = 0.5 * (high + low) + 0.5 * (high - low) * node
        cosine = np.cos(angle)
        foot_offsets = height * np.sin(angle) / cosine  # from the foot [m]
        lengths = height / cosine
        from_lamp = (foot_vector + foot_offsets[..., None] * rays) / lengths[..., None]
        density = water.phase_function.compute_density(0.5 * math.pi + angle)
        share = weight * density * lamp.compute_lobe(_project(from_lamp, lamp.axis))
        paths = np.maximum(foot + foot_offsets, 0.0) + lengths
        total = total + share[..., None] * exp(-attenuation * paths[..., None])
    width = np.maximum(high - low, 0.0)
    veil: FloatArray = (
        scattering * np.array(lamp.intensity) * (0.5 * width / height)[..., None] * total
    )
    return veil


def find_lit_part(
    lamp: Lamp, offset: FloatArray, rays: FloatArray, distance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Find the part of each ray that is inside the lamp's cone and before the surface.

    The cone of a lamp of more than 90 degrees is not convex; then the whole ray counts, and the
    lobe of the lamp is zero outside of the cone.

    Args:
        lamp: the lamp.
        offset: the position of the rays' origin from the lamp, (3,) [m].
        rays: the unit directions of the rays, (..., 3).
        distance: the ranges of the surfaces along the rays [m], (...).

    Returns:
        The begin and the end of the part along each ray [m], (...); equal if there is none.
    """
    start = np.zeros(rays.shape[:-1])
    end = np.broadcast_to(distance, start.shape).astype(np.float64)
    if lamp.half_angle >= 0.5 * math.pi:
        return start, end
    square = math.cos(lamp.half_angle) ** 2
    axis = lamp.axis
    ray_cosine = _project(rays, axis)
    height = float(np.sum(offset * axis))  # of the origin along the axis [m]
    # A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
    a = ray_cosine * ray_cosine - square
    a = np.where(np.abs(a) < 1e-12, 1e-12, a)
    b = ray_cosine * height - square * _project(rays, offset)
    c = height * height - square * float(np.sum(offset * offset))
    discriminant = b * b - a * c
    root = np.sqrt(np.maximum(discriminant, 0.0))
    near = np.minimum((-b - root) / a, (-b + root) / a)
    far = np.maximum((-b - root) / a, (-b + root) / a)
    is_steep = a > 0.0  # the ray stays inside the cone, forwards or backwards
    is_forward = ray_cosine > 0.0
    crosses = (discriminant > 0.0) & (height + 0.5 * (near + far) * ray_cosine > 0.0)
    begin = np.where(is_steep, np.where(is_forward, far, -math.inf), near)
    finish = np.where(is_steep, np.where(is_forward, math.inf, near), far)
    start = np.maximum(start, begin)
    end = np.minimum(end, finish)
    is_lit = (is_steep | crosses) & (end > start)
    return np.where(is_lit, start, 0.0), np.where(is_lit, end, 0.0)


def _compute_geometry(
    lamp: Lamp, points: FloatArray, normals: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Compute the distances of points from a lamp, (...), and lobe cos(i) / d^2, (..., 1)."""
    from_lamp = points - np.array(lamp.position)
    distances = np.maximum(_measure_lengths(from_lamp), MIN_DISTANCE)
    incidence = np.maximum(-np.sum(from_lamp * normals, axis=-1) / distances, 0.0)
    lobe = lamp.compute_lobe(_project(from_lamp, lamp.axis) / distances)
    return distances, (lobe * incidence / (distances * distances))[..., None]


def _measure_lengths(vectors: FloatArray) -> FloatArray:
    lengths: FloatArray = np.sqrt(np.sum(vectors * vectors, axis=-1))
    return lengths


def _project(vectors: FloatArray, direction: FloatArray) -> FloatArray:
    projection: FloatArray = np.sum(vectors * direction, axis=-1)
    return projection
