"""Flight recorders ("black boxes"), the objects to search, track and grasp.

The long axis is y. Both large faces (z up and z down) have the same markings, so that either may
be on top.
"""

from __future__ import annotations

import numpy as np

from uwsim.assets.mesh import Mesh, Texture

from ..cached import cache_image
from ..shapes import Shape, box, cylinder, join, mesh, quad, tube
from ..textures import Pixels, fill, mix, noise, paint_text, smoothstep, to_texture, worn_paint

ORANGE = (0.97, 0.42, 0.07)
"""The international orange, as stored value."""
BAND = (0.72, 0.73, 0.71)
"""The reflective bands, dull in diffuse light."""
WHITE = (0.96, 0.96, 0.94)
"""The ends, which are seldom in the sun."""
INK = (0.25, 0.23, 0.22)
"""The lettering and hazard bars."""
WEAR = 0.55
"""The strength of scuffs, dirt and rubbed paint, 0..1.

`BAND` and `INK` set the contrast of the large marks, `WEAR` that of the small ones. Without fog,
the grey levels of the top face have a standard deviation of 25 to 35.
"""


def _paint(name: str, height: int, width: int) -> Pixels:
    """Return orange paint: clouded, faded, rubbed to the primer in places."""
    clouds = noise(f"{name}/clouds", height, width, cells=3, octaves=6, tiles=False)
    scuffs = noise(f"{name}/scuffs", height, width, cells=7, octaves=5, gain=0.7, tiles=False)
    image = fill(height, width, ORANGE) * (1.0 + np.float32(0.14 * WEAR) * clouds)[..., None]
    image = mix(image, (0.42, 0.20, 0.10), np.float32(0.8 * WEAR) * smoothstep(0.9, 2.0, clouds))
    return mix(image, (0.75, 0.66, 0.55), np.float32(WEAR) * smoothstep(1.2, 2.2, scuffs))


def _paint_bars(image: Pixels, left: float, right: float, period: float) -> None:
    height, width = image.shape[:2]
    x, y = np.arange(width)[None, :], np.arange(height)[:, None]
    is_ink = ((x + y) % (period * height) < 0.5 * period * height) & (x >= left * width)
    image[is_ink & (x < right * width)] = INK


@cache_image
def face() -> Texture:
    """Return the image of the large faces, with the box's +y end to the right."""
    height, width = 192, 640
    image = _paint("blackbox/face", height, width)
    for left, right in ((0.060, 0.115), (0.835, 0.890)):
        image[:, round(left * width) : round(right * width)] = BAND
    _paint_bars(image, 0.925, 1.0, 0.28)
    _paint_bars(image, 0.0, 0.035, 0.28)
    paint_text(image, "FLIGHT RECORDER", (0.47, 0.25), width=0.63, height=0.24, colour=INK)
    paint_text(image, "DO NOT OPEN", (0.365, 0.63), width=0.42, height=0.22, colour=INK)
    paint_text(image, "ENREGISTREUR DE VOL", (0.365, 0.88), width=0.42, height=0.09, colour=INK)
    image[round(0.48 * height) : round(0.92 * height), 405:502] = BAND
    paint_text(image, "37.5 kHz", (0.708, 0.60), width=0.12, height=0.12, colour=INK)
    paint_text(image, "S/N 0427", (0.708, 0.80), width=0.12, height=0.12, colour=INK)
    dirt = noise("blackbox/dirt", height, width, cells=5, octaves=5, gain=0.7, tiles=False)
    return to_texture("blackbox/face", image * (1.0 + 0.05 * dirt)[..., None], repeats=False)


@cache_image
def side() -> Texture:
    """Return the image of the narrow faces."""
    height, width = 128, 480
    image = _paint("blackbox/side", height, width)
    for left, right in ((0.060, 0.115), (0.835, 0.890)):
        image[:, round(left * width) : round(right * width)] = BAND
    paint_text(image, "FLIGHT RECORDER", (0.475, 0.35), width=0.50, height=0.24, colour=INK)
    paint_text(image, "DO NOT OPEN", (0.475, 0.68), width=0.36, height=0.20, colour=INK)
    return to_texture("blackbox/side", image, repeats=False)


def _large_faces(x: float, y0: float, y1: float, z: float) -> Shape:
    return join(
        quad((x, y0, z), (x, y1, z), (-x, y1, z), (-x, y0, z)),
        quad((-x, y0, -z), (-x, y1, -z), (x, y1, -z), (x, y0, -z)),
    )


def _side_faces(
    x: float, y: tuple[float, float], z: tuple[float, float], extent: tuple[float, float, float]
) -> Shape:
    """Return both side faces between two y and two z; the image spans ``extent``: y, y and z."""
    (y0, y1), (z0, z1), (start, end, half) = y, z, extent
    u0, u1 = (y0 - start) / (end - start), (y1 - start) / (end - start)
    v0, v1 = (z0 + half) / (2 * half), (z1 + half) / (2 * half)
    return join(
        quad((x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1), uv=(u0, v0, u1, v1)),
        quad((-x, y1, z0), (-x, y0, z0), (-x, y0, z1), (-x, y1, z1),
             uv=(1 - u1, v0, 1 - u0, v1)),
    )  # fmt: skip


