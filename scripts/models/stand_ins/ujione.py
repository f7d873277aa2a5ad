"""The UJI-One gripper: ``robot/UJIOne``. Base along z; jaws hinge about y at z = 0.197 m."""

from __future__ import annotations

from uwsim.assets.mesh import Mesh

from ..shapes import box, cylinder, mesh
from ..textures import worn_paint

HINGE_X, HINGE_Z = 0.03, 0.197
"""The hinges of the jaws in the base's frame, at +- x [m]."""


def gripper_base() -> tuple[Mesh, ...]:
    """Return a motor housing, and a fork for the two jaws."""
    housing = cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 0.15), 0.045, n=20, bevel=0.006)
    collar = cylinder((0.0, 0.0, 0.145), (0.0, 0.0, 0.165), 0.05, n=20)
    cheeks = [box((-0.042, y, 0.16), (0.042, y + 0.008, 0.21)) for y in (-0.034, 0.026)]
    pins = [
        cylinder((x, -0.036, HINGE_Z), (x, 0.036, HINGE_Z), 0.006, n=10)
        for x in (-HINGE_X, HINGE_X)
    ]
    metal = worn_paint("ujione/metal", (0.92, 0.92, 0.92), size=128)
    return (
        mesh(housing, colour=(0.16, 0.17, 0.18), texture=metal),
        mesh(collar, *cheeks, *pins, colour=(0.70, 0.72, 0.74), texture=metal),
    )


def inner_jaw() -> tuple[Mesh, ...]:
    """The jaw at x = -0.03 m."""
    return _jaw(1.0)


def outer_jaw() -> tuple[Mesh, ...]:
    """The jaw at x = +0.03 m."""
    return _jaw(-1.0)


def _jaw(side: float) -> tuple[Mesh, ...]:
    """Return a finger along z from its hinge; ``side`` is the sign of x towards the other jaw."""
    metal = worn_paint("ujione/metal", (0.92, 0.92, 0.92), size=128)
    hub = cylinder((0.0, -0.024, 0.0), (0.0, 0.024, 0.0), 0.012, n=14)
    root = box((-0.008, -0.020, 0.0), (0.008, 0.020, 0.07))
    low, high = sorted((-0.006 * side, 0.024 * side))
    tip = box((low, -0.022, 0.068), (high, 0.022, 0.12))
    return (mesh(hub, root, tip, colour=(0.74, 0.75, 0.77), texture=metal),)
