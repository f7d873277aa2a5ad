"""The Girona 500 AUV: ``robot/GIRONA500/g500_March11``.

Modelled in the vehicle's frame (x forward, y starboard, z down, origin at base_link of the UWSim
robot) and then transformed to the mesh frame (y up), of which the inverse is the robot file's
visual origin ``rpy (-pi/2, 0, pi), xyz (-0.2, 0, 0.75)``.
Layout after Ribas et al., IEEE/ASME T-Mech 17(1), 2012: three hulls of 1.507 x 0.306 m on a frame,
two surge, two heave and one sway thruster. No part is below z = 0.91 m, so that the cameras beside
the arm (z = 0.95 m) have a free view.
"""

from __future__ import annotations

import math

import numpy as np

from uwsim.assets.mesh import Mesh, Texture
from uwsim.base.geometry import rotation_z
from uwsim.base.numerics.linear import product

from ..shapes import Shape, cylinder, join, lathe, mesh, quad, rotation_to, rounded_box, tube
from ..textures import fill, mix, noise, paint_text, smoothstep, to_texture, worn_paint

HULL_LENGTH, HULL_RADIUS = 1.507, 0.153
"""The length and the radius of one hull [m]."""
LOWER_HULL = (-0.049, 0.0, 0.745)
"""The centre of the battery hull in base_link [m]."""
UPPER_HULL = (-0.049, 0.35, 0.045)
"""The centre of the starboard flotation hull in base_link; port is its mirror image [m]."""
HULLS = (UPPER_HULL, (UPPER_HULL[0], -UPPER_HULL[1], UPPER_HULL[2]), LOWER_HULL)
RIBS = (-0.42, -0.05, 0.38)
"""The positions of the frame's ribs along x in base_link [m]."""
YELLOW, BLACK, ALUMINIUM = (0.97, 0.70, 0.06), (0.16, 0.17, 0.19), (0.78, 0.80, 0.82)

ORIGIN = (-0.2, 0.0, 0.75)
"""The mesh's origin in base_link [m]; its axes have the rpy (-pi/2, 0, pi)."""


def to_mesh_frame(shape: Shape) -> Shape:
    """Transform base_link (x forward, y starboard, z down) to the mesh frame (y up)."""
    x, y, z = ORIGIN
    base_from_mesh = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]])
    return shape.shift(-x, -y, -z).rotate(base_from_mesh.T)


def hull_texture() -> Texture:
    """Return the image round the hull (u, from starboard down) and from tail (bottom) to nose."""
    name, height, width = "girona500/hull", 640, 384
    clouds = noise(name, height, width, cells=3, octaves=6)
    image = fill(height, width, YELLOW)
    image[round(0.24 * height) : round(0.75 * height)] = (0.22, 0.23, 0.25)
    for edge in (0.228, 0.75):
        image[round(edge * height) : round((edge + 0.012) * height)] = (0.92, 0.92, 0.90)
    white = (0.94, 0.94, 0.92)
    starboard, port = image.copy(), image
    paint_text(starboard, "GIRONA 500", (0.5, 0.50), height=0.36, width=0.14, colour=white,
          quarter_turns=1)  # fmt: skip
    paint_text(
        port, "GIRONA 500", (0.5, 0.50), height=0.36, width=0.14, colour=white, quarter_turns=3
    )
    half, quarter = width // 2, width // 4
    image = np.concatenate([starboard[:, half:], starboard[:, :half]], axis=1)
    image[:, quarter : 3 * quarter] = port[:, quarter : 3 * quarter]
    for seam in (0.12, 0.24, 0.75, 0.88):  # joints of the shells, with bolts
        row = round(seam * height)
        image[row : row + 2] *= 0.45
        for k in range(16):
            column = round((k + 0.5) * width / 16)
            image[row + 6 : row + 9, column - 1 : column + 2] *= 0.5
    image = mix(image, (0.55, 0.52, 0.44), 0.30 * smoothstep(1.2, 2.6, clouds))
    return to_texture(name, image * (1.0 + 0.035 * clouds)[..., None])


def _hull() -> Shape:
    """Return a hull along x, centred: elliptic nose, long cylinder, tapered tail."""
    radius, half = HULL_RADIUS, HULL_LENGTH / 2
    tail = [(0.0, -half), (0.045, -half), (0.098, -half + 0.09), (0.138, -half + 0.21),
            (radius, -half + 0.36)]  # fmt: skip
    nose = [(radius * math.cos(t), half - 0.19 + 0.19 * math.sin(t))
            for t in (0.0, 0.45, 0.85, 1.2)]  # fmt: skip
    shape = lathe([*tail, *nose, (0.0, half)], n=18)
    return shape.rotate(rotation_to(np.array([1.0, 0.0, 0.0])))


