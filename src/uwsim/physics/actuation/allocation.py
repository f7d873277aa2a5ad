r"""Thrust allocation: the axes that a vehicle's thrusters drive, and their limits.

One newton of thruster i along its direction d at the position r exerts the force and moment
:math:`(d, (r - r_0) \times d)` about the reference point :math:`r_0`; these are the columns of the
matrix B (Fossen, *Handbook of Marine Craft*, 2011, section 12.3). An axis is *driven* if the
thrusters can exert a force or moment along it without any along the other driven axes: its row of B
differs by more than `MIN_LEVER` from every linear combination of their rows. Of linearly dependent
rows, the first in the order `AXIS_PRIORITY` is driven, and the others are not.

Roll and pitch that are not driven are held by weight and buoyancy alone. A force whose thrusts also
exert a moment about roll or pitch is therefore limited, so that the hull tilts by at most
`MAX_TILT`. If less than half of the heave force would remain, or if the hull does not right itself
and heave would tilt it, the thrusters drive pitch instead of heave.

Not modelled: forces of fins; motion of thrusters on links, whose initial positions are used.
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
AXIS_PRIORITY = (SURGE, YAW, HEAVE, SWAY, PITCH, ROLL)
"""The axes in order of priority, for thrusters that cannot drive all of them."""
MIN_LEVER = 0.02
"""The minimum force [N] or moment [N m] per newton of thrust with which thrusters drive an axis."""
MAX_TILT = math.radians(20.0)
"""The greatest angle by which thrusters may tilt a hull that rights itself [rad]."""
MIN_HEAVE_SHARE = 0.5
"""The minimum fraction of the heave force that must remain for heave to be driven [1]."""
N_POINTS = 401
"""The number of points of a tabulated thrust curve."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Allocation:
    """The thrust allocation of a vehicle with n thrusters that drive k axes, in base axes."""

    axes: tuple[int, ...]
    """The indices of the driven axes, in ascending order."""
    wrenches: Array
    """The force and moment about the reference point per newton of each thruster, (6, n) [1, m]."""
    driven_wrenches: Array
    """The rows of `wrenches` for the driven axes, (k, n): the thruster allocation matrix (TAM) of
    UUV Simulator without the other axes."""
    inverse_allocation_matrix: Array
    """The pseudo-inverse of `driven_wrenches`: the thrusts per unit of force or moment along each
    driven axis, (n, k) [1, 1/m]."""
    max_forces: Array
    """The force along each axis that tilts the hull by `MAX_TILT`, (6,) [N]; inf if none does."""
    min_thrusts: Array
    """The greatest backward thrust of each thruster, negative, (n,) [N]."""
    max_thrusts: Array
    """The greatest forward thrust of each thruster, (n,) [N]."""

    @property
    def driven_mask(self) -> Array:
        """The mask of the driven axes, (6,): 1 for a driven axis, 0 for the others."""
        flags = np.zeros(6)
        flags[list(self.axes)] = 1.0
        return flags

    def force_limits(self, axis: int) -> tuple[float, float]:
        """Return the lower and upper limit of the force or moment along a driven axis [N, N m]."""
        column = self.inverse_allocation_matrix[:, self.axes.index(axis)]
        limits = _thruster_limits(column, self.min_thrusts, self.max_thrusts)
        return -min(-limits[0], self.max_forces[axis]), min(limits[1], self.max_forces[axis])

    def thruster_limits(self, axis: int) -> tuple[float, float]:
        """Return the limits of `force_limits` without the limit on the tilt of the hull."""
        column = self.inverse_allocation_matrix[:, self.axes.index(axis)]
        return _thruster_limits(column, self.min_thrusts, self.max_thrusts)


def allocate(
    thrusters: Sequence[ThrusterSpec], reference: Array, stiffness: float = math.inf
) -> Allocation:
    """Compute the allocation of some thrusters.

    Args:
        thrusters: the thrusters, with positions and directions in the base's frame.
        reference: the point about which moments are computed, in the base's frame, (3,) [m].
        stiffness: the righting stiffness of the hull [N m/rad]; 0 or less if the hull does not
            right itself.
    """
    columns = [wrench(thruster, reference) for thruster in thrusters]
    wrenches = np.array(columns).reshape(-1, 6).T  # (6, n): N, N m per N
    ends = [(thrusts[0], thrusts[-1]) for thrusts, _ in map(thrust_curve, thrusters)]
    min_thrusts, max_thrusts = np.array(ends).reshape(-1, 2).T.copy()  # (n,) [N]
    axes = driven_axes(wrenches, AXIS_PRIORITY)
    allocation = _allocation(wrenches, axes, min_thrusts, max_thrusts, stiffness)
    if HEAVE in axes and PITCH not in axes:
        other_axes = [axis for axis in AXIS_PRIORITY if axis != HEAVE]
        axes_without_heave = driven_axes(wrenches, other_axes)
        heave = max(allocation.thruster_limits(HEAVE))
        is_weak = stiffness <= 0.0 and _tilting_moments(allocation, HEAVE)[PITCH] > MIN_LEVER
        if PITCH in axes_without_heave and (
            is_weak or allocation.max_forces[HEAVE] < MIN_HEAVE_SHARE * heave
        ):
            return _allocation(wrenches, axes_without_heave, min_thrusts, max_thrusts, stiffness)
    return allocation


