r"""The frame of a part mounted on a link, and the motion of points on the link, compiled.

With the Jacobian J of a point, :math:`v = J \dot q` and :math:`a = J \ddot q + \dot J \dot q`. Only
the columns of the joints from the root of the tree of links to the link are not zero. They are
computed about the centre of mass of the tree, in the order of MuJoCo's operations (``mj_comPos``,
``mj_comVel``, ``mj_jac``, ``mj_jacDot``), so that the results equal MuJoCo's to the bit. W is the
world frame.
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
        ("n_bodies", np.int64),  # the number of bodies of the tree
        ("dofs", np.int64),  # the address of (n_dofs, `DOF_COLUMNS`) numbers, from root to link
        ("n_dofs", np.int64),
        ("parents", np.int64),  # the addresses of MuJoCo's arrays: ``body_parentid``,
        ("masses", np.int64),  # ``body_mass``,
        ("tree_masses", np.int64),  # ``body_subtreemass``,
        ("centres", np.int64),  # ``xipos``,
        ("axes", np.int64),  # ``xmat``,
        ("anchors", np.int64),  # ``xanchor``,
        ("joint_axes", np.int64),  # ``xaxis``
        ("speeds", np.int64),  # the address of the speeds of all dofs [m/s, rad/s]
        ("accelerations", np.int64),  # the address of their accelerations [m/s2, rad/s2]
        ("scratch", np.int64),  # the address of `scratch_size` numbers
    ],
    align=True,
)
"""The degrees of freedom (dofs) that move a body, and the addresses of arrays about them."""

MOUNT = np.dtype(
    [
        ("origin", np.int64),  # the addresses of the link's position and axes in W
        ("axes", np.int64),
        ("base_axes", np.int64),  # the address of the axes of a scaled vehicle's base; 0: no scale
        ("scale", np.float64, 3),  # along the axes of the base [1]
        ("position", np.float64, 3),  # of the part in the frame of the link [m]
        ("rotation", np.float64, (3, 3)),  # ``link_from_part``
        ("chain", CHAIN),
    ],
    align=True,
)
"""A part mounted on a link."""

DOF_COLUMNS = 4
"""The number of columns for a degree of freedom: its index, its kind, its body and its joint."""
TRANSLATION, ROTATION, SLIDE, HINGE = range(4)
"""The kinds of degrees of freedom: translation or rotation of a free joint, and the motion of a
slide or hinge joint."""
_MINVAL = 1e-15  # mjMINVAL

Record = Any


def scratch_size(n_bodies: int, n_dofs: int) -> int:
    """Return the number of floats in the scratch memory of a chain."""
    return 3 * n_bodies + 12 * n_dofs


@njit
def write_frame(mount: Record, frame: Array) -> None:
    """Compute the frame of a part; the scale of a vehicle moves the part without turning it.

    Args:
        mount: a record of `MOUNT`.
        frame: receives the position in W [m] and the rotation ``world_from_part`` by rows, (12,).
    """
    origin, axes = view_doubles(mount.origin, 3), view_doubles(mount.axes, 9).reshape((3, 3))
    position, rotation = compose(axes, origin, mount.rotation, mount.position)
    if mount.base_axes != 0:
        base = view_doubles(mount.base_axes, 9).reshape((3, 3))
        matrix = scaled_axes(base, axes, mount.scale)
        for i in range(3):
            offset = 0.0
            for k in range(3):
                offset += matrix[i, k] * mount.position[k]
            position[i] = origin[i] + offset
    for i in range(3):
        frame[i] = position[i]
        for k in range(3):
            frame[3 + 3 * i + k] = rotation[i, k]


@njit
def compute_frame(mounts: Record) -> Array:
    """Return the values of `write_frame` for a record of `MOUNT`, (1,), from Python, (12,)."""
    frame = np.empty(12)
    write_frame(mounts[0], frame)
    return frame


@njit
def compute_motion(chains: Record, point: Array) -> Array:
    """Return the values of `write_motion` for a record of `CHAIN`, (1,), from Python, (9,)."""
    motion = np.empty(9)
    write_motion(chains[0], point, motion)
    return motion


@njit
def scaled_axes(base: Array, axes: Array, scale: Array) -> Array:
    """Return the axes of a link with the vehicle's scale included, (3, 3).

    Args:
        base: the rotation ``world_from_base``, (3, 3).
        axes: the rotation ``world_from_link``, (3, 3).
        scale: the scale along the axes of the base, (3,) [1].
    """
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
    """Compute the motion of a point on a body.

    Args:
        chain: a record of `CHAIN`, with the joints that move the point.
        point: the point in W, (3,) [m].
        motion: receives the velocity [m/s], the angular velocity [rad/s] and the acceleration
            [m/s2] in W, (9,).
    """
    for i in range(9):
        motion[i] = 0.0
    n = chain.n_dofs
    if n == 0:
        return
    scratch = chain.scratch + 24 * chain.n_bodies
    columns = view_doubles(scratch, 6 * n).reshape((n, 6))  # the twist per speed of each dof
    changes = view_doubles(scratch + 48 * n, 6 * n).reshape((n, 6))  # their rates of change
    centre, twist, offset = np.empty(3), np.zeros(6), np.empty(3)
    tree_centre(chain, centre)
    joint_columns(chain, centre, columns, changes, twist)
    for i in range(3):
        offset[i] = point[i] - centre[i]
    v_point = np.empty(3)  # the velocity of the point [m/s]
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
    """Write the centre of mass of the tree of links in W into ``centre``, (3,) [m]."""
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
    """Compute the Jacobian of a link about a centre, rotational part first.

    Args:
        chain: a record of `CHAIN`.
        centre: the centre of mass of the tree in W, (3,) [m].
        columns: receives the twist per speed of each degree of freedom, (n, 6).
        changes: receives the rates of change of these columns, (n, 6).
        twist: receives the twist of the link about the centre in W, (6,); zero at the start.
    """
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
            elif kind == ROTATION:  # of a quaternion: by the twist that includes this joint
                write_column_rate(twist, columns[k + j], changes[k + j])
        k += width


@njit
def write_column_rate(twist: Array, column: Array, rate: Array) -> None:
    """Write the rate of change of a joint's column (6,), which moves with a twist (6,)."""
    for i in range(3):
        rate[i] = cross(twist, column, i)
        rate[3 + i] = cross(twist, column[3:], i) + cross(twist[3:], column, i)


@njit
def cross(left: Array, right: Array, i: int) -> float:
    """Return component i of the cross product of the first three elements of two arrays."""
    j, k = (i + 1) % 3, (i + 2) % 3
    component: float = left[j] * right[k] - left[k] * right[j]
    return component


def write_mount_frame(record_address: int, values_address: int, time: float) -> None:
    """Write the frame of a part, as `write_frame`; see `uwsim.base.numerics.calls`."""
    write_frame(carray(pointer(record_address), (1,), MOUNT)[0], view_doubles(values_address, 12))


def write_mount_motion(record_address: int, values_address: int, time: float) -> None:
    """Read a point (3,) and write its motion (9,), as `write_motion`, behind it in an array."""
    mount = carray(pointer(record_address), (1,), MOUNT)[0]
    write_motion(mount.chain, view_doubles(values_address, 3), view_doubles(values_address + 24, 9))
