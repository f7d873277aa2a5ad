"""The flow at a propeller or fin, its submersion, and the addition of its force to its body."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....base.numerics.jit import njit, njit_borrowed
from ....base.numerics.memory import (
    Floats,
    Ints64,
    read_double,
    read_int32,
    read_int64,
    view_doubles,
)
from .. import columns as c
from . import fields as f
from .equations import Three, relative_twist, submerged_part, surface_plane
from .submersion import MEMORY


@njit
def actuator_site(m: int, o: Ints64, actuator: int) -> tuple[int, int]:
    """Return the site that an actuator acts at, and its body."""
    site = read_int32(read_int64(m + o[f.ACTUATOR_TARGET]) + 8 * actuator)
    return site, read_int32(read_int64(m + o[f.SITE_BODY]) + 4 * site)


@njit
def site_velocity(m: int, d: int, o: Ints64, site: int, body: int) -> Three:
    """Return the velocity of a site through the water, which may rotate, in site axes [m/s]."""
    position = view_doubles(read_int64(d + o[f.SITE_XPOS]) + 24 * site, 3)
    axes = view_doubles(read_int64(d + o[f.SITE_XMAT]) + 72 * site, 9)
    root = read_int32(read_int64(m + o[f.BODY_ROOT]) + 4 * body)
    com = view_doubles(read_int64(d + o[f.COM]) + 24 * root, 3)
    twist = view_doubles(read_int64(d + o[f.CVEL]) + 48 * body, 6)
    water = view_doubles(
        read_int64(d + o[f.USERDATA]) + 8 * c.WATER_COLUMNS * body, c.WATER_COLUMNS
    )
    table = view_doubles(read_int64(m + o[f.BODY_USER]) + 8 * c.BODY_COLUMNS * body, c.BODY_COLUMNS)
    origin = view_doubles(read_int64(d + o[f.XPOS]) + 24 * body, 3)
    body_axes = view_doubles(read_int64(d + o[f.XMAT]) + 72 * body, 9)
    flow = SiteFlow(position, axes, com, twist, water, table, origin, body_axes)
    return flow_velocity(flow)


class SiteFlow(NamedTuple):
    """The numbers of a site in water that moves and rotates."""

    position: Floats
    """The position of the site in W, (3,) [m]."""
    axes: Floats
    """The rotation ``world_from_site`` by rows, (9,)."""
    com: Floats
    """The centre of mass of the tree in W, (3,) [m]."""
    twist: Floats
    """The spatial velocity of the body as in MuJoCo, (6,)."""
    water: Floats
    """The row of the water at the body (`columns`), (12,)."""
    table: Floats
    """The row of the body (`columns`), (160,)."""
    origin: Floats
    """The position of the body in W, (3,) [m]."""
    body_axes: Floats
    """The rotation ``world_from_body`` by rows, (9,)."""


@njit_borrowed
def flow_velocity(flow: SiteFlow) -> Three:
    """Return the velocity of a site through the water, which may rotate, in site axes [m/s]."""
    position, axes, com, water = flow.position, flow.axes, flow.com, flow.water
    lever = (position[0] - com[0], position[1] - com[1], position[2] - com[2])
    u, v, w, _, _, _ = relative_twist(axes, lever, flow.twist, water)
    tx, ty, tz = water[c.OMEGA], water[c.OMEGA + 1], water[c.OMEGA + 2]
    if tx == 0.0 and ty == 0.0 and tz == 0.0:
        return u, v, w
    x, y, z = _reference_lever(flow.table, flow.origin, flow.body_axes, position)
    cx, cy, cz = ty * z - tz * y, tz * x - tx * z, tx * y - ty * x
    return (
        u - (axes[0] * cx + axes[3] * cy + axes[6] * cz),
        v - (axes[1] * cx + axes[4] * cy + axes[7] * cz),
        w - (axes[2] * cx + axes[5] * cy + axes[8] * cz),
    )


@njit_borrowed
def _reference_lever(table: Floats, origin: Floats, axes: Floats, position: Floats) -> Three:
    """Return the vector to a position from the point at which the water acts on a body [m].

    The position and the vector are in world axes.
    """
    share = 1.0 if table[c.DISPLACED_MASS] > 0.0 else 0.0
    x = table[c.REFERENCE] + share * table[c.CENTRE]
    y = table[c.REFERENCE + 1] + share * table[c.CENTRE + 1]
    z = table[c.REFERENCE + 2] + share * table[c.CENTRE + 2]
    return (
        position[0] - origin[0] - (axes[0] * x + axes[1] * y + axes[2] * z),
        position[1] - origin[1] - (axes[3] * x + axes[4] * y + axes[5] * z),
        position[2] - origin[2] - (axes[6] * x + axes[7] * y + axes[8] * z),
    )


@njit
def site_height(d: int, o: Ints64, site: int) -> float:
    """Return the height of a site in W [m]."""
    return read_double(read_int64(d + o[f.SITE_XPOS]) + 8 * (3 * site + 2))


@njit
def submersion(m: int, d: int, o: Ints64, site: int, body: int, radius: float) -> float:
    """Return the submerged fraction of a part with a radius [m] about a site, 0..1."""
    height = site_height(d, o, site)
    surface = read_double(read_int64(m + o[f.BODY_USER]) + 8 * c.SURFACE)
    surface += read_double(read_int64(d + o[f.USERDATA]) + 8 * (c.WATER_COLUMNS * body + 6))
    return submerged_share(surface, height, radius)


@njit_borrowed
def submerged_share(surface: float, height: float, radius: float) -> float:
    """Return the submerged fraction of a part, 0..1.

    Args:
        surface: the height of the surface in W [m].
        height: the height of the middle of the part [m].
        radius: the radius of the part [m].
    """
    return min(max(0.5 + 0.5 * (surface - height) / radius, 0.0), 1.0)


@njit
def submerged_middle(m: int, d: int, o: Ints64, body: int, height: float) -> float:
    """Return `submerged_height` of a body in MuJoCo's memory [m].

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        body: the id of the body.
        height: the height of the point at which the water acts on the whole body [m].
    """
    tables = read_int64(m + o[f.BODY_USER])
    table = view_doubles(tables + 8 * c.BODY_COLUMNS * body, c.BODY_COLUMNS)
    water = view_doubles(
        read_int64(d + o[f.USERDATA]) + 8 * c.WATER_COLUMNS * body, c.WATER_COLUMNS
    )
    surface = read_double(tables + 8 * c.SURFACE)
    axes = view_doubles(read_int64(d + o[f.XMAT]) + 72 * body, 9)
    origin = read_double(read_int64(d + o[f.XPOS]) + 8 * (3 * body + 2))
    return submerged_height(table, water, axes, origin, surface, height, np.empty(MEMORY))


@njit_borrowed
def submerged_height(
    table: Floats,
    water: Floats,
    axes: Floats,
    origin: float,
    surface: float,
    height: float,
    memory: Floats,
) -> float:
    """Return the height in the world of the centre of a body's submerged part [m].

    The surface is that of the last step.

    Args:
        table: the row of the body (`columns`).
        water: the row of the water at the body (`columns`).
        axes: the rotation ``world_from_body`` by rows, (9,).
        origin: the height of the body's origin in W [m].
        surface: the height of the still water in W [m].
        height: the height of the point at which the water acts on the whole body [m], which is
            returned unless the body pierces the surface.
        memory: scratch memory, (`submersion.MEMORY`,).
    """
    if surface + water[c.ELEVATION] - height >= 2.0 * table[c.REACH]:
        return height
    x, y, z = table[c.REFERENCE], table[c.REFERENCE + 1], table[c.REFERENCE + 2]
    reference = origin + axes[6] * x + axes[7] * y + axes[8] * z
    up, depth = surface_plane(table, axes, reference, surface, water)
    fraction, centre = submerged_part(table, up, depth, memory)
    if table[c.KIND] == c.DRY_BODY or fraction <= 0.0:
        return height
    middle: float = reference + axes[6] * centre[0] + axes[7] * centre[1] + axes[8] * centre[2]
    return middle


@njit
def water_density(m: int, o: Ints64) -> float:
    """Return the density of the model's water [kg/m3]."""
    density: float = read_double(read_int64(m + o[f.BODY_USER]) + 8 * c.DENSITY)
    return density


