"""Plain solids of known size about the origin (``objects/box`` ...), and a flat floor."""

from __future__ import annotations

from uwsim.assets.mesh import Mesh

from ..shapes import Shape, capsule, cylinder, mesh, quad, rounded_box, sphere, torus
from ..textures import cement, worn_paint

HALF = 0.5
"""The half of the width, depth and height of every solid but the torus [m]."""
REACH, TILE = 15.0, 3.0
"""The half side of the floor, and the side of one image on it [m]."""


def box() -> tuple[Mesh, ...]:
    """A box of 1 m."""
    half = (HALF, HALF, HALF)
    shape = rounded_box((-HALF, -HALF, -HALF), half, radius=0.02)
    return _solid("box", shape, (0.80, 0.22, 0.14))


def ball() -> tuple[Mesh, ...]:
    """A sphere of 1 m diameter."""
    return _solid("sphere", sphere(HALF, n=48), (0.92, 0.68, 0.12))


def upright_cylinder() -> tuple[Mesh, ...]:
    """A cylinder about z of 1 m diameter and height."""
    shape = cylinder((0.0, 0.0, -HALF), (0.0, 0.0, HALF), HALF, n=48)
    return _solid("cylinder", shape, (0.16, 0.42, 0.74))


def cone() -> tuple[Mesh, ...]:
    """A cone about z of 1 m diameter and height, its tip up."""
    shape = cylinder((0.0, 0.0, -HALF), (0.0, 0.0, HALF), HALF, n=48, top=0.0)
    return _solid("cone", shape, (0.86, 0.42, 0.10))


def rod() -> tuple[Mesh, ...]:
    """A capsule about z, 1 m high, of 0.5 m diameter."""
    return _solid("capsule", capsule(0.25, -HALF, HALF, n=32), (0.24, 0.58, 0.30))


def wide_ring() -> tuple[Mesh, ...]:
    """A ring about z of 1 m outer diameter, 0.25 m high."""
    return _solid("ring", torus(0.375, 0.125, n=48, m=20), (0.52, 0.26, 0.60))


def floor() -> tuple[Mesh, ...]:
    """A level floor of concrete tiles through the origin, 30 x 30 m."""
    n = 2.0 * REACH / TILE
    corners = [
        (-REACH, -REACH, 0.0),
        (REACH, -REACH, 0.0),
        (REACH, REACH, 0.0),
        (-REACH, REACH, 0.0),
    ]
    shape = quad(*corners, uv=(0.0, 0.0, n, n), cuts=(10, 10))
    return (mesh(shape, texture=cement("floor/tiles", (0.60, 0.62, 0.60), joints=3)),)


def _solid(name: str, shape: Shape, colour: tuple[float, float, float]) -> tuple[Mesh, ...]:
    return (mesh(shape.project_uv(1.0), texture=worn_paint(f"solids/{name}", colour), crease=0.6),)
