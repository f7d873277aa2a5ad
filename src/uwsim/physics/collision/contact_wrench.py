r"""The wrench of the contacts on a link, in the frame of a mount on the link.

With the force :math:`f_i` and the torque :math:`t_i` of contact i at the point :math:`p_i` in the
world frame W, and with the origin o and the rotation R of the mount in W,

.. math:: f = R^T \sum_i f_i, \qquad t = R^T \sum_i (t_i + (p_i - o) \times f_i) .

MuJoCo computes the contacts at the beginning of a step.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from ...base.geometry import Array
from ...base.numerics.calls import address_of, call_numbered, function_address
from ...base.numerics.jit import njit
from ...base.numerics.linear import cross, rotate_back
from ...base.numerics.memory import (
    Ints64,
    carray,
    pointer,
    read_int32,
    read_int64,
    view_doubles,
    view_int32s,
    view_int64s,
)
from ...base.sampling import Sampler
from ..hydrodynamics import callback
from ..hydrodynamics.kernel import fields as f
from ..kinematics.link_kernel import MOUNT, write_frame
from ..poses import Mount

CONTACT_WRENCH = np.dtype(
    [
        ("mount", np.int64),  # the address of a record of `link_kernel.MOUNT`
        ("body", np.int64),  # the MuJoCo body ID of the link
        ("model", np.int64),  # addresses of MuJoCo's structs, and of the offsets of their fields
        ("data", np.int64),
        ("offsets", np.int64),
        ("n_offsets", np.int64),
        ("contact_force", np.int64),  # the address of ``mj_contactForce``
        ("has_contacts", np.int64),  # 1 if the engine's contacts are those of the present poses
    ]
)
"""The parameters of `sample_contacts`."""

Record = Any


def contact_sampler(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    body: int,
    mount: Mount,
    prepare: Callable[[], bool],
) -> Sampler:
    """Return a sampler of the force [N] and the torque [N m] in the frame of the mount, (6,).

    Args:
        model: the engine's model.
        data: the engine's state.
        body: the MuJoCo body ID of the link.
        mount: the frame on the link.
        prepare: a function that updates the poses, and returns whether the engine's contacts are
            those of these poses.
    """
    row, offsets = np.zeros(1, CONTACT_WRENCH), callback.offsets()
    row["mount"], row["body"] = address_of(mount), body
    row["model"], row["data"] = model._address, data._address
    row["offsets"], row["n_offsets"] = address_of(offsets), len(offsets)
    row["contact_force"] = callback.function_address("mj_contactForce")

    def prepare_row(time: float) -> None:
        row["has_contacts"] = prepare()

    def can_skip_prepare(end_time: float) -> bool:
        row["has_contacts"] = True  # each step computes the contacts
        return True

    return Sampler(
        function=function_address(sample_contacts),
        parameters=row,
        n_values=6,
        prepare=prepare_row,
        can_skip_prepare=can_skip_prepare,
        memory_owners=(mount, offsets, model, data),
    )


def sample_contacts(record_address: int, values_address: int, time: float) -> None:
    """Compute a contact wrench; see `uwsim.base.numerics.calls`."""
    wrench = carray(pointer(record_address), (1,), CONTACT_WRENCH)[0]
    frame, total = np.empty(12), np.zeros(6)
    write_frame(carray(pointer(wrench.mount), (1,), MOUNT)[0], frame)
    if wrench.has_contacts != 0:
        add_contacts(wrench, view_int64s(wrench.offsets, wrench.n_offsets), frame, total)
    rotate_wrench(frame, total, view_doubles(values_address, 6))


@njit
def add_contacts(wrench: Record, offsets: Ints64, point: Array, total: Array) -> None:
    """Add the wrenches of the contacts on a body to a sum.

    Args:
        wrench: a record of `CONTACT_WRENCH`.
        offsets: the offsets of MuJoCo's fields.
        point: an array that begins with the point of the torque, in W, (3,) or longer [m].
        total: the sum of forces and torques in W, to which the wrenches are added, (6,) [N, N m].
    """
    m, d, body = wrench.model, wrench.data, wrench.body
    bodies, contacts = read_int64(m + offsets[f.GEOM_BODY]), read_int64(d + offsets[f.CONTACTS])
    contact_force, lever = np.empty(6), np.empty(3)
    for i in range(read_int32(d + offsets[f.N_CONTACTS])):
        contact = contacts + offsets[f.CONTACT_SIZE] * i
        geoms = view_int32s(contact + offsets[f.CONTACT_GEOMS], 2)
        is_second = read_int32(bodies + 4 * geoms[1]) == body
        if (read_int32(bodies + 4 * geoms[0]) == body) == is_second:
            continue
        call_numbered(wrench.contact_force, m, d, i, contact_force.ctypes.data)
        axes = view_doubles(contact + offsets[f.CONTACT_AXES], 9).reshape((3, 3))  # by rows, in W
        position = view_doubles(contact + offsets[f.CONTACT_POINT], 3)
        sign = 1.0 if is_second else -1.0  # the first body pushes the second
        force, torque = rotate_back(axes, contact_force[:3]), rotate_back(axes, contact_force[3:])
        for k in range(3):
            force[k] *= sign
            lever[k] = position[k] - point[k]
        moment = cross(lever, force)
        for k in range(3):
            total[k] += force[k]
            total[3 + k] += sign * torque[k] + moment[k]


@njit
def rotate_wrench(frame: Array, wrench: Array, values: Array) -> None:
    """Rotate a wrench (6,) from W into the axes of a frame, and write it into ``values``, (6,).

    Args:
        frame: the position and the rotation of the frame in W, as `write_frame` computes it, (12,).
        wrench: the force and the torque in W, (6,).
        values: receives the force and the torque in the axes of the frame, (6,).
    """
    axes = frame[3:].reshape((3, 3))
    values[:3], values[3:] = rotate_back(axes, wrench[:3]), rotate_back(axes, wrench[3:])
