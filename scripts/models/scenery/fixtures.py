"""Fixtures that an arm works on: a valve's handle, its panel, a socket and its plug.

The z axis is up, and the axis of the hinge of the handle; lengths are in metres.
"""

from __future__ import annotations

import numpy as np

from ..parts import Part
from ..shapes import Shape, box, extrusion, join, mesh, quad, ring
from ..textures import Colour, worn_paint

BAR = (0.14, 0.016, 0.016)
"""The edges of the bar of the handle [m]."""
STEM = (0.016, 0.062)
"""The edge of the square stem of the handle, and the height of its end over the panel [m]."""
PANEL = (0.84, 0.70, 0.25)
"""The edges of the panel, which stands on its origin [m]."""
ARROW = ((-0.15, -0.10), (0.06, -0.10), (0.15, 0.0), (0.06, 0.10), (-0.15, 0.10))
"""The outline of the orange plate on the panel, which points along x [m]."""
SOCKET = (6.0, 0.16)
"""The outer edge of the socket in edges of its hole, and its height [m]."""
HOLE_DEPTH = 0.10
"""The depth of the square hole of the socket below the chamfer [m]; its edge is 1."""
CHAMFER = (0.24, 0.012)
"""The width of the chamfer around the hole, in edges of the hole, and its height [m]."""
PLUG = (0.050, 0.12)
"""The edge of the square plug, and its length below the flange [m]."""
STEEL: Colour = (0.62, 0.64, 0.66)
BLUE: Colour = (0.13, 0.24, 0.42)
YELLOW: Colour = (0.55, 0.53, 0.38)
ORANGE: Colour = (0.97, 0.42, 0.07)


def valve_handle() -> tuple[Part, ...]:
    """A T-shaped handle: a stem about z, and a bar along x on it, whose centre is at 0.07 m."""
    half = STEM[0] / 2.0
    x, y, z = (edge / 2.0 for edge in BAR)
    stem = box((-half, -half, 0.0), (half, half, STEM[1]))
    bar = box((-x, -y, STEM[1]), (x, y, STEM[1] + 2.0 * z))
    return _paint("stem", stem, STEEL), _paint("bar", bar, BLUE)


def valve_panel() -> tuple[Part, ...]:
    """A panel with its top at 0.25 m, an orange arrow on it, and a ring around each valve."""
    rings = [
        ring(0.05, 0.012, PANEL[2], PANEL[2] + 0.002, n=24).shift(a * 0.28, b * 0.22)
        for a in (-1.0, 1.0)
        for b in (-1.0, 1.0)
    ]
    return (*_panel_with_arrow(0.0, 0.0), _paint("rings", join(*rings), STEEL))


def socket_panel() -> tuple[Part, ...]:
    """The same panel for a socket at (0.22, -0.12), with its arrow beside it at (-0.2, 0.12)."""
    return _panel_with_arrow(-0.2, 0.12)


def socket() -> tuple[Part, ...]:
    """A block with a chamfered hole from above, whose edges are 1: its scale is their length."""
    half, hole, top = SOCKET[0] / 2.0, 0.5, SOCKET[1]
    chamfer, height = CHAMFER
    depth = top - height - HOLE_DEPTH
    edges = [(half, 0.0), (half, top), (hole + chamfer, top), (hole, top - height), (hole, depth)]
    sides = [
        quad(*_side(turn, edges[k], edges[k + 1]))
        for k in range(len(edges) - 1)
        for turn in range(4)
    ]
    floor = quad(
        (-hole, -hole, depth), (hole, -hole, depth), (hole, hole, depth), (-hole, hole, depth)
    )
    return (_paint("socket", join(*sides, floor), YELLOW),)


def plug() -> tuple[Part, ...]:
    """A square plug along z, its tip at 0.12 m, with a flange at its origin."""
    half = PLUG[0] / 2.0
    body = box((-half, -half, 0.0), (half, half, PLUG[1]))
    flange = box((-0.04, -0.04, -0.012), (0.04, 0.04, 0.0))
    return _paint("plug", body, ORANGE), _paint("flange", flange, STEEL)


def _panel_with_arrow(x: float, y: float) -> tuple[Part, Part]:
    """Return a panel and its arrow, whose middle is at a place on it."""
    half = (PANEL[0] / 2.0, PANEL[1] / 2.0)
    body = box((-half[0], -half[1], 0.0), (half[0], half[1], PANEL[2]))
    arrow = extrusion(np.array(ARROW), PANEL[2], PANEL[2] + 0.003).shift(x, y)
    return _paint("panel", body, YELLOW), _paint("arrow", arrow, ORANGE)


def _side(
    turn: int, low: tuple[float, float], high: tuple[float, float]
) -> list[tuple[float, float, float]]:
    """Return the corners of a face between two squares (half edge, height), seen from outside."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[turn]
    corners = [(low[0], -low[0], low[1]), (low[0], low[0], low[1])]
    corners += [(high[0], high[0], high[1]), (high[0], -high[0], high[1])]
    return [(c * x - s * y, s * x + c * y, z) for x, y, z in corners]


def _paint(name: str, shape: Shape, colour: Colour) -> Part:
    paint = worn_paint(f"fixtures/{name}", colour, size=64)
    return Part(mesh=mesh(shape.project_uv(0.3), texture=paint, crease=0.6))
