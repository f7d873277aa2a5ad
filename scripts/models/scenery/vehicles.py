"""Vehicles without facets: ``robot/GIRONA500/girona500`` and ``robot/BLUEROV2/bluerov2_heavy``.

The Girona 500 has the frame and layout of the stand-in `stand_ins.girona500`, which scenes of
UWSim and its benchmarks show. The BlueROV2 Heavy has x forward and z down, its origin in the
middle of its box of 0.457 x 0.575 x 0.254 m (Blue Robotics' data sheet); its parts are modelled
by eye.
"""

from __future__ import annotations

import math

import numpy as np

from ..parts import Part
from ..shapes import Shape, cylinder, lathe, rotation_to, rounded_box, sphere, tube
from ..stand_ins.girona500 import (
    HULL_LENGTH,
    HULL_RADIUS,
    HULLS,
    RIBS,
    hull_texture,
    make_frame,
    to_mesh_frame,
)
from ..surfaces import Material, make_material
from ..textures import noise
from .vehicle_parts import make_paint, make_thruster, place_thruster, project_obliquely

TILE = 0.4
"""The side of an image of paint [m]."""
GIRONA_THRUSTERS = (
    ((-0.30, 0.40, 0.38), (-1.0, 0.0, 0.0)),
    ((-0.30, -0.40, 0.38), (-1.0, 0.0, 0.0)),
    ((0.20, 0.0, 0.10), (0.0, 0.0, -1.0)),
    ((-0.32, 0.0, 0.10), (0.0, 0.0, -1.0)),
    ((0.02, 0.0, 0.46), (0.0, 1.0, 0.0)),
)
"""The centres and axes of the thrusters in base_link [m]."""
DIAGONAL = math.sqrt(0.5)


def girona500() -> tuple[Part, ...]:
    """Return the Girona 500 without its arm, in the frame of the stand-in's mesh."""
    thrusters = [place_thruster(make_thruster(0.1), *pose) for pose in GIRONA_THRUSTERS]
    pods = [
        cylinder((-0.66, 0.0, 0.46), (-0.44, 0.0, 0.46), 0.075, n=32, bevel=0.012),
        cylinder((0.22, 0.10, 0.48), (0.50, 0.10, 0.48), 0.055, n=28, bevel=0.01),
        cylinder((0.44, -0.10, 0.47), (0.56, -0.10, 0.47), 0.045, n=28, bevel=0.008),
        rounded_box((-0.46, -0.14, 0.42), (-0.12, 0.14, 0.55), radius=0.03, n=3),
    ]
    frame = [
        *make_frame(10, 32),
        rounded_box((-0.16, -0.06, 0.86), (0.36, 0.06, 0.905), radius=0.012, n=3),
        tube([(-0.60, 0.0, 0.06), (-0.60, 0.0, -0.20)], 0.010, n=10, has_lids=False),
        tube([(-0.60, 0.0, 0.06), (RIBS[0], 0.0, 0.06)], 0.012, n=10, has_lids=False),
        cylinder((-0.60, 0.0, -0.20), (-0.60, 0.0, -0.25), 0.03, n=20, bevel=0.008),
    ]
    black = make_paint("girona-black", (0.19, 0.20, 0.22), 0.45)
    metal = make_paint("aluminium", (0.70, 0.71, 0.72), 0.45, metallic=0.85)
    hulls = [to_mesh_frame(_girona_hull().shift(*centre)) for centre in HULLS]
    return (
        _hull_material().cover(*hulls, crease=1.2),
        black.cover(
            *(_fit(duct) for duct, _ in thrusters), *(_fit(pod) for pod in pods), crease=0.9
        ),
        metal.cover(
            *(_fit(bar) for bar in frame), *(_fit(blades) for _, blades in thrusters), crease=0.9
        ),
    )


def _fit(shape: Shape) -> Shape:
    return project_obliquely(to_mesh_frame(shape), TILE)


def _girona_hull() -> Shape:
    """Return a hull along x with an elliptic nose and a tail of continuous slope."""
    radius, half = HULL_RADIUS, HULL_LENGTH / 2.0
    shares = np.linspace(0.0, 1.0, 16)
    taper = 0.045 + (radius - 0.045) * np.sin(0.5 * math.pi * shares)
    tail = [(float(r), -half + 0.36 * float(s)) for r, s in zip(taper, shares, strict=True)]
    angles = np.linspace(0.0, 0.5 * math.pi, 14)[:-1]
    nose = [(radius * math.cos(a), half - 0.19 + 0.19 * math.sin(a)) for a in angles.tolist()]
    shape = lathe([(0.0, -half), *tail, *nose, (0.0, half)], n=40)
    return shape.rotate(rotation_to(np.array([1.0, 0.0, 0.0])))


def _hull_material() -> Material:
    """Return the painted hull with its lettering, and joints of its shells as grooves."""
    pixels = hull_texture().pixels.astype(np.float32) / np.float32(255.0)
    height, width = pixels.shape[:2]
    depth = np.zeros((height, width), dtype=np.float32)
    for seam in (0.12, 0.24, 0.75, 0.88):
        row = round(seam * height)
        depth[row : row + 2] = -0.002
    clouds = noise("girona500/gloss", height, width, cells=3, octaves=5)
    roughness = np.clip(0.36 + 0.05 * clouds, 0.1, 1.0)
    pixel = (2.0 * math.pi * HULL_RADIUS / width, HULL_LENGTH / height)
    return make_material(
        "girona500/paint", pixels, depth, roughness, pixel=pixel, occlusion_depth=0.01
    )


