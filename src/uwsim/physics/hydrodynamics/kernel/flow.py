"""Flow of the water past a point of a body: at a propeller, at a fin."""

from __future__ import annotations

from ....base.numerics.jit import njit
from ....base.numerics.memory import (
    Floats,
    Ints64,
    read_double,
    read_int32,
    read_int64,
    view_doubles,
)
from ..columns import (
    BODY_COLUMNS,
    CENTRE,
    DENSITY,
    DISPLACED,
    REFERENCE,
    SURFACE,
    TURN,
    WATER_COLUMNS,
)
from . import fields as f
from .equations import Three, relative_twist


@njit
def site_of(m: int, at: Ints64, actuator: int) -> tuple[int, int]:
    """The site that an actuator acts at, and its body."""
    site = read_int32(read_int64(m + at[f.ACTUATOR_TARGET]) + 8 * actuator)
    return site, read_int32(read_int64(m + at[f.SITE_BODY]) + 4 * site)


@njit
def velocity_at(m: int, d: int, at: Ints64, site: int, body: int) -> Three:
    """Velocity of a site through the water that turns round its body, axes of the site [m/s]."""
    place = view_doubles(read_int64(d + at[f.SITE_XPOS]) + 24 * site, 3)
    axes = view_doubles(read_int64(d + at[f.SITE_XMAT]) + 72 * site, 9)
    root = read_int32(read_int64(m + at[f.BODY_ROOT]) + 4 * body)
    com = view_doubles(read_int64(d + at[f.COM]) + 24 * root, 3)
    twist = view_doubles(read_int64(d + at[f.CVEL]) + 48 * body, 6)
    water = view_doubles(read_int64(d + at[f.USERDATA]) + 8 * WATER_COLUMNS * body, WATER_COLUMNS)
    lever = (place[0] - com[0], place[1] - com[1], place[2] - com[2])
    u, v, w, _, _, _ = relative_twist(axes, lever, twist, water)
    tx, ty, tz = water[TURN], water[TURN + 1], water[TURN + 2]
    if tx == 0.0 and ty == 0.0 and tz == 0.0:
        return u, v, w
    x, y, z = _from_felt(m, d, at, place, body)
    cx, cy, cz = ty * z - tz * y, tz * x - tx * z, tx * y - ty * x
    return (
        u - (axes[0] * cx + axes[3] * cy + axes[6] * cz),
        v - (axes[1] * cx + axes[4] * cy + axes[7] * cz),
        w - (axes[2] * cx + axes[5] * cy + axes[8] * cz),
    )


@njit
def _from_felt(m: int, d: int, at: Ints64, place: Floats, body: int) -> Three:
    """To a place from where the motion of the water at a body is given, world axes [m]."""
    table = view_doubles(read_int64(m + at[f.BODY_USER]) + 8 * BODY_COLUMNS * body, BODY_COLUMNS)
    share = 1.0 if table[DISPLACED] > 0.0 else 0.0
    x = table[REFERENCE] + share * table[CENTRE]
    y = table[REFERENCE + 1] + share * table[CENTRE + 1]
    z = table[REFERENCE + 2] + share * table[CENTRE + 2]
    origin = view_doubles(read_int64(d + at[f.XPOS]) + 24 * body, 3)
    axes = view_doubles(read_int64(d + at[f.XMAT]) + 72 * body, 9)
    return (
        place[0] - origin[0] - (axes[0] * x + axes[1] * y + axes[2] * z),
        place[1] - origin[1] - (axes[3] * x + axes[4] * y + axes[5] * z),
        place[2] - origin[2] - (axes[6] * x + axes[7] * y + axes[8] * z),
    )


@njit
def height_of(d: int, at: Ints64, site: int) -> float:
    """Height of a site in W [m]."""
    return read_double(read_int64(d + at[f.SITE_XPOS]) + 8 * (3 * site + 2))


@njit
def wet_share(m: int, d: int, at: Ints64, site: int, body: int, reach: float) -> float:
    """How much of a thing that reaches so far [m] about a site is under water, 0..1."""
    height = height_of(d, at, site)
    surface = read_double(read_int64(m + at[f.BODY_USER]) + 8 * SURFACE)
    surface += read_double(read_int64(d + at[f.USERDATA]) + 8 * (WATER_COLUMNS * body + 6))
    return min(max(0.5 + 0.5 * (surface - height) / reach, 0.0), 1.0)


@njit
def water_density(m: int, at: Ints64) -> float:
    """Of the water [kg/m3]."""
    density: float = read_double(read_int64(m + at[f.BODY_USER]) + 8 * DENSITY)
    return density


@njit
def push_at(
    m: int, d: int, at: Ints64, site: int, body: int,
    force: Three, torque: float, work: Floats,
) -> None:  # fmt: skip
    """Let a force in the axes of a site act there, and a torque per force along its x axis.

    Args:
        m: address of the model.
        d: address of the data.
        at: offsets of the fields.
        site: where.
        body: that it is on.
        force: axes of the site [N].
        torque: about the force per force [m].
        work: the rows of the bodies.
    """
    place = view_doubles(read_int64(d + at[f.SITE_XPOS]) + 24 * site, 3)
    axes = view_doubles(read_int64(d + at[f.SITE_XMAT]) + 72 * site, 9)
    root = read_int32(read_int64(m + at[f.BODY_ROOT]) + 4 * body)
    com = view_doubles(read_int64(d + at[f.COM]) + 24 * root, 3)
    x, y, z = force
    fx = axes[0] * x + axes[1] * y + axes[2] * z
    fy = axes[3] * x + axes[4] * y + axes[5] * z
    fz = axes[6] * x + axes[7] * y + axes[8] * z
    rx, ry, rz = place[0] - com[0], place[1] - com[1], place[2] - com[2]
    base = f.ROW * body
    to = base + f.WRENCH
    work[base + f.TOUCHED] = 1.0
    work[to] += ry * fz - rz * fy + torque * fx
    work[to + 1] += rz * fx - rx * fz + torque * fy
    work[to + 2] += rx * fy - ry * fx + torque * fz
    work[to + 3] += fx
    work[to + 4] += fy
    work[to + 5] += fz