@njit
def add_force(
    m: int, d: int, o: Ints64, site: int, body: int,
    force: Three, torque: float, work: Floats,
) -> None:  # fmt: skip
    """Add a force at a site, and a torque proportional to the force, to the wrench of a body.

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        site: the id of the site.
        body: the id of the site's body.
        force: the force in the axes of the site [N].
        torque: the torque along the force, per force [m].
        work: the rows of the bodies.
    """
    position = view_doubles(read_int64(d + o[f.SITE_XPOS]) + 24 * site, 3)
    axes = view_doubles(read_int64(d + o[f.SITE_XMAT]) + 72 * site, 9)
    root = read_int32(read_int64(m + o[f.BODY_ROOT]) + 4 * body)
    com = view_doubles(read_int64(d + o[f.COM]) + 24 * root, 3)
    x, y, z = force
    fx = axes[0] * x + axes[1] * y + axes[2] * z
    fy = axes[3] * x + axes[4] * y + axes[5] * z
    fz = axes[6] * x + axes[7] * y + axes[8] * z
    rx, ry, rz = position[0] - com[0], position[1] - com[1], position[2] - com[2]
    base = f.ROW * body
    k = base + f.WRENCH
    work[base + f.IS_ACTIVE] = 1.0
    work[k] += ry * fz - rz * fy + torque * fx
    work[k + 1] += rz * fx - rx * fz + torque * fy
    work[k + 2] += rx * fy - ry * fx + torque * fz
    work[k + 3] += fx
    work[k + 4] += fy
    work[k + 5] += fz
