"""The CSIP ARM5E without facets, link by link: ``robot/ARM5E/arm5e_*``.

Each link is in the mesh frame of the stand-in `stand_ins.arm5e`, so that robot files place both
alike: the slew axis of base and shoulder is z, the shoulder of the upper arm and the elbow of the
forearm are along y at the origin, the wrist is along x. The arm has four motors in cylindrical
housings, tubes of black anodised aluminium, clevises round the drums of the joints, and a jaw of
two claws. Lengths are those of UWSim's robot file; the parts are modelled by eye.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from uwsim.base.geometry import Array, Triple

from ..parts import Part
from ..shapes import Shape, box, cylinder, extrusion, join, lathe, rotation_to, rounded_box, tube
from .vehicle_parts import make_paint, project_obliquely

TILE = 0.25
"""The side of an image of paint [m]."""
SHOULDER = (0.0805, 0.0, -0.13)
"""The shoulder in the frame of base and shoulder link [m]."""
ELBOW = (0.4315, 0.0, -0.0994)
"""The elbow in the frame of the upper arm [m]."""
WRIST_HEIGHT = 0.083
"""The height of the wrist's axis, along x, in the frame of the forearm [m]."""
HINGE = (0.073, 0.0, 0.04)
"""The hinge of a jaw in the frame of the wrist; the other has z reversed [m]."""
PAD_HEIGHT = -0.032
"""The height of a jaw's pad below its hinge; closed pads are 16 mm apart [m]."""
RUBBER = (0.6, 0.6, 0.6)
"""The factor on the colour of anodised aluminium that gives that of rubber."""
N = 18
"""The number of corners of large circles."""

Profile = list[tuple[float, float]]


def _cover(black: list[Shape], metal: list[Shape], rubber: list[Shape]) -> tuple[Part, ...]:
    """Cover shapes with anodised and bare aluminium; rubber is the former's image, darker."""
    black_aluminium = make_paint("arm-black", (0.115, 0.12, 0.13), 0.36)
    bare_aluminium = make_paint("arm-metal", (0.66, 0.67, 0.68), 0.42, metallic=0.85)
    parts = []
    for material, shapes in (
        (black_aluminium, black),
        (bare_aluminium, metal),
        (black_aluminium, rubber),
    ):
        if shapes:
            parts.append(
                material.cover(*(project_obliquely(shape, TILE) for shape in shapes), crease=1.2)
            )
    if rubber:
        parts[-1] = replace(parts[-1], mesh=replace(parts[-1].mesh, colour=RUBBER))
    return tuple(parts)


def _block(lower: Triple, upper: Triple, *, radius: float) -> Shape:
    return rounded_box(lower, upper, radius=radius, n=1)


def _round_cap(radius: float, depth: float) -> Profile:
    """Return the profile of a rounded cap whose top is at 0, down to ``-depth``."""
    angles = np.linspace(0.5 * math.pi, 0.0, 5).tolist()
    corner = min(depth, 0.55 * radius)
    return [(radius - corner + corner * math.cos(a), corner * (math.sin(a) - 1.0)) for a in angles]


def _turn(profile: Profile, start: Triple, end: Triple, *, n: int = N) -> Shape:
    """Return a profile of (radius, distance from ``start``), turned about the line to ``end``."""
    axis = np.array(end) - np.array(start)
    return lathe(profile, n=n).rotate(rotation_to(axis)).shift(*start)


def _housing(start: Triple, end: Triple, radius: float, *, n: int = N) -> Shape:
    """Return the housing of a motor from its round cap to its rim."""
    length = float(np.linalg.norm(np.array(end) - np.array(start)))
    cap = [(r, -z) for r, z in _round_cap(radius, 0.5 * radius)]
    return _turn([(0.0, 0.0), *cap[1:], (radius, length), (0.0, length)], start, end, n=n)


def _flange(centre: Triple, axis: Triple, radius: float, thickness: float) -> Shape:
    """Return a disc with bevelled rims, from the centre along an axis."""
    end = tuple((np.array(centre) + thickness * np.array(axis)).tolist())
    bevel = 0.0018
    return cylinder(centre, end, radius, n=N, bevel=bevel)


