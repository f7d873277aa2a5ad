r"""Thrust allocation: the axes that a vehicle's thrusters drive, and their limits.

One newton of thruster i along its direction d at the place r gives the force and moment
:math:`(d, (r - r_0) \times d)` about the reference :math:`r_0`; they are the columns of the matrix
B (Fossen, *Handbook of Marine Craft*, 2011, section 12.3). An axis is *driven* if thrusts can give
its force or moment alone, nothing along the other axes that are driven: if its row of B is not made
of theirs, by more than `MIN_LEVER`. Where rows are made of one another the first in the order
`FIRST` is driven and the others are left to the hull.

Roll and pitch that are not driven are held by weight and buoyancy alone. A force that comes with a
moment about them is asked for only as far as the hull stays within `LEAN`; where less than half of
it would be left of heave, the thrusters hold the hull level instead, and heave is not driven.

Not modelled: thrusters on links that move stand where the joints are at the start; what fins give.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, length, product, pseudo_inverse, rotate
from ...scene.hydrodynamics.spec import ThrusterSpec
from ...scene.urdf.kinematics import link_poses
from ...scene.urdf.robot import RobotSpec

AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
UNITS = ("N", "N", "N", "N m", "N m", "N m")
SURGE, SWAY, HEAVE, ROLL, PITCH, YAW = range(6)
FIRST = (SURGE, YAW, HEAVE, SWAY, PITCH, ROLL)
"""What is driven first where thrusters cannot do all."""
MIN_LEVER = 0.02
"""What moves a vehicle less than this per newton of its thrusters is not asked of them [1, m]."""
LEAN = math.radians(20.0)
"""How far thrusters may push a hull over that rights itself [rad]."""
ENOUGH = 0.5
"""Share of the heave that must be left for it to be driven."""
N_POINTS = 401
"""Points of a thruster's curve in the autopilot's table."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Allocation:
    """The thrust allocation of a vehicle."""

    axes: tuple[int, ...]
    """The axes that are driven, rising."""
    wrenches: Array
    """Force and moment about the reference of one newton of each, (6, n) [1, m]."""
    reached: Array
    """The rows of the driven axes, (k, n)."""
    share: Array
    """Thrusts for a unit of each driven axis, (n, k) [N per N or N m]."""
    most: Array
    """Force that a driven axis is asked for at most lest the hull leans, (6,) [N]; else inf."""
    least: Array
    """Thrusts backwards, (n,) [N]."""
    greatest: Array
    """Thrusts forwards, (n,) [N]."""

    @property
    def drives(self) -> Array:
        """1 for each driven axis, 0 for the others, (6,)."""
        flags = np.zeros(6)
        flags[list(self.axes)] = 1.0
        return flags

    def reach(self, axis: int) -> tuple[float, float]:
        """Force or moment of a driven axis alone, backwards and forwards [N, N m]."""
        column = self.share[:, self.axes.index(axis)]
        full = _reach(column, self.least, self.greatest)
        return -min(-full[0], self.most[axis]), min(full[1], self.most[axis])

    def full_reach(self, axis: int) -> tuple[float, float]:
        """The same without the limit on the heel of the hull."""
        return _reach(self.share[:, self.axes.index(axis)], self.least, self.greatest)


def allocate(
    thrusters: Sequence[ThrusterSpec], reference: Array, stiffness: float = math.inf
) -> Allocation:
    """Compute the allocation of some thrusters.

    Args:
        thrusters: places and directions in the base's frame.
        reference: what forces and moments are about, (3,) [m].
        stiffness: with which the hull rights itself [N m/rad]; not above 0: it does not.
    """
    columns = [wrench(thruster, reference) for thruster in thrusters]
    wrenches = np.array(columns).reshape(-1, 6).T  # (6, n): N, N m per N
    ends = [(thrusts[0], thrusts[-1]) for thrusts, _ in map(curve, thrusters)]
    least, greatest = np.array(ends).reshape(-1, 2).T.copy()  # (n,) [N]
    axes = driven_axes(wrenches, FIRST)
    found = _allocation(wrenches, axes, least, greatest, stiffness)
    if HEAVE in axes and PITCH not in axes:
        level = driven_axes(wrenches, [axis for axis in FIRST if axis != HEAVE])
        full = max(found.full_reach(HEAVE))
        is_weak = stiffness <= 0.0 and _moment(found, HEAVE)[PITCH] > MIN_LEVER
        if PITCH in level and (is_weak or found.most[HEAVE] < ENOUGH * full):
            return _allocation(wrenches, level, least, greatest, stiffness)
    return found


