"""The Girona 500 AUV: ``robot/GIRONA500/g500_March11``.

Drawn in the vehicle's own frame (x forward, y starboard, z down, origin at base_link of the UWSim
robot) and then brought into the mesh frame (y up), so that the robot file's visual origin
``rpy (-pi/2, 0, pi), xyz (-0.2, 0, 0.75)`` puts it back.
Layout after Ribas et al., IEEE/ASME T-Mech 17(1), 2012: three hulls of 1.507 x 0.306 m on a frame,
two surge, two heave and one sway thruster. Nothing hangs lower than z = 0.91 m, so that the
cameras beside the arm (z = 0.95 m) look past the vehicle.
"""

from __future__ import annotations

import math

import numpy as np

from ..mesh import Mesh, Texture
from .shapes import Shape, cylinder, facing, join, lathe, mesh, ring, rounded_box, tube
from .textures import finished, mixed, noise, plain, step, worn, write

HULL_LENGTH, HULL_RADIUS = 1.507, 0.153
"""One torpedo hull [m]."""
LOWER_HULL = (-0.049, 0.0, 0.745)
"""Centre of the battery hull in base_link [m]."""
UPPER_HULL = (-0.049, 0.35, 0.045)
"""Centre of the starboard flotation hull in base_link; port is its mirror image [m]."""
YELLOW, DARK, ALUMINIUM = (0.97, 0.72, 0.07), (0.11, 0.12, 0.13), (0.72, 0.74, 0.76)

ORIGIN = (-0.2, 0.0, 0.75)
"""Where the mesh's origin stands in base_link [m], turned by rpy (-pi/2, 0, pi)."""


def into_mesh_frame(shape: Shape) -> Shape:
    """From base_link (x forward, y starboard, z down) into the mesh frame (y up)."""
    x, y, z = ORIGIN
    base_from_mesh = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]])
    return shape.moved(-x, -y, -z).turned(base_from_mesh.T)


def _hull_texture() -> Texture:
    """Round the hull (u, from starboard downwards) and from tail (bottom) to nose (top)."""
    name, height, width = "girona500/hull", 768, 512
    clouds = noise(name, height, width, cells=3, octaves=6)
    picture = plain(height, width, YELLOW)
    picture[round(0.26 * height) : round(0.74 * height)] = DARK
    for edge in (0.255, 0.74):
        picture[round(edge * height) : round((edge + 0.012) * height)] = (0.92, 0.92, 0.90)
    white = (0.94, 0.94, 0.92)
    starboard, port = picture.copy(), picture
    write(starboard, "GIRONA 500", (0.5, 0.50), height=0.34, width=0.13, colour=white,
          quarter_turns=1)  # fmt: skip
    write(port, "GIRONA 500", (0.5, 0.50), height=0.34, width=0.13, colour=white, quarter_turns=3)
    half = width // 2
    picture = np.concatenate([starboard[:, half:], starboard[:, :half]], axis=1)
    quarter = width // 4
    picture[:, quarter : 3 * quarter] = port[:, quarter : 3 * quarter]
    for seam in (0.14, 0.255, 0.5, 0.74, 0.88):  # joints of the shells, with bolts
        row = round(seam * height)
        picture[row : row + 2] *= 0.45
        for k in range(16):
            column = round((k + 0.5) * width / 16)
            picture[row + 7 : row + 10, column - 1 : column + 2] *= 0.5
    picture = mixed(picture, (0.55, 0.52, 0.44), 0.35 * step(1.2, 2.6, clouds))
    return finished(name, picture * (1.0 + 0.035 * clouds)[..., None])


def _hull() -> Shape:
    """A torpedo along x, centred: elliptic nose, long cylinder, tapered tail."""
    radius, half = HULL_RADIUS, HULL_LENGTH / 2
    tail = [(0.0, -half), (0.045, -half), (0.085, -half + 0.07), (0.122, -half + 0.16),
            (0.145, -half + 0.26), (radius, -half + 0.36)]  # fmt: skip
    a = np.linspace(0.0, math.pi / 2, 7)
    nose = [(radius * math.cos(t), half - 0.19 + 0.19 * math.sin(t)) for t in a]
    nose[-1] = (0.0, half)
    shape = lathe([*tail, (radius, 0.0), *nose], n=28)
    return shape.turned(facing(np.array([1.0, 0.0, 0.0])))