def _bolts(
    centre: Triple, axis: Triple, circle: float, n: int, *, size: float = 0.0048
) -> list[Shape]:
    """Return the heads of bolts on a circle, which stand out along an axis."""
    turn = rotation_to(np.array(axis))
    heads = []
    for k in range(n):
        angle = 2.0 * math.pi * (k + 0.5) / n
        head = lathe([(size, 0.0), (0.9 * size, 0.0042), (0.0, 0.0042)], n=6)
        head = head.shift(circle * math.cos(angle), circle * math.sin(angle))
        heads.append(head.rotate(turn).shift(*centre))
    return heads


def _clevis(tip: tuple[float, float], radius: float, gap: float, thickness: float) -> list[Shape]:
    """Return two plates about the axis y at the origin, which reach to a point (x, z)."""
    reach = math.hypot(*tip)
    angles = np.linspace(0.5 * math.pi, 1.5 * math.pi, 9)
    round_end = np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1)
    width = 0.86 * radius
    far_end = np.array([[reach - 0.008, -width], [reach, -width + 0.008],
                        [reach, width - 0.008], [reach - 0.008, width]])  # fmt: skip
    outline = np.concatenate([round_end, far_end])
    plates = []
    for low in (gap, -gap - thickness):
        plate = _place_outline(outline, low, thickness, bevel=0.002)
        plates.append(plate.rotate(_tilt(tip)))
    return plates


def _place_outline(outline: Array, low: float, thickness: float, *, bevel: float) -> Shape:
    """Return an outline in x and z, (n, 2) [m], between two y."""
    middle = outline.mean(axis=0)
    shape = extrusion(outline - middle, -0.5 * thickness, 0.5 * thickness, bevel=bevel)
    y_from_z = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return shape.rotate(y_from_z).shift(middle[0], low + 0.5 * thickness, middle[1])


def _tilt(tip: tuple[float, float]) -> Array:
    """Return the rotation about y of x to the direction (x, z)."""
    x, z = np.array(tip) / math.hypot(*tip)
    return np.array([[x, 0.0, -z], [0.0, 1.0, 0.0], [z, 0.0, x]])


def _drum(half: float, radius: float, centre: Triple = (0.0, 0.0, 0.0)) -> Shape:
    """Return the drum of a joint along y."""
    x, y, z = centre
    return cylinder((x, y - half, z), (x, y + half, z), radius, n=N, bevel=0.003)


def _hub(half: float, radius: float, centre: Triple = (0.0, 0.0, 0.0)) -> list[Shape]:
    """Return the round covers of an axis along y, outside of a clevis."""
    x, y, z = centre
    covers = []
    for side in (-1.0, 1.0):
        start = (x, y + side * half, z)
        end = (x, y + side * (half + 1.0), z)
        cap = [(r, 0.014 + h) for r, h in reversed(_round_cap(radius, 0.012)[1::2])]
        covers.append(_turn([(radius, 0.0), *cap, (0.0, 0.014)], start, end, n=16))
    return covers


def _bend(points: list[Triple], *, n: int = 20) -> Array:
    """Return a smooth curve through points (Catmull-Rom), (n, 3) [m]."""
    knots = np.array(points, dtype=np.float64)
    knots = np.concatenate([2.0 * knots[:1] - knots[1:2], knots, 2.0 * knots[-1:] - knots[-2:-1]])
    places = np.linspace(0.0, len(points) - 1.0, n)
    curve = []
    for place in places.tolist():
        k = min(int(place), len(points) - 2)
        t = place - k
        a, b, c, d = knots[k : k + 4]
        curve.append(0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t
                            + (3.0 * b - a - 3.0 * c + d) * t * t * t))  # fmt: skip
    return np.array(curve)


def _cable(points: list[Triple], *, n: int = 10, radius: float = 0.0042) -> Shape:
    return tube(_bend(points, n=n), radius, n=6, has_lids=False)


