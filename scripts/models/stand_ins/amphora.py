"""An amphora standing upright: ``objects/amphora``; axis z, foot at z = 0.003 m."""

from __future__ import annotations

import math

import numpy as np

from uwsim.assets.mesh import Mesh, Texture
from uwsim.base.numerics.elementwise import power

from ..cached import cache_image
from ..shapes import Shape, lathe, mesh, tube
from ..textures import fill, mix, noise, smoothstep, to_texture

RADIUS, FOOT, TOP = 0.115, 0.003, 0.753
"""The widest radius, the lowest and the highest point [m]."""

OUTER_PROFILE = (
    (0.0, FOOT), (0.020, FOOT), (0.024, 0.030), (0.050, 0.10), (0.088, 0.22), (0.110, 0.34),
    (RADIUS, 0.42), (0.108, 0.50), (0.080, 0.57), (0.045, 0.61), (0.036, 0.65), (0.038, 0.71),
    (0.052, 0.735), (0.052, TOP),
)  # fmt: skip
"""The outer profile from foot to lip: radius, z [m]."""
INNER_PROFILE = ((0.040, TOP), (0.030, 0.72), (0.028, 0.66), (0.036, 0.615))


@cache_image
def _clay() -> Texture:
    """Return fired clay with turning marks and growth."""
    size = 256
    clouds = noise("amphora/clay", size, size, cells=3, octaves=6)
    rings = np.sin(np.arange(size, dtype=np.float32) * 0.9)[:, None] * np.float32(0.03)
    image = fill(size, size, (0.68, 0.42, 0.28)) * (1.0 + rings + 0.07 * clouds)[..., None]
    image = mix(image, (0.55, 0.56, 0.48), 0.8 * smoothstep(0.7, 1.9, clouds))
    return to_texture("amphora/clay", image)


def _handle(side: float) -> Shape:
    angle = np.linspace(0.0, math.pi, 9)
    x = side * (0.036 + 0.066 * power(np.sin(angle), 0.8))
    z = 0.615 + 0.05 * (1.0 - np.cos(angle))
    return tube(np.stack([x, np.zeros_like(x), z], axis=1), 0.0115, n=8)


def amphora() -> tuple[Mesh, ...]:
    """Return a body with an open neck, and two handles."""
    body = lathe([*OUTER_PROFILE, *INNER_PROFILE, (0.0, 0.610)], n=32)
    return (mesh(body, _handle(1.0), _handle(-1.0), texture=_clay()),)
