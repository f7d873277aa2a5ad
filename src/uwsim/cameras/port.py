r"""Ports of underwater housings: rays through air, glass and water, traced exactly.

A ray leaves the entrance pupil of the lens at the tangent :math:`t` from the axis in air, and is
refracted at each surface :math:`i` with the unit normal :math:`\vec N` by Snell's law,

.. math:: \vec d' = \eta \vec d + \left(\sqrt{1 - \eta^2 (1 - c^2)} - \eta c\right) \vec N,
    \qquad c = \vec d \cdot \vec N, \quad \eta = n_i / n_{i+1}

Rays in the water do not meet in one point. Those near the axis meet in the *effective centre*, the
centre that a calibration in water finds; there the pose of a camera is. A ray counts as the line
from this centre to its point at the *focus distance*. At that distance images are exact. Points at
other distances :math:`Z` are displaced in the image by

.. math:: f\, h_0 \left|\frac 1 Z - \frac 1 {Z_0}\right|

where the ray in water passes the plane of the centre at the height :math:`h_0`.

Not modelled: a port that is tilted or displaced across the axis, light that the port absorbs and
reflects, dispersion, the curved field of focus of a dome.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..base.numerics.jit import njit
from ..base.numerics.linear import Array

WATER_INDEX = 1.333
"""The refractive index of fresh water at 20 degrees C, for yellow light (IAPWS 1997)."""
GLASS_INDEX = 1.49
"""The refractive index of acrylic glass (PMMA)."""
MAX_TANGENT = 20.0
"""The greatest tangent of a ray to the axis [1]."""


@dataclass(frozen=True, kw_only=True)
class Port(ABC):
    """A port with rotational symmetry about the optical axis."""

    thickness: float = 0.008
    """The thickness of the glass [m]."""
    glass_index: float = GLASS_INDEX
    """The refractive index of the glass."""
    water_index: float = WATER_INDEX
    """The refractive index of the water."""
    focus_distance: float = 1.0
    """The distance from the effective centre, along the axis, at which images are exact [m]."""

    @cached_property
    @abstractmethod
    def surfaces(self) -> Array:
        """The surfaces along the way of a ray, (2, 4).

        The numbers of a surface are the place of its vertex on the axis from the pupil [m], its
        curvature, positive if the centre of the sphere is before it [1/m], and the refractive
        indices before and after it.
        """

    @property
    def magnification(self) -> float:
        """The focal length in the water over that in air: 1.333 behind a flat port."""
        return 1.0 / self._paraxial[1]

    @property
    def centre_offset(self) -> float:
        """The distance from the effective centre forward to the pupil [m]."""
        return -self._paraxial[0]

    @cached_property
    def _paraxial(self) -> tuple[float, float]:
        """The place of the effective centre [m], and the angle in water of an angle 1 in air."""
        height, angle, place = 0.0, 1.0, 0.0
        for vertex, curvature, index, next_index in self.surfaces.tolist():
            height += angle * (vertex - place)
            place = vertex
            normal = height * curvature
            angle = normal + index / next_index * (angle - normal)
        return place - height / angle, angle

    @cached_property
    def constants(self) -> Array:
        """The numbers for `refract`: place of the centre, focus distance, then the surfaces."""
        return np.concatenate([[self._paraxial[0], self.focus_distance], self.surfaces.ravel()])

    def trace(self, tangent: float) -> tuple[Array, Array]:
        """Trace a ray from the pupil.

        Args:
            tangent: the tangent of its angle to the axis in air.

        Returns:
            The point at which the ray enters the water, and its unit direction there: the height
            above the axis and the place along it, (2,) each, from the pupil [m]. They are NaN if it
            does not.
        """
        ray = np.array(trace_ray(tangent, self.constants))
        return ray[:2], ray[2:]


@dataclass(frozen=True, kw_only=True)
class FlatPort(Port):
    """A flat port across the optical axis."""

    distance: float = 0.02
    """The distance from the entrance pupil of the lens to the glass [m]."""

    @cached_property
    def surfaces(self) -> Array:
        """The two planes."""
        return np.array(
            [
                [self.distance, 0.0, 1.0, self.glass_index],
                [self.distance + self.thickness, 0.0, self.glass_index, self.water_index],
            ]
        )


@dataclass(frozen=True, kw_only=True)
class DomePort(Port):
    """A spherical port whose centre is on the optical axis."""

    radius: float = 0.05
    """The inner radius of the sphere [m]."""
    offset: float = 0.0
    """The distance from the entrance pupil forward to the centre of the sphere [m]."""

    @cached_property
    def surfaces(self) -> Array:
        """The two spheres."""
        inner_radius, outer_radius = self.radius, self.radius + self.thickness
        return np.array(
            [
                [self.offset + inner_radius, 1.0 / inner_radius, 1.0, self.glass_index],
                [
                    self.offset + outer_radius,
                    1.0 / outer_radius,
                    self.glass_index,
                    self.water_index,
                ],
            ]
        )


@njit
def trace_ray(tangent: float, constants: Array) -> tuple[float, float, float, float]:
    """Return height and place where a ray enters the water [m], and its direction there."""
    cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
    sine = tangent * cosine
    height, place = 0.0, 0.0
    for i in range(2):
        vertex, curvature = constants[2 + 4 * i], constants[3 + 4 * i]
        ratio = constants[4 + 4 * i] / constants[5 + 4 * i]
        normal_sine, normal_cosine = 0.0, 1.0
        if curvature == 0.0:
            length = (vertex - place) / cosine
        else:
            radius = 1.0 / curvature
            offset = place - (vertex - radius)
            middle = height * sine + offset * cosine
            root = middle * middle - height * height - offset * offset + radius * radius
            length = math.sqrt(root) - middle if root >= 0.0 else math.nan
        height += length * sine
        place += length * cosine
        if curvature != 0.0:
            normal_sine = height * curvature
            normal_cosine = (place - vertex) * curvature + 1.0
        projection = sine * normal_sine + cosine * normal_cosine
        square = 1.0 - ratio * ratio * (1.0 - projection * projection)
        factor = (math.sqrt(square) if square >= 0.0 else math.nan) - ratio * projection
        sine = ratio * sine + factor * normal_sine
        cosine = ratio * cosine + factor * normal_cosine
    return height, place, sine, cosine


@njit
def refract(tangent: float, constants: Array) -> float:
    """Return the tangent in water, from the effective centre, of a ray's tangent in air.

    It is the tangent to the ray's point at the focus distance; NaN if no such point is in view.
    """
    height, place, sine, cosine = trace_ray(tangent, constants)
    focus = constants[1]
    rest = constants[0] + focus - place
    if not (cosine > 0.0 and rest > 0.0):
        return math.nan
    water_tangent: float = (height + rest * sine / cosine) / focus
    return water_tangent


@njit
def find_air_tangent(tangent: float, constants: Array) -> float:
    """Return the tangent in air whose `refract` is a tangent in water; NaN if there is none.

    The method is a bisection to the last bit: refraction grows with the tangent.
    """
    if tangent == 0.0:
        return 0.0
    low, high = 0.0, MAX_TANGENT
    for _ in range(80):
        middle = 0.5 * (low + high)
        value = refract(middle, constants)
        if value < tangent:
            low = middle
        else:  # also where a ray does not reach the focus distance
            high = middle
        if high - low <= 1e-15 * high:
            break
    return math.nan if high == MAX_TANGENT else 0.5 * (low + high)