def base() -> tuple[Part, ...]:
    """Return the plate under the hull with the motor of the slew joint and its bearing."""
    plate = _block((-0.30, -0.048, 0.034), (0.045, 0.048, 0.047), radius=0.012)
    feet = [
        _block((x, -0.056, 0.044), (x + 0.045, 0.056, 0.058), radius=0.006) for x in (-0.285, -0.06)
    ]
    motor = _housing((-0.315, 0.0, -0.006), (-0.07, 0.0, -0.006), 0.036)
    collar = _flange((-0.078, 0.0, -0.006), (1.0, 0.0, 0.0), 0.041, 0.014)
    box = _block((-0.07, -0.037, -0.042), (0.0, 0.037, 0.036), radius=0.012)
    bearing = cylinder((0.0, 0.0, -0.052), (0.0, 0.0, 0.036), 0.044, n=N, bevel=0.004)
    clamps = [_flange((x, 0.0, -0.006), (1.0, 0.0, 0.0), 0.0395, 0.016) for x in (-0.265, -0.16)]
    posts = [
        _block((x, -0.02, 0.0), (x + 0.016, 0.02, 0.04), radius=0.004) for x in (-0.265, -0.16)
    ]
    cable = _cable(
        [(-0.30, 0.012, -0.006), (-0.335, 0.02, -0.002), (-0.34, 0.025, 0.03), (-0.30, 0.03, 0.045)]
    )
    gland = cylinder((-0.325, 0.012, -0.006), (-0.30, 0.012, -0.006), 0.008, n=8, bevel=0.002)
    return _cover(
        [motor, box, bearing, *feet],
        [plate, collar, *clamps, *posts, gland],
        [cable],
    )


def shoulder() -> tuple[Part, ...]:
    """Return the turntable, the bent neck and the drum of the shoulder."""
    x, _, z = SHOULDER
    table = _turn(
        [(0.0, 0.0), (0.052, 0.0), (0.055, 0.003), (0.055, 0.012), (0.052, 0.015), (0.041, 0.017),
         (0.039, 0.022), (0.039, 0.03)], (0.0, 0.0, -0.052), (0.0, 0.0, -0.1))  # fmt: skip
    path = [
        (0.0, 0.0, -0.07),
        (0.002, 0.0, -0.095),
        (0.02, 0.0, -0.121),
        (0.05, 0.0, -0.13),
        SHOULDER,
    ]
    neck = tube(_bend(path, n=9), 0.035, n=N, has_lids=False)
    drum = _drum(0.047, 0.045, SHOULDER)
    rings = [
        cylinder((x, y, z), (x, y + 0.007, z), 0.0475, n=N, bevel=0.0015) for y in (-0.044, 0.037)
    ]
    cable = _cable(
        [(-0.012, 0.038, -0.06), (-0.02, 0.048, -0.085), (0.01, 0.052, -0.115),
         (0.045, 0.038, -0.115), (0.06, 0.025, -0.10)]
    )  # fmt: skip
    bolts = _bolts((0.0, 0.0, -0.067), (0.0, 0.0, -1.0), 0.0475, 6, size=0.0045)
    return _cover([neck, drum], [table, *rings, *bolts], [cable])


def upper_arm() -> tuple[Part, ...]:
    """Return the clevis of the shoulder, the tube, two motors beside it, the drum of the elbow."""
    tip = (ELBOW[0], ELBOW[2])
    reach = math.hypot(*tip)
    turn = _tilt(tip)

    def rod(profile: Profile) -> Shape:
        return _turn(profile, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)).rotate(turn)

    clevis = _clevis((tip[0] / reach * 0.105, tip[1] / reach * 0.105), 0.043, 0.0495, 0.011)
    bridge = _block((0.078, -0.0605, -0.037), (0.112, 0.0605, 0.037), radius=0.009).rotate(turn)
    tubing = rod(
        [(0.0, 0.108), (0.041, 0.108), (0.041, 0.124), (0.034, 0.13), (0.034, reach - 0.05),
         (0.0345, reach)]
    )  # fmt: skip
    collar = rod([(0.034, reach - 0.088), (0.04, reach - 0.086), (0.04, reach - 0.064),
                  (0.034, reach - 0.062)])  # fmt: skip
    drum = _drum(0.043, 0.043, ELBOW)
    rings = [
        cylinder(
            (ELBOW[0], y, ELBOW[2]), (ELBOW[0], y + 0.006, ELBOW[2]), 0.0452, n=N, bevel=0.0015
        )
        for y in (-0.041, 0.035)
    ]
    motors, clamps, glands, cables = [], [], [], []
    for side, cap, rim in ((-1.0, 0.335, 0.128), (1.0, 0.30, 0.128)):
        y = side * 0.063
        motors.append(_housing((cap, y, 0.012), (rim, y, 0.012), 0.0265, n=16).rotate(turn))
        for place in (0.155, cap - 0.065):
            ring = _turn([(0.0265, 0.0), (0.03, 0.0025), (0.03, 0.0115), (0.0265, 0.014)],
                         (place, y, 0.012), (place + 1.0, y, 0.012), n=16)  # fmt: skip
            low, high = sorted((side * 0.025, side * 0.045))
            block = _block((place, low, -0.008), (place + 0.014, high, 0.022), radius=0.003)
            clamps += [ring.rotate(turn), block.rotate(turn)]
        gland = cylinder((cap - 0.003, y, 0.012), (cap + 0.014, y, 0.012), 0.007, n=8, bevel=0.0015)
        glands.append(gland.rotate(turn))
        end = [(cap + 0.012, y, 0.012), (cap + 0.035, y, 0.014), (cap + 0.05, 0.8 * y, 0.032),
               (cap + 0.02, 0.45 * y, 0.038), (0.25, 0.2 * y, 0.036)]  # fmt: skip
        cables.append(_cable([tuple((turn @ np.array(p)).tolist()) for p in end], n=9))
    return _cover(
        [*clevis, bridge, tubing, drum, *motors],
        [collar, *rings, *clamps, *glands, *_hub(0.0605, 0.03)],
        cables,
    )