def _thruster(at: tuple[float, float, float], way: tuple[float, float, float]) -> list[Shape]:
    """A ducted propeller: duct, motor pod, blades, brackets; the dark and the bright parts."""
    duct = lathe(
        [(0.082, -0.045), (0.098, -0.05), (0.104, -0.03), (0.100, 0.03), (0.092, 0.055),
         (0.084, 0.05), (0.080, 0.0), (0.082, -0.045)], n=24)  # fmt: skip
    pod = lathe([(0.0, -0.16), (0.028, -0.155), (0.036, -0.13), (0.036, -0.02), (0.030, 0.0),
                 (0.030, 0.025), (0.018, 0.05), (0.0, 0.056)], n=14)  # fmt: skip
    blades = []
    for k in range(4):
        turn = k * math.pi / 2
        blade = rounded_box((0.02, -0.02, -0.003), (0.078, 0.02, 0.003), radius=0.0028, n=1)
        c, s = math.cos(0.6), math.sin(0.6)
        pitched = blade.turned(np.array([[1, 0, 0], [0, c, -s], [0, s, c]]))
        c, s = math.cos(turn), math.sin(turn)
        blades.append(pitched.turned(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])).moved(z=0.015))
    struts = [
        cylinder((0.03 * math.cos(a), 0.03 * math.sin(a), -0.035),
                 (0.09 * math.cos(a), 0.09 * math.sin(a), -0.035), 0.006, n=6)
        for a in (0.4, 0.4 + 2 * math.pi / 3, 0.4 + 4 * math.pi / 3)
    ]  # fmt: skip
    place = facing(np.array(way))
    return [
        join(duct, pod).turned(place).moved(*at),
        join(*blades, *struts).turned(place).moved(*at),
    ]


def _frame() -> list[Shape]:
    """The aluminium frame: three ribs that carry the hulls, rails between them."""
    parts = []
    for x in (-0.50, -0.05, 0.38):
        for side in (-1.0, 1.0):
            parts.append(
                tube([(x, side * 0.33, 0.15), (x, side * 0.29, 0.34), (x, side * 0.12, 0.64)],
                     0.016, n=8)
            )  # fmt: skip
            parts.append(tube([(x, side * 0.30, 0.32), (x, 0.0, 0.32)], 0.014, n=8))
        parts.append(tube([(x, -0.22, 0.06), (x, 0.22, 0.06)], 0.016, n=8))
        parts.append(tube([(x, 0.0, 0.05), (x, 0.0, 0.61)], 0.012, n=8))
        collar = ring(HULL_RADIUS + 0.010, HULL_RADIUS - 0.004, -0.02, 0.02, n=28)
        collar = collar.turned(facing(np.array([1.0, 0.0, 0.0])))
        for cx, cy, cz in _hull_centres():
            del cx
            parts.append(collar.moved(x, cy, cz))
    for side in (-1.0, 1.0):
        parts.append(tube([(-0.50, side * 0.29, 0.33), (0.38, side * 0.29, 0.33)], 0.014, n=8))
        parts.append(tube([(-0.50, side * 0.13, 0.62), (0.38, side * 0.13, 0.62)], 0.012, n=8))
    return parts


def _hull_centres() -> list[tuple[float, float, float]]:
    x, y, z = UPPER_HULL
    return [(x, y, z), (x, -y, z), LOWER_HULL]


def girona500() -> tuple[Mesh, ...]:
    """The whole vehicle without its arm."""
    hulls = [_hull().moved(*centre) for centre in _hull_centres()]
    thrusters = [
        _thruster((-0.30, 0.40, 0.38), (-1.0, 0.0, 0.0)),  # surge, starboard
        _thruster((-0.30, -0.40, 0.38), (-1.0, 0.0, 0.0)),  # surge, port
        _thruster((0.28, 0.0, 0.10), (0.0, 0.0, -1.0)),  # heave, bow
        _thruster((-0.42, 0.0, 0.10), (0.0, 0.0, -1.0)),  # heave, stern
        _thruster((0.02, 0.0, 0.44), (0.0, 1.0, 0.0)),  # sway
    ]
    arms = [
        tube([(-0.30, side * 0.29, 0.34), (-0.30, side * 0.33, 0.36)], 0.02, n=8)
        for side in (-1.0, 1.0)
    ]
    instruments = [
        cylinder((-0.75, 0.0, 0.44), (-0.56, 0.0, 0.44), 0.075, n=20, bevel=0.012),  # DVL housing
        cylinder((0.30, 0.10, 0.48), (0.52, 0.10, 0.48), 0.055, n=18, bevel=0.01),  # sonar
        cylinder((-0.45, 0.12, 0.47), (-0.12, 0.12, 0.47), 0.06, n=18, bevel=0.01),  # computer
        rounded_box((-0.42, -0.17, 0.42), (-0.12, -0.06, 0.53), radius=0.015, n=2),  # battery pack
    ]
    saddle = rounded_box((-0.16, -0.06, 0.86), (0.36, 0.06, 0.905), radius=0.012, n=2)
    mast = [
        cylinder((-0.45, 0.0, 0.06), (-0.45, 0.0, -0.20), 0.012, n=10),
        cylinder((-0.45, 0.0, -0.20), (-0.45, 0.0, -0.25), 0.035, n=16, bevel=0.008),
    ]
    lens = cylinder((0.48, -0.10, 0.47), (0.60, -0.10, 0.47), 0.045, n=18, bevel=0.008)
    dark = [*(t[0] for t in thrusters), *instruments, lens]
    bright = [*_frame(), *(t[1] for t in thrusters), *arms, saddle, *mast]
    return (
        mesh(*(into_mesh_frame(hull) for hull in hulls), texture=_hull_texture()),
        mesh(*(into_mesh_frame(part) for part in dark), texture=worn("girona500/dark", DARK)),
        mesh(
            *(into_mesh_frame(part).projected(0.4) for part in bright),
            texture=worn("girona500/aluminium", ALUMINIUM),
        ),
    )
