r"""The frame of a part on a link and the motion of its points, in compiled code.

With the Jacobian J of a point, :math:`v = J \dot q` and :math:`a = J \ddot q + \dot J \dot q`. The
columns of J are those of the joints from the root of the tree of links to the link; the others are
zero. They are computed in MuJoCo's order (``mj_comPos``, ``mj_comVel``, ``mj_jac``, ``mj_jacDot``),
about the centre of mass of the tree, so that they have the bytes of MuJoCo's.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import compose
from ...base.numerics.memory import carray, pointer, view_doubles, view_int32s, view_int64s

CHAIN = np.dtype(
    [
        ("root", np.int64),  # the first body of the tree; its bodies have consecutive numbers
        ("n_bodies", np.int64),
        ("dofs", np.int64),  # `DOF_COLUMNS` numbers a degree of freedom, from root to link
        ("n_dofs", np.int64),
        ("parents", np.int64),  # addresses of MuJoCo's arrays
        ("masses", np.int64),
        ("tree_masses", np.int64),
        ("centres", np.int64),
        ("axes", np.int64),
        ("anchors", np.int64),
        ("joint_axes", np.int64),
        ("speeds", np.int64),  # of all degrees of freedom [m/s, rad/s]
        ("accelerations", np.int64),  # of all degrees of freedom [m/s2, rad/s2]
        ("scratch", np.int64),  # `scratch_size` numbers
    ],
    align=True,
)
"""The joints that move a body, and the addresses of their numbers."""

MOUNT = np.dtype(
    [
        ("origin", np.int64),  # addresses of the link's position and axes in W
        ("axes", np.int64),
        ("base_axes", np.int64),  # of the axes of a scaled vehicle's base; 0: it has no scale
        ("scale", np.float64, 3),
        ("position", np.float64, 3),  # of the part on the link [m]
        ("rotation", np.float64, (3, 3)),
        ("chain", CHAIN),
    ],
    align=True,
)
"""A part on a link."""

DOF_COLUMNS = 4
"""The columns of a degree of freedom: its number, its kind, its body and its joint."""
TRANSLATION, ROTATION, SLIDE, HINGE = range(4)
"""The kinds of degrees of freedom: translation and rotation of a free joint, joints of one axis."""
_MINVAL = 1e-15  # mjMINVAL

Record = Any


def scratch_size(n_bodies: int, n_dofs: int) -> int:
    """Return how many numbers of scratch memory a chain needs."""
    return 3 * n_bodies + 12 * n_dofs


@njit
def write_frame(mount: Record, frame: Array) -> None:
    """Write the position in W [m] and the axes of a part, by rows, into (12,).

    The scale of a vehicle moves the part and does not turn it.
    """
    origin, axes = view_doubles(mount.origin, 3), view_doubles(mount.axes, 9).reshape((3, 3))
    shift, turn = compose(axes, origin, mount.rotation, mount.position)
    if mount.base_axes != 0:
        base = view_doubles(mount.base_axes, 9).reshape((3, 3))
        matrix = scaled_axes(base, axes, mount.scale)
        for i in range(3):
            offset = 0.0
            for k in range(3):
                offset += matrix[i, k] * mount.position[k]
            shift[i] = origin[i] + offset
    for i in range(3):
        frame[i] = shift[i]
        for k in range(3):
            frame[3 + 3 * i + k] = turn[i, k]


@njit
def compute_frame(mounts: Record) -> Array:
    """Return the values of `write_frame` for the first of some records, (12,)."""
    frame = np.empty(12)
    write_frame(mounts[0], frame)
    return frame


@njit
def compute_motion(chains: Record, point: Array) -> Array:
    """Return the values of `write_motion` for the first of some records, (9,)."""
    motion = np.empty(9)
    write_motion(chains[0], point, motion)
    return motion


@njit
def scaled_axes(base: Array, axes: Array, scale: Array) -> Array:
    """Return the axes of a link with the scale along its vehicle's base in them, (3, 3)."""
    in_base, matrix = np.empty((3, 3)), np.empty((3, 3))
    for i in range(3):
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += base[j, i] * axes[j, k]
            in_base[i, k] = total
    for i in range(3):
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += (base[i, j] * scale[j]) * in_base[j, k]
            matrix[i, k] = total
    return matrix


