"""The water at one link: its wrench, momentum and inertia, on plain numbers and arrays.

`kernel` applies this function to MuJoCo's memory, `free_step` to one row of a batch.
"""

from __future__ import annotations

from typing import NamedTuple

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats
from .. import columns as c
from . import fields as f
from .equations import (
    Six,
    add_wrench,
    bias_acceleration,
    buoyancy,
    coriolis,
    diagonal_force,
    diagonal_momentum,
    drag_slopes,
    drag_speeds,
    entered_share,
    full_force,
    move_wrench,
    reference_point,
    relative_twist,
    submerged_part,
    subtract,
    subtract_momentum_rate,
    surface_plane,
    to_body,
)
from .inertias import (
    add_diagonal_inertia,
    add_full_inertia,
    diagonal_inertia,
    is_significant,
    subtract_added_mass,
)
from .stratification import density_at_height

_NO_MOMENTUM = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class LinkMotion(NamedTuple):
    """The numbers of a link in a step."""

    table: Floats
    """The row of the link (`columns`), (160,)."""
    position: Floats
    """The position in W, (3,) [m]."""
    axes: Floats
    """The rotation ``world_from_link`` by rows, (9,)."""
    com: Floats
    """The centre of mass of the tree in W, (3,) [m]."""
    twist: Floats
    """The spatial velocity as in MuJoCo, (6,)."""
    water: Floats
    """The row of the water at the link (`columns`), (12,)."""


class StepNumbers(NamedTuple):
    """The numbers of a step that hold for all links."""

    world: Floats
    """The row of the world (`columns`), (160,)."""
    gravity: Floats
    """The acceleration of gravity in W, (3,) [m/s2]."""
    gravity_scale: float
    """1, or 0 without gravity."""
    timestep: float
    """The length of the step [s]."""
    implicit_time: float
    """The time over which drag is implicit, for links with an implicitness of 1 [s]."""
    has_inertia: bool
    """The question whether the inertia and the momentum of the water are computed, too."""


@njit_borrowed
def add_link(
    link: LinkMotion, numbers: StepNumbers, bias: Six, work: Floats, base: int, scratch: int,
    drag: int,
) -> tuple[bool, Six]:  # fmt: skip
    """Add the wrench and the inertia of the water at a link.

    Args:
        link: the numbers of the link.
        numbers: the numbers of the step.
        bias: the spatial acceleration of the link without joint accelerations.
        work: the array to which they are added (`fields`).
        base: the index of the row of the link.
        scratch: the index of scratch memory.
        drag: the index of the implicit drag of the tree.

    Returns:
        True if a part of the link is under water, and the momentum of the added mass.
    """
    table, axes, water = link.table, link.axes, link.water
    memory = work[scratch : scratch + f.SCRATCH]
    height, lever = reference_point(table, link.position, axes, link.com)
    up, depth = surface_plane(table, axes, height, numbers.world[c.SURFACE], water)
    fraction, centre = submerged_part(table, up, depth, memory)
    if fraction <= 0.0:
        return False, _NO_MOMENTUM
    nu = relative_twist(axes, lever, link.twist, water)
    growth = 0.0
    x, y, z = centre
    if depth - (up[0] * x + up[1] * y + up[2] * z) < 2.0 * table[c.REACH]:
        timestep = numbers.timestep
        growth = entered_share(table, up, depth, fraction, nu, timestep, memory) / timestep
    if numbers.world[c.N_LEVELS] > 0.0:
        centre_height = height + axes[6] * x + axes[7] * y + axes[8] * z
        fraction *= density_at_height(numbers.world, centre_height)
    step = numbers.implicit_time * table[c.DRAG_IMPLICITNESS]
    omega = to_body(axes, link.twist[0], link.twist[1], link.twist[2])
    rate = bias_acceleration(axes, lever, bias, water, omega)
    s = drag_speeds(table, nu)
    slope = drag_slopes(table, nu, s)
    if table[c.KIND] == c.FULL_MATRICES:
        force, momentum = full_force(table, nu, rate, step, work, scratch)
    else:
        force = diagonal_force(table, nu, rate, s, slope, step)
        momentum = diagonal_momentum(table, nu)
    force = subtract(force, coriolis(nu, omega, momentum))
    if growth > 0.0:
        force = subtract_momentum_rate(force, momentum, growth)
    wrench = move_wrench(axes, lever, fraction, force)
    displaced_mass = fraction * table[c.DISPLACED_MASS]
    lift = buoyancy(displaced_mass, water, numbers.gravity, numbers.gravity_scale)
    add_wrench(axes, lever, centre, wrench, lift, work, base + f.WRENCH)
    if not numbers.has_inertia:
        return True, _NO_MOMENTUM
    if table[c.KIND] == c.FULL_MATRICES:
        add_full_inertia(axes, lever, fraction, work, scratch, base + f.FF)
        if subtract_added_mass(table, work, scratch):
            add_full_inertia(axes, lever, fraction, work, scratch, drag)
    else:
        inertia, change = diagonal_inertia(table, slope, fraction, step)
        add_diagonal_inertia(axes, lever, inertia, work, base + f.FF)
        if is_significant(inertia, change):
            add_diagonal_inertia(axes, lever, change, work, drag)
    return True, move_wrench(axes, lever, fraction, momentum)