def thrusters_on_base(
    robot: RobotSpec, thrusters: Sequence[ThrusterSpec], joint_values: Sequence[float] = ()
) -> tuple[ThrusterSpec, ...]:
    """Thrusters that sit on other links, as if they sat on the base where these are at the start.

    Args:
        robot: the links.
        thrusters: each in the frame of its link.
        joint_values: its joints [rad or m].
    """
    poses = link_poses(robot, joint_values)
    found = []
    for thruster in thrusters:
        if thruster.link != robot.root:
            base_from_link = poses[thruster.link]
            x, y, z = base_from_link.transform(np.array([thruster.position]))[0].tolist()
            a, b, c = rotate(base_from_link.rotation, np.array(thruster.direction)).tolist()
            thruster = replace(thruster, position=(x, y, z), direction=(a, b, c))
        found.append(thruster)
    return tuple(found)


def driven_axes(wrenches: Array, order: Sequence[int]) -> tuple[int, ...]:
    """Axes whose rows of (6, n) are not made of those before them, rising.

    Args:
        wrenches: force and moment of one newton of each thruster.
        order: which axes, the most wanted first.
    """
    basis: list[Array] = []
    driven = []
    for axis in order:
        rest = wrenches[axis].copy()
        for unit in basis:
            rest -= dot(rest, unit) * unit
        size = length(rest)
        if size > MIN_LEVER:
            basis.append(rest / size)
            driven.append(axis)
    return tuple(sorted(driven))


def wrench(thruster: ThrusterSpec, reference: Array) -> Array:
    """Force and moment about the reference of one newton of a thruster, (6,)."""
    direction = np.array(thruster.direction, dtype=np.float64)
    direction /= length(direction)
    arm = np.array(thruster.position) - reference
    return np.concatenate([direction, np.cross(arm, direction)])


@lru_cache(maxsize=256)
def curve(thruster: ThrusterSpec) -> tuple[Array, Array]:
    """Thrust [N] and the command that gives it [1], both rising."""
    commands = np.linspace(*thruster.limits, N_POINTS)
    backward = thruster.forward if thruster.backward is None else thruster.backward
    thrusts = []
    for command in commands:
        size = max(0.0, abs(command) - thruster.dead_zone)
        numbers = thruster.forward if command > 0.0 else backward
        force = sum(c * size ** (i + 1) for i, c in enumerate(numbers))
        thrusts.append(math.copysign(force, command))
    found = np.maximum.accumulate(np.array(thrusts)), commands
    for each in found:
        each.flags.writeable = False  # whoever asks again gets the same
    return found


def _allocation(
    wrenches: Array, axes: tuple[int, ...], least: Array, greatest: Array, stiffness: float
) -> Allocation:
    reached = np.ascontiguousarray(wrenches[list(axes)])  # (k, n)
    share = np.ascontiguousarray(pseudo_inverse(reached, rcond=1e-6))
    found = Allocation(
        axes=axes,
        wrenches=wrenches,
        reached=reached,
        share=share,
        most=np.full(6, np.inf),
        least=least,
        greatest=greatest,
    )
    for axis in (SURGE, SWAY, HEAVE):
        if axis in axes and stiffness > 0.0:
            lever = max(_moment(found, axis))
            if lever > 0.0:
                found.most[axis] = stiffness * math.sin(LEAN) / lever
    return found


def _moment(found: Allocation, axis: int) -> Array:
    """Moments about undriven roll and pitch that a force along an axis causes, (6,)."""
    moments = np.abs(product(found.wrenches, found.share[:, found.axes.index(axis)]))
    for other in range(6):
        if other not in (ROLL, PITCH) or other in found.axes:
            moments[other] = 0.0
    return moments


def _reach(column: Array, least: Array, greatest: Array) -> tuple[float, float]:
    """Greatest multiple of a thrust distribution before the first thruster saturates, both ways."""
    ends = []
    for sign in (-1.0, 1.0):
        ways = sign * column
        room = [
            (greatest[k] if way > 0.0 else least[k]) / way
            for k, way in enumerate(ways)
            if abs(way) > 1e-12
        ]
        ends.append(sign * min(room, default=0.0))
    return ends[0], ends[1]