def forearm() -> tuple[Part, ...]:
    """Return the clevis of the elbow, the motor of the wrist, and that of the jaw above it."""
    w = WRIST_HEIGHT
    clevis = _clevis((0.055, 0.082), 0.040, 0.0452, 0.0095)
    wrist = _housing((-0.03, 0.0, w), (0.295, 0.0, w), 0.046)
    flanges = [
        _flange((0.285, 0.0, w), (1.0, 0.0, 0.0), 0.055, 0.013),
        _flange((0.3, 0.0, w), (1.0, 0.0, 0.0), 0.052, 0.018),
    ]
    bolts = _bolts((0.286, 0.0, w), (-1.0, 0.0, 0.0), 0.0505, 6, size=0.004)
    saddle = _block((0.035, -0.0445, w - 0.03), (0.085, 0.0445, w + 0.03), radius=0.01)
    straps = [
        _turn([(0.0455, 0.0), (0.0495, 0.003), (0.0495, 0.014), (0.0455, 0.017)], (x, 0.0, w),
              (x + 1.0, 0.0, w))
        for x in (0.125, 0.225)
    ]  # fmt: skip
    top = w + 0.082
    jaw = _housing((0.03, 0.0, top), (0.262, 0.0, top), 0.031, n=16)
    jaw_straps = [
        _turn([(0.0305, 0.0), (0.0345, 0.003), (0.0345, 0.014), (0.0305, 0.017)], (x, 0.0, top),
              (x + 1.0, 0.0, top), n=16)
        for x in (0.125, 0.225)
    ]  # fmt: skip
    blocks = [
        _block((x, -0.017, w + 0.04), (x + 0.017, 0.017, top - 0.024), radius=0.003)
        for x in (0.125, 0.225)
    ]
    screw = cylinder((0.26, 0.0, top), (0.318, 0.0, top), 0.011, n=10, bevel=0.002)
    lever = _block((0.296, -0.011, w + 0.045), (0.316, 0.011, top + 0.016), radius=0.005)
    glands = [
        cylinder((-0.046, 0.012, w), (-0.026, 0.012, w), 0.0085, n=8, bevel=0.002),
        cylinder((0.016, 0.0, top), (0.034, 0.0, top), 0.0075, n=8, bevel=0.002),
    ]
    cables = [
        _cable([(0.018, 0.0, top), (-0.02, 0.0, top + 0.005), (-0.055, 0.006, top - 0.03),
                (-0.06, 0.012, w + 0.015), (-0.044, 0.012, w)]),
        _cable([(-0.03, -0.018, w - 0.006), (-0.06, -0.03, w - 0.02), (-0.055, -0.035, w - 0.055),
                (-0.02, -0.03, w - 0.08)]),
    ]  # fmt: skip
    return _cover(
        [*clevis, wrist, jaw, saddle],
        [*flanges, *bolts, *straps, *jaw_straps, *blocks, screw, lever, *glands,
         *_hub(0.0545, 0.028)],
        cables,
    )  # fmt: skip


