r"""A lamp on a vehicle: a cone of light that the water attenuates.

The lamp adds to the light of a surface with the colour :math:`L_c` and the unit normal :math:`N`,
on stored values (no gamma) and before the water between surface and camera (`water`),

.. math::
    L_c\,k_c\,I\,\frac{\max(N \cdot D, 0)}{d^2}\,s(\theta)\,e^{-a_c d}\,v

with the lamp's colour :math:`k` and intensity :math:`I`, the distance :math:`d` and the unit vector
:math:`D` from the surface to the lamp, the water's attenuation :math:`a` between them, the share
:math:`s` of the light at the angle :math:`\theta` from the lamp's axis, and :math:`v`, 0 in shadow
and 1 in light. Distances below 1 cm count as 1 cm. The light does not depend on the sun or the
light rate of the scene. Not modelled: backscatter of the lamp's light into the camera, scattering
and reflection of the light on its path, fog between lamp and surface (it acts between surface and
camera only), specular reflection, and an image of the lamp itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import exp
from ...base.numerics.linear import product
from ..water import Colour

MAX_HALF_ANGLE = math.radians(80.0)
"""The largest half angle: a wider cone does not fit one shadow map [rad]."""

MIN_DISTANCE = 0.01
"""The minimum distance to the lamp; smaller ones are set to it [m]."""


@dataclass(frozen=True, kw_only=True)
class Lamp:
    """A round cone of light from a point, along the lamp's -z axis, as cameras look.

    Raises:
        ValueError: a number is outside its bounds.
    """

    world_from_lamp: Pose = field(compare=False)
    """The pose of the lamp in W; OpenGL axes: the lamp shines along -z."""
    pose_bytes: bytes = field(init=False, repr=False)
    """The bytes of the matrix of the pose: lamps at equal poses are equal."""
    half_angle: float
    """The angle between axis and edge of the cone, above 0 and at most 80 degrees; or pi for a lamp
    that shines in all directions and casts no shadows [rad]."""
    softness: float = 0.2
    """The fraction of the half angle over which the light fades towards the edge, 0..1."""
    colour: Colour = (1.0, 1.0, 1.0)
    """The colour of the light, 0..1."""
    intensity: float = 1.0
    """The stored value of a white surface that faces the lamp at 1 m, without water [1]."""
    casts_shadow: bool = True
    """True if bodies in the lamp's light cast shadows."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "pose_bytes", self.world_from_lamp.matrix.tobytes())
        is_cone = 0.0 < self.half_angle <= MAX_HALF_ANGLE
        if not (is_cone or (self.half_angle == math.pi and not self.casts_shadow)):
            raise ValueError(f"the half angle {self.half_angle} is not in (0, 80 degrees]")
        if not (0.0 <= self.softness <= 1.0 and self.intensity >= 0.0):
            raise ValueError(
                f"the softness {self.softness} is not in 0..1, or the intensity {self.intensity} "
                "is negative"
            )

    @property
    def edge(self) -> tuple[float, float]:
        """The cosine at the cone's edge, and the factor that maps cosines from there to 0..1."""
        outer_cosine = math.cos(self.half_angle)
        inner_cosine = math.cos((1.0 - self.softness) * self.half_angle)
        return outer_cosine, 1.0 / max(inner_cosine - outer_cosine, 1e-5)

    def light(self, points: Array, normals: Array, attenuation: Colour) -> Array:
        """Apply the formula above in numpy, without shadows: the reference for the shader.

        Args:
            points: points on surfaces in W, (n, 3) [m].
            normals: the unit normals of the surfaces in W, (n, 3).
            attenuation: the water's attenuation of red, green and blue [1/m].

        Returns:
            The light that the lamp adds to white surfaces, in stored values, (n, 3).
        """
        to_lamp = self.world_from_lamp.position - points
        distance = np.maximum(
            np.linalg.norm(to_lamp, axis=1, keepdims=True), MIN_DISTANCE
        )  # (n, 1)
        incidence_cosine = np.maximum(
            (normals * to_lamp).sum(axis=1, keepdims=True) / distance, 0.0
        )
        cosine = product(to_lamp, self.world_from_lamp.rotation[:, 2:]) / distance
        outer_cosine, steepness = self.edge
        cone_position = np.clip((cosine - outer_cosine) * steepness, 0.0, 1.0)
        cone = cone_position * cone_position * (3.0 - 2.0 * cone_position)
        transmission = exp(-np.asarray(attenuation) * distance)
        light: Array = (
            np.asarray(self.colour)
            * (self.intensity * incidence_cosine * cone / distance**2)
            * transmission
        )
        return light
