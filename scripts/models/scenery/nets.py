"""Nets: ``objects/net``, a lost net that hangs from its head line, and ``objects/cage_panel``.

Twines are triangular bars through the knots, which are octahedra.
"""

from __future__ import annotations

import numpy as np

from uwsim.base.geometry import Array

from ..fields import noise3
from ..parts import Part
from ..shapes import Shape, sphere, tube
from ..surfaces import Material, make_material
from ..textures import Colour, noise, smoothstep

MESH, TWINE, KNOT = 0.17, 0.004, 0.011
"""The side of a mesh, and the radii of twine and knots [m]."""
NET_SIZE, PANEL_SIZE = (3.4, 2.4), 3.0
"""The width and height of the net, and the side of the panel [m]."""
ROPE = 0.016
"""The radius of the ropes at the edges [m]."""


def net() -> tuple[Part, ...]:
    """Return a net of diamonds in the x-z plane, below its head line at z = 0, with floats."""
    n = int(NET_SIZE[0] / MESH / 1.4)
    m = int(NET_SIZE[1] / MESH / 1.4)
    lines = []
    for direction in (1, -1):
        for start in range(-m, n + m + 1):
            cells = [(start + direction * k, k) for k in range(m + 1)]
            cells_inside = [(i, k) for i, k in cells if 0 <= i <= n]
            if len(cells_inside) > 1:
                lines.append(np.array([_hang(i / n, k / m) for i, k in cells_inside]))
    knots = np.array([_hang(i / n, k / m) for i in range(n + 1) for k in range(m + 1)])
    head = np.array([_hang(s, 0.0) for s in np.linspace(0.0, 1.0, 24)])
    foot = np.array([_hang(s, 1.0) for s in np.linspace(0.0, 1.0, 40)])
    floats = [
        sphere(0.06, n=14).scale(1.5, 1.0, 1.0).shift(*_hang(s, 0.0).tolist())
        for s in np.linspace(0.04, 0.96, 7).tolist()
    ]
    twine = _twine("net", (0.16, 0.25, 0.22))
    return (
        twine.cover(*_make_netting(lines, knots), crease=2.0, two_sided=True),
        twine.cover(tube(head, ROPE, n=8), tube(foot, ROPE, n=8), crease=2.0),
        _twine("float", (0.55, 0.27, 0.10)).cover(*floats, crease=2.0),
    )


def cage_panel() -> tuple[Part, ...]:
    """Return a panel of a fish cage in the x-z plane, z from -3 m to 0, with ropes at its edges."""
    n = int(PANEL_SIZE / MESH)
    shares = np.linspace(0.0, 1.0, n + 1)
    grid = np.array([[_bulge(s, t) for s in shares] for t in shares])
    lines = [*grid, *grid.transpose(1, 0, 2)]
    frame = [tube(grid[k], ROPE, n=8) for k in (0, -1)]
    frame += [tube(grid[:, k], ROPE, n=8) for k in (0, n // 2, -1)]
    twine = _twine("cage", (0.10, 0.11, 0.10))
    return (
        twine.cover(*_make_netting(lines, grid.reshape(-1, 3)), crease=2.0, two_sided=True),
        twine.cover(*frame, crease=2.0),
    )


def _hang(s: float, t: float) -> Array:
    """Return a point of the net at shares of its width and height: folds grow downwards [m]."""
    x, z = NET_SIZE[0] * (s - 0.5), -NET_SIZE[1] * t
    sag = 0.16 * 4.0 * s * (1.0 - s)
    place = np.array([[x, 0.3 * t, 0.5 * z]], dtype=np.float32)
    fold = float(noise3("net/folds", place, 0.8, octaves=3)[0])
    ripple = float(noise3("net/ripple", place, 0.35, octaves=2)[0])
    drawn_x = x * (1.0 - 0.16 * t) + 0.05 * ripple * t
    return np.array([drawn_x, (0.03 + 0.20 * t) * fold, z - sag + 0.06 * t * ripple])


def _bulge(s: float, t: float) -> Array:
    """Return a point of the panel, which the current bulges [m]."""
    x, z = PANEL_SIZE * (s - 0.5), -PANEL_SIZE * t
    place = np.array([[x, 0.0, z]], dtype=np.float32)
    fold = float(noise3("cage/folds", place, 0.9, octaves=3)[0])
    bulge = 16.0 * s * (1.0 - s) * t * (1.0 - t)
    return np.array([x, 0.22 * bulge + 0.025 * fold, z + 0.01 * fold])


def _make_netting(lines: list[Array], knots: Array) -> list[Shape]:
    corners = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (1, 0, 0)]
    fans = [
        (corners[k + (tip < 0)], corners[k + (tip > 0)], (0, 0, tip))
        for k in range(4)
        for tip in (1, -1)
    ]
    octahedron = Shape(KNOT * np.array(fans, dtype=np.float64), np.zeros((8, 3, 2)))
    octahedron = octahedron.project_uv(0.1)
    return [
        *(tube(line, TWINE, n=3, has_lids=False) for line in lines),
        *(octahedron.shift(*knot.tolist()) for knot in knots),
    ]


def _twine(name: str, colour: Colour) -> Material:
    size = 128
    patches = noise(f"nets/{name}", size, size, cells=3, octaves=5)
    lay = noise(f"nets/{name}/lay", size, size, cells=20, octaves=2)
    image = np.array(colour, dtype=np.float32) * np.ones((size, size, 1), np.float32)
    image *= (1.0 + 0.16 * lay + 0.12 * patches)[..., None]
    turf = smoothstep(0.2, 1.3, patches)[..., None]
    image = image + (np.array((0.22, 0.21, 0.14), dtype=np.float32) - image) * 0.8 * turf
    height = 0.0008 * lay + 0.001 * turf[..., 0]
    return make_material(f"nets/{name}", image, height, 0.9, pixel=(0.003, 0.003))
