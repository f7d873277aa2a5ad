"""A lens with its port: the map between rays in the water and the image of a pinhole.

Coordinates are normalised: for a point at depth Z, x / Z to the right and y / Z down. In the image,
they are pixels from the principal point over the focal length *in the water*, which is the focal
length in air times the magnification of the port. Light passes the port, then the lens with its
distortion in air.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..base.numerics.jit import njit
from ..base.numerics.linear import Array
from .distortion import N_COEFFICIENTS, distort_point, undistort_point
from .port import Port, find_air_tangent, refract

NO_DISTORTION = (0.0,) * N_COEFFICIENTS


@dataclass(frozen=True, kw_only=True)
class Lens:
    """A lens with distortion, in the water or behind a port."""

    distortion: tuple[float, ...] = NO_DISTORTION
    """The coefficients k1, k2, p1, p2, k3 of ``plumb_bob``; behind a port, those in air."""
    port: Port | None = None
    """The port; None: the coefficients are those in the water."""

    @property
    def magnification(self) -> float:
        """The focal length in the water over that of the file."""
        return 1.0 if self.port is None else self.port.magnification

    @cached_property
    def _constants(self) -> tuple[Array, Array, float]:
        port = np.zeros(0) if self.port is None else self.port.constants
        return np.array(self.distortion, dtype=np.float64), port, self.magnification

    def distort(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return the image coordinates of directions in the water, arrays of one shape.

        A direction that does not reach the image has NaN.
        """
        return _map_points(x, y, *self._constants, True)

    def undistort(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return the directions in the water of image coordinates, arrays of one shape.

        A place in the image that no direction reaches has NaN.
        """
        return _map_points(x, y, *self._constants, False)

    def compute_air_tangents(self, x: Array, y: Array) -> Array:
        """Return the tangent of the rays of image coordinates to the axis, in front of the lens."""
        distortion, _, magnification = self._constants
        in_air = _map_points(
            x * magnification, y * magnification, distortion, np.zeros(0), 1.0, False
        )
        tangents: Array = np.sqrt(in_air[0] ** 2 + in_air[1] ** 2)
        return tangents


@njit
def map_point(
    x: float, y: float, distortion: Array, port: Array, magnification: float, is_forward: bool
) -> tuple[float, float]:
    """Return the image coordinates of a direction, or backward, the direction of coordinates."""
    if is_forward:
        if len(port) > 0:
            radius = math.sqrt(x * x + y * y)
            if radius > 0.0:
                factor = find_air_tangent(radius, port) / radius
                x, y = x * factor, y * factor
        x, y = distort_point(x, y, distortion)
        return x / magnification, y / magnification
    x, y = undistort_point(x * magnification, y * magnification, distortion)
    if len(port) > 0:
        radius = math.sqrt(x * x + y * y)
        if radius > 0.0:
            factor = refract(radius, port) / radius
            x, y = x * factor, y * factor
    return x, y


@njit
def _map_points(
    x: Array, y: Array, distortion: Array, port: Array, magnification: float, is_forward: bool
) -> tuple[Array, Array]:
    xs, ys = x.ravel(), y.ravel()
    mapped_x, mapped_y = np.empty_like(xs), np.empty_like(ys)
    for index in range(len(xs)):
        mapped_x[index], mapped_y[index] = map_point(
            xs[index], ys[index], distortion, port, magnification, is_forward
        )
    return mapped_x.reshape(x.shape), mapped_y.reshape(y.shape)