def thrusters_on_base(
    robot: RobotSpec, thrusters: Sequence[ThrusterSpec], joint_values: Sequence[float] = ()
) -> tuple[ThrusterSpec, ...]:
    """Return all thrusters in the frame of the base, with the links at their initial poses.

    Args:
        robot: the links and joints of the vehicle.
        thrusters: the thrusters, each in the frame of its link.
        joint_values: the initial joint vector [rad or m].
    """
    poses = link_poses(robot, joint_values)
    base_thrusters = []
    for thruster in thrusters:
        if thruster.link != robot.root:
            base_from_link = poses[thruster.link]
            x, y, z = base_from_link.transform(np.array([thruster.position]))[0].tolist()
            a, b, c = rotate(base_from_link.rotation, np.array(thruster.direction)).tolist()
            thruster = replace(thruster, position=(x, y, z), direction=(a, b, c))
        base_thrusters.append(thruster)
    return tuple(base_thrusters)


def driven_axes(wrenches: Array, order: Sequence[int]) -> tuple[int, ...]:
    """Return the driven axes, in ascending order.

    An axis is driven if its row is linearly independent of the rows of axes with higher priority.

    Args:
        wrenches: the force and moment per newton of each thruster, (6, n) [1, m].
        order: the axes to consider, the axis with the highest priority first.
    """
    basis: list[Array] = []
    axes = []
    for axis in order:
        residual = wrenches[axis].copy()
        for basis_row in basis:
            residual -= dot(residual, basis_row) * basis_row
        norm = length(residual)
        if norm > MIN_LEVER:
            basis.append(residual / norm)
            axes.append(axis)
    return tuple(sorted(axes))


def wrench(thruster: ThrusterSpec, reference: Array) -> Array:
    """Return the force and moment about a reference point per newton of a thruster, (6,) [1, m]."""
    direction = np.array(thruster.direction, dtype=np.float64)
    direction /= length(direction)
    arm = np.array(thruster.position) - reference
    return np.concatenate([direction, np.cross(arm, direction)])


@lru_cache(maxsize=256)
def thrust_curve(thruster: ThrusterSpec) -> tuple[Array, Array]:
    """Return the thrust curve: thrusts [N] and their commands [1], both in ascending order."""
    commands = np.linspace(*thruster.limits, N_POINTS)
    backward = thruster.forward if thruster.backward is None else thruster.backward
    thrusts = []
    for command in commands:
        size = max(0.0, abs(command) - thruster.dead_zone)
        coefficients = thruster.forward if command > 0.0 else backward
        force = sum(c * size ** (i + 1) for i, c in enumerate(coefficients))
        thrusts.append(math.copysign(force, command))
    curve = np.maximum.accumulate(np.array(thrusts)), commands
    for array in curve:
        array.flags.writeable = False  # all callers receive the same cached arrays
    return curve


def _allocation(
    wrenches: Array, axes: tuple[int, ...], min_thrusts: Array, max_thrusts: Array, stiffness: float
) -> Allocation:
    driven_wrenches = np.ascontiguousarray(wrenches[list(axes)])  # (k, n)
    inverse_allocation_matrix = np.ascontiguousarray(pseudo_inverse(driven_wrenches, rcond=1e-6))
    allocation = Allocation(
        axes=axes,
        wrenches=wrenches,
        driven_wrenches=driven_wrenches,
        inverse_allocation_matrix=inverse_allocation_matrix,
        max_forces=np.full(6, np.inf),
        min_thrusts=min_thrusts,
        max_thrusts=max_thrusts,
    )
    for axis in (SURGE, SWAY, HEAVE):
        if axis in axes and stiffness > 0.0:
            moment_per_newton = max(_tilting_moments(allocation, axis))
            if moment_per_newton > 0.0:
                allocation.max_forces[axis] = stiffness * math.sin(MAX_TILT) / moment_per_newton
    return allocation


def _tilting_moments(allocation: Allocation, axis: int) -> Array:
    """Return the moments per unit of force along an axis about undriven roll and pitch, (6,) [m].

    The other elements are 0.
    """
    thrusts = allocation.inverse_allocation_matrix[:, allocation.axes.index(axis)]
    moments = np.abs(product(allocation.wrenches, thrusts))
    for other in range(6):
        if other not in (ROLL, PITCH) or other in allocation.axes:
            moments[other] = 0.0
    return moments


def _thruster_limits(column: Array, min_thrusts: Array, max_thrusts: Array) -> tuple[float, float]:
    """Return the greatest negative and positive multiples of thrusts that the thrusters can exert.

    At these multiples of the thrust vector ``column``, (n,), the first thruster saturates.
    """
    limits = []
    for sign in (-1.0, 1.0):
        thrusts = sign * column
        multiples = [
            (max_thrusts[k] if thrust > 0.0 else min_thrusts[k]) / thrust
            for k, thrust in enumerate(thrusts)
            if abs(thrust) > 1e-12
        ]
        limits.append(sign * min(multiples, default=0.0))
    return limits[0], limits[1]
