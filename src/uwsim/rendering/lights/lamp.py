r"""A lamp: a cone of light that a vehicle carries, dimmed by the water on its way.

On a surface of colour :math:`L_c` at the distance :math:`d` from the lamp, on stored values (no
gamma) and before the water between surface and camera (`water`), it adds

.. math::
    L_c\,k_c\,I\,\frac{\max(N \cdot L, 0)}{d^2}\,s(\theta)\,e^{-a_c d}\,v

with the lamp's colour :math:`k` and intensity :math:`I`, the direction :math:`L` to the lamp,
the water's attenuation :math:`a` along the way from the lamp to the surface, the cone
:math:`s(\theta)` and :math:`v`, 0 in shadow. Nearer than 1 cm counts as
1 cm. The light rate of the scene and the sun have no part in it. Not modelled: backscatter of the
lamp's own light into the camera, light that is scattered or reflected on its way,
a loss of the lamp's light to the fog (which is a law of the camera's path alone), glints, and the
lamp itself as something bright to be seen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import exp
from ...base.numerics.linear import product
from ..water import Colour

MAX_HALF_ANGLE = math.radians(80.0)
"""Greatest half angle: a wider cone does not fit one shadow map [rad]."""

MIN_DISTANCE = 0.01
"""Smaller distances to the lamp are taken as this one [m]."""


@dataclass(frozen=True, kw_only=True)
class Lamp:
    """A round cone of light from a point; it shines along -z, as cameras look.

    Raises:
        ValueError: a number is outside its bounds.
    """

    world_from_lamp: Pose
    """Where it is; the axes of a camera."""
    half_angle: float
    """Between the axis and the edge of the cone, above 0, at most 80 degrees; pi: it shines in
    all directions, and nothing casts a shadow [rad]."""
    softness: float = 0.2
    """Share of the half angle over which the light fades towards the edge, 0..1."""
    colour: Colour = (1.0, 1.0, 1.0)
    """Of its light, 0..1."""
    intensity: float = 1.0
    """Stored value that it gives to a white surface facing it at 1 m, without water [1]."""
    casts_shadow: bool = True
    """Whether bodies in its light cast a shadow."""

    def __post_init__(self) -> None:
        is_cone = 0.0 < self.half_angle <= MAX_HALF_ANGLE
        if not (is_cone or (self.half_angle == math.pi and not self.casts_shadow)):
            raise ValueError(f"the half angle {self.half_angle} is not in (0, 80 degrees]")
        if not (0.0 <= self.softness <= 1.0 and self.intensity >= 0.0):
            raise ValueError(f"softness {self.softness} or intensity {self.intensity} is no such")

    @property
    def edge(self) -> tuple[float, float]:
        """Cosine at the edge of the cone, and the factor that maps cosines beyond it to 0..1."""
        outer = math.cos(self.half_angle)
        inner = math.cos((1.0 - self.softness) * self.half_angle)
        return outer, 1.0 / max(inner - outer, 1e-5)

    def light(self, points: Array, normals: Array, attenuation: Colour) -> Array:
        """The law above in numpy, without shadows: the reference for the shader.

        Args:
            points: On surfaces, in W, (n, 3) [m].
            normals: Of the surfaces, of unit length, (n, 3).
            attenuation: Of red, green and blue [1/m].

        Returns:
            What white surfaces give, (n, 3).
        """
        towards = self.world_from_lamp.position - points
        distance = np.maximum(
            np.linalg.norm(towards, axis=1, keepdims=True), MIN_DISTANCE
        )  # (n, 1)
        facing = np.maximum((normals * towards).sum(axis=1, keepdims=True) / distance, 0.0)
        cosine = product(towards, self.world_from_lamp.rotation[:, 2:]) / distance
        outer, steepness = self.edge
        within = np.clip((cosine - outer) * steepness, 0.0, 1.0)
        cone = within * within * (3.0 - 2.0 * within)
        left = exp(-np.asarray(attenuation) * distance)
        light: Array = (
            np.asarray(self.colour) * (self.intensity * facing * cone / distance**2) * left
        )
        return light
