"""Chain: links along a catenary."""

from __future__ import annotations

import math

import numpy as np

from ..parts import Part
from ..shapes import Shape, rotation_to, tube
from .steel import Coat, weathered_steel

SPAN, DROP, BAR = 8.0, 3.0, 0.04
"""The span and drop of the chain from a mooring to the bottom, and the thickness of a bar [m]."""
INNER_LENGTH, WIDTH = 4.0, 3.4
"""The pitch and the width of a link, in thicknesses of its bar, as of stud-less chain."""


def chain() -> tuple[Part, ...]:
    """Return a mooring chain from the origin down to the sea floor at x = 8 m, z = -3 m."""
    steel = weathered_steel(
        "chain", Coat(paint_share=0.1, growth=0.45, silt=0.2), size=192, metres=1.0
    )
    links = chain_links(np.zeros(3), np.array([SPAN, 0.0, -DROP]), sag=0.9, bar=BAR)
    return (steel.cover(*links, crease=2.0),)


def chain_links(start: np.ndarray, end: np.ndarray, *, sag: float, bar: float) -> list[Shape]:
    r"""Return links between two points, alternately upright and level.

    The middle line is a parabola, :math:`-4 f s (1 - s)` below the straight line at the share s,
    which is the catenary of a taut chain.

    Args:
        start: the first point, (3,) [m].
        end: the last point, (3,) [m].
        sag: the sag f at the middle [m].
        bar: the thickness of the bars [m].
    """
    shares = np.linspace(0.0, 1.0, 400)
    line = start + (end - start) * shares[:, None]
    line[:, 2] -= 4.0 * sag * shares * (1.0 - shares)
    steps = np.diff(line, axis=0)
    distance = np.concatenate([[0.0], np.cumsum(np.sqrt((steps * steps).sum(axis=1)))])
    pitch = INNER_LENGTH * bar
    n_links = int(distance[-1] / pitch)
    link = _link(bar)
    links = []
    for k in range(n_links):
        distances = tuple((k + shift) * pitch for shift in (0.0, 1.0))
        ends = [np.array([np.interp(d, distance, line[:, i]) for i in range(3)]) for d in distances]
        turn = rotation_to(ends[1] - ends[0])
        about_axis = (k % 2) * math.pi / 2.0 + 0.15 * math.sin(2.3 * k)
        cos, sin = math.cos(about_axis), math.sin(about_axis)
        spin = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
        middle = 0.5 * (ends[0] + ends[1])
        links.append(link.rotate(spin).rotate(turn).shift(*middle.tolist()))
    return links


def _link(bar: float) -> Shape:
    """Return a link about the origin, long along z."""
    half, radius = 0.5 * (INNER_LENGTH + 1.0) * bar, 0.5 * (WIDTH - 1.0) * bar
    straight = half - radius
    path = []
    for k in range(5):
        angle = math.pi * k / 4
        path.append((radius * math.cos(angle), 0.0, straight + radius * math.sin(angle)))
    for k in range(5):
        angle = math.pi + math.pi * k / 4
        path.append((radius * math.cos(angle), 0.0, -straight + radius * math.sin(angle)))
    return tube([*path, path[0]], 0.5 * bar, n=6, has_lids=False).scale_uv(0.3, 1.0)
