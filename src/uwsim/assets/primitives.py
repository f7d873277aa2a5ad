"""Geometric primitives of URDF: box, cylinder and sphere."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from ..errors import AssetError
from .mesh import Model
from .procedural.shapes import box, cylinder, lathe, mesh, sphere

N_NUMBERS = {"box": 3, "cylinder": 2, "sphere": 1}
"""The number of sizes of each kind."""
N_SIDES, N_ROUND = 10, 2
"""The numbers of sides, and of rings of each end, of a `rounded_cylinder`."""


def primitive(
    kind: str, size: tuple[float, ...], colour: tuple[float, ...] = (0.7, 0.7, 0.7)
) -> Model:
    """Return a box, cylinder (about z) or sphere, centred on the origin.

    Args:
        kind: ``box``, ``cylinder`` or ``sphere``.
        size: Edges x, y, z; or radius and length; or radius [m].
        colour: Red, green, blue, 0..1; a fourth number (opacity) is not used.

    Raises:
        AssetError: The kind is another, sizes are missing, or a size is not positive.
    """
    if kind not in N_NUMBERS:
        raise AssetError(f"{kind!r} is not a shape; expected one of {', '.join(N_NUMBERS)}.")
    numbers = tuple(float(number) for number in size[: N_NUMBERS[kind]])
    if len(numbers) < N_NUMBERS[kind] or not all(0.0 < number < 1e6 for number in numbers):
        raise AssetError(
            f"A {kind} of size {size}: expected {N_NUMBERS[kind]} positive numbers [m]."
        )
    red, green, blue = (float(part) for part in colour[:3])
    return _make_primitive(kind, numbers, (red, green, blue))


@cache
def rounded_cylinder(radius: float, length: float, colour: tuple[float, float, float]) -> Model:
    """Return a thin cylinder about z with hemispheres at its ends, centred on the origin.

    Args:
        radius: the radius [m].
        length: the distance between the centres of the hemispheres [m].
        colour: red, green, blue, 0..1.
    """
    angles = np.linspace(0.0, math.pi / 2.0, N_ROUND + 1)
    rim = radius * np.cos(angles)
    rim[-1] = 0.0  # the poles
    rise = 0.5 * length + radius * np.sin(angles)
    profile = np.concatenate([np.stack([rim, -rise], axis=1)[::-1], np.stack([rim, rise], axis=1)])
    shape = lathe(profile, n=N_SIDES)
    return Model(name="cylinder", meshes=(mesh(shape, colour=colour),), source="stand-in")


@cache
def _make_primitive(
    kind: str, size: tuple[float, ...], colour: tuple[float, float, float]
) -> Model:
    if kind == "box":
        x, y, z = (edge / 2 for edge in size)
        shape = box((-x, -y, -z), (x, y, z))
    elif kind == "cylinder":
        radius, length = size
        shape = cylinder((0.0, 0.0, -length / 2), (0.0, 0.0, length / 2), radius, n=24)
    else:
        shape = sphere(size[0], n=24)
    return Model(name=kind, meshes=(mesh(shape, colour=colour),), source="stand-in")
