"""Parts of vehicles with smooth surfaces: thrusters and paint."""

from __future__ import annotations

import math

import numpy as np

from uwsim.base.geometry import rotation_z
from uwsim.base.numerics.linear import product

from ..cached import cache_image
from ..shapes import Shape, join, lathe, rotation_to, surface
from ..surfaces import Material, make_material
from ..textures import Colour, noise, smoothstep

PROJECTION = np.array([[0.8, 0.5, 0.4], [-0.45, 0.75, -0.6]])
"""The directions of the axes of a texture that is oblique to all faces of a vehicle, (2, 3)."""


def project_obliquely(shape: Shape, metres: float) -> Shape:
    """Return a shape with an image every ``metres``, in one projection, which has no seams.

    The image of paint has no direction, so that stretching is not seen.
    """
    return Shape(shape.corners, product(shape.corners, PROJECTION.T) / metres)


def make_thruster(radius: float) -> tuple[Shape, Shape]:
    """Return duct and motor, then propeller and struts, of a ducted propeller along z.

    Args:
        radius: the outer radius of the duct [m].
    """
    r = radius
    duct = lathe(
        [(0.84 * r, -0.42 * r), (0.90 * r, -0.47 * r), (0.97 * r, -0.45 * r), (1.0 * r, -0.36 * r),
         (0.95 * r, 0.44 * r), (0.91 * r, 0.48 * r), (0.86 * r, 0.44 * r), (0.82 * r, 0.1 * r),
         (0.84 * r, -0.42 * r)], n=22)  # fmt: skip
    angles = np.linspace(0.0, math.pi / 2.0, 4)
    nose = [(0.30 * r * math.cos(a), 0.30 * r + 0.3 * r * math.sin(a)) for a in angles.tolist()]
    tail = [(0.24 * r * math.sin(a), -1.3 * r - 0.1 * r * math.cos(a)) for a in angles.tolist()]
    motor = lathe([*tail, (0.30 * r, -0.5 * r), *nose[:-1], (0.0, 0.6 * r)], n=14)
    parts = []
    for k in range(3):
        turn = rotation_z(k * 2.0 * math.pi / 3.0)
        parts += [part.rotate(turn) for part in (*_blade(r), *_strut(r))]
    return join(duct, motor), join(*parts)


def _blade(r: float) -> list[Shape]:
    shares = np.linspace(0.0, 1.0, 5)[:, None]
    chord = np.linspace(-1.0, 1.0, 4)[None, :]
    radii = r * (0.26 + 0.54 * shares)
    half_chord = r * (0.17 + 0.16 * np.sin(math.pi * shares * 0.8))
    pitch = 1.0 - 0.55 * shares
    y = half_chord * chord + np.zeros_like(radii)
    z = half_chord * chord * pitch * 0.9 + 0.12 * r
    face = surface(np.stack([radii + np.zeros_like(y), y, z + np.zeros_like(y)], axis=2))
    return [face, face.flip().shift(z=-0.03 * r)]


def _strut(r: float) -> list[Shape]:
    x, z = np.array([0.28 * r, 0.9 * r]), np.array([-0.42 * r, -0.3 * r])
    points = np.zeros((2, 2, 3))
    points[..., 0], points[..., 2] = x[None, :], z[:, None]
    turn = rotation_z(0.5)
    face = surface(points).rotate(turn)
    return [face, face.flip()]


def place_thruster(
    shapes: tuple[Shape, Shape],
    centre: tuple[float, float, float],
    axis: tuple[float, float, float],
) -> tuple[Shape, Shape]:
    """Return the shapes of a thruster at its place, along an axis."""
    turn = rotation_to(np.array(axis))
    first, second = (shape.rotate(turn).shift(*centre) for shape in shapes)
    return first, second


@cache_image
def make_paint(name: str, colour: Colour, roughness: float, *, metallic: float = 0.0) -> Material:
    """Return a used surface of one colour, with faint clouds and scratches, 0.4 m an image."""
    size = 128
    clouds = noise(f"paint/{name}", size, size, cells=3, octaves=5)
    scratches = noise(f"paint/{name}/scratches", size, size, cells=40, octaves=2)
    image = np.array(colour, dtype=np.float32) * np.ones((size, size, 1), np.float32)
    image *= (1.0 + 0.05 * clouds + 0.03 * scratches)[..., None]
    roughness_map = np.clip(
        roughness + 0.06 * clouds + 0.1 * smoothstep(1.0, 2.0, scratches), 0.05, 1.0
    )
    pixel = 0.4 / size
    height = 0.00004 * clouds
    return make_material(
        f"paint/{name}", image, height, roughness_map, pixel=(pixel, pixel), metallic=metallic,
        occlusion_depth=0.01,
    )  # fmt: skip