def _end_faces(x: float, y0: float, y1: float, z0: float, z1: float) -> Shape:
    return join(
        quad((-x, y0, z0), (x, y0, z0), (x, y0, z1), (-x, y0, z1)),
        quad((x, y1, z0), (-x, y1, z0), (-x, y1, z1), (x, y1, z1)),
    )


def _metal() -> Texture:
    return worn_paint("blackbox/metal", (0.92, 0.92, 0.92), size=128)


def _body(x: float, y: float, z: float) -> list[Mesh]:
    """Return a box of these half edges with markings on its four long faces."""
    return [
        mesh(_large_faces(x, -y, y, z), texture=face()),
        mesh(_side_faces(x, (-y, y), (-z, z), (-y, y, z)), texture=side()),
        mesh(_end_faces(x, -y, y, -z, z), colour=BAND, texture=_metal()),
    ]


def _bar(x: float, y0: float, y1: float, z: float, foot: float, radius: float) -> Shape:
    """Return a handle along y: a bar at height ``z`` on two feet at height ``foot``."""
    bend = 0.35 * (z - foot)
    path = [
        (x, y0, foot),
        (x, y0, z - bend),
        (x, y0 + 0.3 * bend, z - 0.3 * bend),
        (x, y0 + bend, z),
    ]
    back = [
        (x, y1 - bend, z),
        (x, y1 - 0.3 * bend, z - 0.3 * bend),
        (x, y1, z - bend),
        (x, y1, foot),
    ]
    return tube([*path, *back], radius, n=10)


def blackbox_uib() -> tuple[Mesh, ...]:
    """Return the recorder of UWSim's tank scenes: 0.13 x 0.433 x 0.15 m.

    Two plates of the full size hold the case between them. In the recess at the -y end lies the
    pinger (33 x 100 mm, as beacons are), in the one at the +y end the handle.
    """
    x, y0, y1, z, case_z = 0.065, -0.233, 0.200, 0.075, 0.045
    case = (-0.195, 0.165)
    extent = (y0, y1, z)
    sides = join(
        _side_faces(x, (y0, y1), (case_z, z), extent),
        _side_faces(x, (y0, y1), (-z, -case_z), extent),
        _side_faces(x, case, (-case_z, case_z), extent),
    )
    plates = join(_end_faces(x, y0, y1, case_z, z), _end_faces(x, y0, y1, -z, -case_z))
    shelves = [
        part
        for a, b in ((y0, case[0]), (case[1], y1))
        for part in (
            quad((-x, b, case_z), (x, b, case_z), (x, a, case_z), (-x, a, case_z)),
            quad((-x, a, -case_z), (x, a, -case_z), (x, b, -case_z), (-x, b, -case_z)),
        )
    ]
    pinger_y = case[0] - 0.018
    pinger = cylinder((-0.05, pinger_y, 0.0), (0.05, pinger_y, 0.0), 0.0165, n=14, bevel=0.003)
    clamps = [box((a - 0.006, pinger_y - 0.0175, -0.019), (a + 0.006, case[0], 0.019))
              for a in (-0.028, 0.028)]  # fmt: skip
    handle = tube(
        [(-0.045, case[1], 0.0), (-0.045, 0.186, 0.0), (-0.040, 0.191, 0.0),
         (0.040, 0.191, 0.0), (0.045, 0.186, 0.0), (0.045, case[1], 0.0)], 0.006, n=8)  # fmt: skip
    return (
        mesh(_large_faces(x, y0, y1, z), texture=face()),
        mesh(sides, texture=side()),
        mesh(plates, _end_faces(x, *case, -case_z, case_z), colour=WHITE, texture=_metal()),
        mesh(*shelves, *clamps, colour=ORANGE, texture=_metal()),
        mesh(pinger, handle, colour=(0.70, 0.71, 0.72), texture=_metal()),
    )


def blackbox() -> tuple[Mesh, ...]:
    """Return the recorder without a handle: a box of 0.20 x 0.35 x 0.15 m with the markings."""
    return tuple(_body(0.10, 0.175, 0.075))


def blackbox_standard() -> tuple[Mesh, ...]:
    """Return the recorder of the grasp scenes: 0.15 x 0.32 x 0.14 m, a 16 mm bar 50 mm above it."""
    handle = _bar(0.0, -0.06, 0.06, 0.07 + 0.05 + 0.008, 0.069, 0.008)
    return (*_body(0.075, 0.16, 0.07), mesh(handle, colour=(0.70, 0.71, 0.72), texture=_metal()))