def bluerov2_heavy() -> tuple[Part, ...]:
    """Return the BlueROV2 Heavy."""
    black = make_paint("rov-black", (0.14, 0.145, 0.15), 0.5)
    blue = make_paint("rov-blue", (0.05, 0.32, 0.62), 0.55)
    acrylic = make_paint("rov-acrylic", (0.20, 0.22, 0.24), 0.12)
    metal = make_paint("rov-metal", (0.62, 0.63, 0.65), 0.35, metallic=0.85)
    thruster = make_thruster(0.05)
    poses = [((x, y, 0.02), (0.0, 0.0, 1.0)) for x in (-0.115, 0.115) for y in (-0.225, 0.225)]
    poses += [
        ((x, y, -0.035), (DIAGONAL, -DIAGONAL * math.copysign(1.0, x * y), 0.0))
        for x in (-0.155, 0.155)
        for y in (-0.105, 0.105)
    ]
    thrusters = [place_thruster(thruster, *pose) for pose in poses]
    floats = [
        rounded_box((x0, y0, 0.045), (x1, y1, 0.125), radius=0.022, n=4)
        for x0, x1 in ((-0.205, -0.015), (0.015, 0.205))
        for y0, y1 in ((-0.165, -0.065), (0.065, 0.165))
    ]
    parts = (
        black.cover(*map(_wrap, (*_rov_frame(), *(duct for duct, _ in thrusters))), crease=0.8),
        blue.cover(*map(_wrap, (*floats, *(blades for _, blades in thrusters))), crease=0.9),
        acrylic.cover(*map(_wrap, _rov_tubes()), crease=1.2),
        metal.cover(*map(_wrap, _rov_fittings()), crease=0.8),
    )
    return parts


def _wrap(shape: Shape) -> Shape:
    """Return a shape with texture coordinates, in the frame of the robot: z down."""
    return project_obliquely(shape, TILE).rotate(np.diag([1.0, -1.0, -1.0]))


def _rov_frame() -> list[Shape]:
    """Return side plates, feet, cross plates and the brackets of the upright thrusters."""
    shapes = []
    for side in (-1.0, 1.0):
        y0, y1 = sorted((side * 0.168, side * 0.180))
        for x0, x1, z0, z1 in (
            (-0.2285, 0.2285, 0.02, 0.075),
            (-0.2285, 0.2285, -0.127, -0.085),
            (-0.2285, -0.165, -0.09, 0.03),
            (0.165, 0.2285, -0.09, 0.03),
            (-0.045, 0.045, -0.09, 0.03),
        ):
            shapes.append(rounded_box((x0, y0, z0), (x1, y1, z1), radius=0.0055, n=1))
        for x in (-0.115, 0.115):
            low, high = sorted((side * 0.175, side * 0.2))
            shapes.append(
                rounded_box((x - 0.035, low, 0.0), (x + 0.035, high, 0.045), radius=0.008, n=2)
            )
    for x in (-0.13, 0.13):
        shapes.append(rounded_box((x - 0.04, -0.17, -0.1), (x + 0.04, 0.17, -0.09), radius=0.004))
    shapes.append(rounded_box((-0.2, -0.07, 0.04), (0.2, 0.07, 0.05), radius=0.004))
    return shapes


def _rov_tubes() -> list[Shape]:
    """Return the enclosure of the electronics with its dome, and that of the battery."""
    dome = sphere(0.056, n=28).scale(0.9, 1.0, 1.0).shift(0.155, 0.0, -0.01)
    return [
        cylinder((-0.15, 0.0, -0.01), (0.15, 0.0, -0.01), 0.056, n=40),
        cylinder((-0.12, 0.0, -0.085), (0.12, 0.0, -0.085), 0.036, n=32, bevel=0.004),
        dome,
        *(
            cylinder((0.205, y, z), (0.216, y, z), 0.017, n=20)
            for y in (-0.125, 0.125)
            for z in (0.02, -0.03)
        ),
    ]


def _rov_fittings() -> list[Shape]:
    """Return flanges, end caps, lamps and the cable at the stern."""
    shapes = [
        cylinder((x0, 0.0, -0.01), (x1, 0.0, -0.01), 0.0625, n=28, bevel=0.003)
        for x0, x1 in ((0.14, 0.158), (-0.172, -0.145))
    ]
    shapes += [
        cylinder((x0, 0.0, -0.085), (x1, 0.0, -0.085), 0.0415, n=24, bevel=0.003)
        for x0, x1 in ((0.112, 0.135), (-0.135, -0.112))
    ]
    for y in (-0.125, 0.125):
        for z in (0.02, -0.03):
            shapes.append(cylinder((0.165, y, z), (0.208, y, z), 0.02, n=20, bevel=0.003))
    cable = [(-0.17, 0.02, 0.02), (-0.2, 0.02, 0.06), (-0.19, 0.02, 0.11), (-0.15, 0.02, 0.127)]
    shapes.append(tube(cable, 0.0045, n=8))
    return shapes