def _thruster(centre: tuple[float, float, float], axis: tuple[float, float, float]) -> list[Shape]:
    """Return duct and motor, then blades and struts, of a ducted propeller along ``axis``."""
    duct = lathe([(0.081, -0.045), (0.101, -0.045), (0.096, 0.05), (0.083, 0.05),
                  (0.081, -0.045)], n=14)  # fmt: skip
    pod = lathe([(0.0, -0.16), (0.032, -0.15), (0.036, 0.02), (0.0, 0.056)], n=8)
    blade = np.array([[0.02, -0.012, 0.012], [0.078, -0.020, 0.024], [0.080, 0.018, 0.006],
                      [0.02, 0.012, 0.022]])  # fmt: skip
    parts = []
    for k in range(3):
        blade_rotation = rotation_z(k * 2.0 * math.pi / 3.0)
        a, b, c, d = (tuple(corner) for corner in product(blade, blade_rotation.T).tolist())
        parts += [quad(a, b, c, d), quad(a, b, c, d).flip()]
        strut = quad((0.03, 0, -0.045), (0.09, 0, -0.045), (0.09, 0, -0.03), (0.03, 0, -0.03))
        strut = strut.rotate(rotation_z(0.5 + k * 2.0 * math.pi / 3.0))
        parts += [strut, strut.flip()]
    tilt = rotation_to(np.array(axis))
    return [join(duct, pod).rotate(tilt).shift(*centre), join(*parts).rotate(tilt).shift(*centre)]


def _bar(*path: tuple[float, float, float], radius: float = 0.015) -> Shape:
    return tube(path, radius, n=6, has_lids=False)


def make_frame(n: int = 6, n_strap: int = 16) -> list[Shape]:
    """Return the aluminium frame: three ribs that carry the hulls, rails between them.

    Args:
        n: the number of sides of a bar.
        n_strap: the number of sides of the straps round the hulls.
    """

    def _bar(*path: tuple[float, float, float], radius: float = 0.015) -> Shape:
        return tube(path, radius, n=n, has_lids=False)

    parts = []
    strap = lathe(
        [(HULL_RADIUS, -0.024), (HULL_RADIUS + 0.011, 0.0), (HULL_RADIUS, 0.024)], n=n_strap
    )
    strap = strap.rotate(rotation_to(np.array([1.0, 0.0, 0.0])))
    for x in RIBS:
        parts.append(_bar((x, -0.22, 0.06), (x, 0.22, 0.06)))
        parts.append(_bar((x, -0.30, 0.32), (x, 0.30, 0.32)))
        for side in (-1.0, 1.0):
            parts.append(
                _bar((x, side * 0.33, 0.15), (x, side * 0.29, 0.34), (x, side * 0.12, 0.64))
            )
        if x != RIBS[1]:  # the middle rib leaves the lettering free
            parts += [strap.shift(x, y, z) for _, y, z in HULLS]
            parts.append(_bar((x, 0.0, 0.05), (x, 0.0, 0.61)))
    for side in (-1.0, 1.0):
        parts.append(_bar((RIBS[0], side * 0.29, 0.33), (RIBS[2], side * 0.29, 0.33)))
        parts.append(_bar((RIBS[0], side * 0.13, 0.62), (RIBS[2], side * 0.13, 0.62)))
        parts.append(_bar((-0.30, side * 0.29, 0.34), (-0.30, side * 0.33, 0.36), radius=0.02))
    parts.append(_bar((RIBS[0], 0.0, 0.06), (RIBS[2], 0.0, 0.06)))
    return parts


def girona500() -> tuple[Mesh, ...]:
    """The whole vehicle without its arm."""
    thrusters = [
        _thruster((-0.30, 0.40, 0.38), (-1.0, 0.0, 0.0)),  # surge, starboard
        _thruster((-0.30, -0.40, 0.38), (-1.0, 0.0, 0.0)),  # surge, port
        _thruster((0.20, 0.0, 0.10), (0.0, 0.0, -1.0)),  # heave, bow
        _thruster((-0.32, 0.0, 0.10), (0.0, 0.0, -1.0)),  # heave, stern
        _thruster((0.02, 0.0, 0.46), (0.0, 1.0, 0.0)),  # sway
    ]
    pods = [
        *(motor for motor, _ in thrusters),
        cylinder((-0.66, 0.0, 0.46), (-0.44, 0.0, 0.46), 0.075, n=14, bevel=0.012),  # DVL
        cylinder((0.22, 0.10, 0.48), (0.50, 0.10, 0.48), 0.055, n=12, bevel=0.01),  # sonar
        cylinder((0.44, -0.10, 0.47), (0.56, -0.10, 0.47), 0.045, n=12, bevel=0.008),  # camera
        rounded_box((-0.46, -0.14, 0.42), (-0.12, 0.14, 0.55), radius=0.02, n=1),  # computer
    ]
    frame = [
        *make_frame(),
        *(propeller for _, propeller in thrusters),
        rounded_box((-0.16, -0.06, 0.86), (0.36, 0.06, 0.905), radius=0.012, n=1),  # arm's saddle
        _bar((-0.60, 0.0, 0.06), (-0.60, 0.0, -0.20), radius=0.010),  # antenna
        _bar((-0.60, 0.0, 0.06), (RIBS[0], 0.0, 0.06)),
        cylinder((-0.60, 0.0, -0.20), (-0.60, 0.0, -0.25), 0.03, n=10, bevel=0.008),
    ]
    metal = worn_paint("girona500/metal", (0.90, 0.90, 0.90))
    hulls = [to_mesh_frame(_hull().shift(*centre)) for centre in HULLS]
    return (
        mesh(*hulls, texture=hull_texture()),
        mesh(*(to_mesh_frame(part).project_uv(0.4) for part in pods), colour=BLACK, texture=metal),
        mesh(
            *(to_mesh_frame(part).project_uv(0.4) for part in frame),
            colour=ALUMINIUM,
            texture=metal,
        ),
    )