@njit
def write_motion(chain: Record, point: Array, motion: Array) -> None:
    """Write velocity, angular velocity and acceleration of a point, in W, into (9,).

    Args:
        chain: the joints that move the point.
        point: the point in W, (3,) [m].
        motion: receives the numbers, (9,).
    """
    for i in range(9):
        motion[i] = 0.0
    n = chain.n_dofs
    if n == 0:
        return
    scratch = chain.scratch + 24 * chain.n_bodies
    columns = view_doubles(scratch, 6 * n).reshape((n, 6))  # turn and shift by each joint
    changes = view_doubles(scratch + 48 * n, 6 * n).reshape((n, 6))  # their rates of change
    centre, twist, offset = np.empty(3), np.zeros(6), np.empty(3)
    tree_centre(chain, centre)
    joint_columns(chain, centre, columns, changes, twist)
    for i in range(3):
        offset[i] = point[i] - centre[i]
    v_point = np.empty(3)  # by the twist of the link
    for i in range(3):
        v_point[i] = twist[3 + i] - cross(offset, twist, i)
    dofs = view_int64s(chain.dofs, DOF_COLUMNS * n).reshape((n, DOF_COLUMNS))
    for i in range(3):
        velocity, omega, joint_term, bias_term = 0.0, 0.0, 0.0, 0.0
        for k in range(n):
            column, change = columns[k], changes[k]
            speed = view_doubles(chain.speeds + 8 * dofs[k, 0], 1)[0]
            acceleration = view_doubles(chain.accelerations + 8 * dofs[k, 0], 1)[0]
            jacobian = column[3 + i] + cross(column, offset, i)
            velocity += jacobian * speed
            omega += column[i] * speed
            joint_term += jacobian * acceleration
            bias_term += (
                change[3 + i] + cross(change, offset, i) + cross(column, v_point, i)
            ) * speed
        motion[i], motion[3 + i], motion[6 + i] = velocity, omega, joint_term + bias_term


@njit
def tree_centre(chain: Record, centre: Array) -> None:
    """Write the centre of mass of the tree of links into (3,) [m]."""
    root, n = chain.root, chain.n_bodies
    masses, parents = (
        view_doubles(chain.masses + 8 * root, n),
        view_int32s(chain.parents + 4 * root, n),
    )
    centres = view_doubles(chain.centres + 24 * root, 3 * n)
    mass = view_doubles(chain.tree_masses + 8 * root, 1)[0]
    moments = view_doubles(chain.scratch, 3 * n)
    for body in range(n):
        for i in range(3):
            moments[3 * body + i] = centres[3 * body + i] * masses[body]
    for body in range(n - 1, 0, -1):
        parent = parents[body] - root
        for i in range(3):
            moments[3 * parent + i] += moments[3 * body + i]
    share = 0.0 if mass < _MINVAL else 1.0 / mass
    for i in range(3):
        centre[i] = centres[i] if mass < _MINVAL else moments[i] * share


@njit
def joint_columns(
    chain: Record, centre: Array, columns: Array, changes: Array, twist: Array
) -> None:
    """Write the twist per joint about the centre, its rate of change, and the twist of the link."""
    n = chain.n_dofs
    dofs = view_int64s(chain.dofs, DOF_COLUMNS * n).reshape((n, DOF_COLUMNS))
    axis, offset, total = np.empty(3), np.empty(3), np.empty(6)
    k = 0
    while k < n:
        kind, body, joint = dofs[k, 1], dofs[k, 2], dofs[k, 3]
        anchor = view_doubles(chain.anchors + 24 * joint, 3)
        for i in range(3):
            offset[i] = centre[i] - anchor[i]
        width = 3 if kind in (TRANSLATION, ROTATION) else 1
        for j in range(width):
            column = columns[k + j]
            for i in range(6):
                column[i] = 0.0
            if kind == TRANSLATION:
                column[3 + j] = 1.0
                continue
            if kind == ROTATION:
                matrix = view_doubles(chain.axes + 72 * body, 9)
                for i in range(3):
                    axis[i] = matrix[3 * i + j]
            else:
                axis[:] = view_doubles(chain.joint_axes + 24 * joint, 3)
            if kind == SLIDE:
                column[3:] = axis
                continue
            column[:3] = axis
            for i in range(3):
                column[3 + i] = cross(axis, offset, i)
        if kind in (SLIDE, HINGE):
            write_column_rate(twist, columns[k], changes[k])
        for i in range(6):
            total[i] = 0.0
            for j in range(width):
                total[i] += (
                    columns[k + j, i] * view_doubles(chain.speeds + 8 * dofs[k + j, 0], 1)[0]
                )
            twist[i] += total[i]
        for j in range(width):
            if kind == TRANSLATION:
                changes[k + j, :] = 0.0
            elif kind == ROTATION:  # of a quaternion, by the twist with the joint's own
                write_column_rate(twist, columns[k + j], changes[k + j])
        k += width


@njit
def write_column_rate(twist: Array, column: Array, rate: Array) -> None:
    """Write the rate of change of a joint's column that moves with a twist (6,) into (6,)."""
    for i in range(3):
        rate[i] = cross(twist, column, i)
        rate[3 + i] = cross(twist, column[3:], i) + cross(twist[3:], column, i)


@njit
def cross(left: Array, right: Array, i: int) -> float:
    """Return a component of the vector product of two vectors' first three numbers."""
    j, k = (i + 1) % 3, (i + 2) % 3
    component: float = left[j] * right[k] - left[k] * right[j]
    return component


def write_mount_frame(record_address: int, values_address: int, time: float) -> None:
    """Write the frame of a part; see `uwsim.base.numerics.calls`."""
    write_frame(carray(pointer(record_address), (1,), MOUNT)[0], view_doubles(values_address, 12))


def write_mount_motion(record_address: int, values_address: int, time: float) -> None:
    """Write the motion of a part's point behind the point, (3,), in the same array, (12,)."""
    mount = carray(pointer(record_address), (1,), MOUNT)[0]
    write_motion(mount.chain, view_doubles(values_address, 3), view_doubles(values_address + 24, 9))