def wrist() -> tuple[Part, ...]:
    """Return the flange of the wrist, the palm, and the ears and pins of the jaws."""
    x, _, z = HINGE
    flange = _turn(
        [(0.0, 0.0), (0.047, 0.0), (0.05, 0.003), (0.05, 0.013), (0.047, 0.016), (0.04, 0.018),
         (0.037, 0.03), (0.033, 0.046), (0.026, 0.052), (0.0, 0.053)],
        (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
    )  # fmt: skip
    bolts = _bolts((0.0155, 0.0, 0.0), (1.0, 0.0, 0.0), 0.0435, 6, size=0.0038)
    ears, pins = [], []
    for side in (-1.0, 1.0):
        for y in (-0.043, 0.034):
            outline = np.array([[0.02, -0.020], [0.03, -0.024], [0.07, -0.016], [0.083, -0.011],
                                [0.0875, 0.0], [0.083, 0.011], [0.073, 0.015], [0.05, 0.010],
                                [0.028, 0.0]])  # fmt: skip
            ear = _place_outline(outline, y, 0.009, bevel=0.0018)
            ears.append((ear if side > 0.0 else ear.scale(1.0, 1.0, -1.0)).shift(z=side * z))
        rod = cylinder((x, -0.047, side * z), (x, 0.047, side * z), 0.0075, n=10, bevel=0.0015)
        pins += [
            rod,
            *(
                cylinder((x, y, side * z), (x, y + 0.005, side * z), 0.012, n=10, bevel=0.0015)
                for y in (-0.048, 0.043)
            ),
        ]
    nose = cylinder((0.045, 0.0, 0.0), (0.082, 0.0, 0.0), 0.0135, n=12, bevel=0.004)
    palm = _block((0.02, -0.034, -0.034), (0.05, 0.034, 0.034), radius=0.009)
    return _cover([flange, palm, *ears], [nose, *pins, *bolts], [])


def jaw1() -> tuple[Part, ...]:
    """Return the jaw whose hinge is at +z: two claws with a grooved pad between them."""
    return _jaw(1.0)


def jaw2() -> tuple[Part, ...]:
    """Return the mirror image of jaw1."""
    return _jaw(-1.0)


def _jaw(side: float) -> tuple[Part, ...]:
    outline = np.array(
        [[0.0105, -0.0175], [0.024, -0.0285], [0.034, -0.0315], [0.098, -0.0315], [0.1045, -0.029],
         [0.106, -0.0245], [0.103, -0.0185], [0.09, -0.010], [0.072, -0.0005], [0.052, 0.0065],
         [0.032, 0.0105], [0.012, 0.0125], [0.0, 0.0125], [-0.0088, 0.0088], [-0.0125, 0.0],
         [-0.0088, -0.0088], [0.0, -0.0125]]
    )  # fmt: skip
    claws = [_place_outline(outline, y, 0.010, bevel=0.0022) for y in (-0.032, 0.022)]
    knuckle = cylinder((0.0, -0.032, 0.0), (0.0, 0.032, 0.0), 0.0125, n=12, bevel=0.002)
    web = _block((0.028, -0.026, -0.024), (0.086, 0.026, -0.012), radius=0.004)
    pads = [
        box((x, -0.03, PAD_HEIGHT), (x + 0.0095, 0.03, -0.022))
        for x in np.arange(0.030, 0.097, 0.0134).tolist()
    ]
    bolts = [
        bolt.shift(0.0, y, 0.0)
        for y, axis in ((0.032, 1.0), (-0.032, -1.0))
        for bolt in (
            _bolts((0.03, 0.0, -0.012), (0.0, axis, 0.0), 0.0, 1, size=0.0045)
            + _bolts((0.074, 0.0, -0.017), (0.0, axis, 0.0), 0.0, 1, size=0.0045)
        )
    ]
    shapes = [join(*claws, knuckle), join(web), join(*pads, *bolts)]
    claw, body, pad = (shape.scale(1.0, 1.0, side) for shape in shapes)
    return _cover([body], [claw, pad], [])
