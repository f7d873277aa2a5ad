r"""The wrench that a link and all links beyond it exert on the link's parent joint.

This is the wrench that a force-torque sensor in the joint measures. With the momentum p and the
weight W of these links and of the objects they hold, and the wrenches of contacts and water
(buoyancy, drag, added mass) on them,

.. math:: w = W + w_{contacts} + w_{water} - \dot p .

Forces and accelerations are those of the last step, positions those at the end of that step.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import address_of, call_both, call_three, function_address
from ..base.numerics.jit import njit
from ..base.numerics.linear import cross
from ..base.numerics.memory import (
    carray,
    pointer,
    read_int32,
    read_int64,
    view_doubles,
    view_int64s,
)
from ..base.sampling import Sampler
from .collision.contact_wrench import rotate_wrench
from .hydrodynamics import callback
from .hydrodynamics.kernel import fields as f
from .hydrodynamics.kernel.kernel import water_wrenches
from .kinematics.link_kernel import MOUNT, write_frame
from .poses import Mount, Poses

FUNCTIONS = ("mj_kinematics", "mj_comPos", "mj_comVel", "mj_rnePostConstraint")
"""The functions of MuJoCo that compute the forces in joints, in the order of their calls."""
WORKSPACE = np.dtype(
    [
        ("model", np.int64),  # addresses of MuJoCo's structs, and of the offsets of their fields
        ("data", np.int64),
        ("copy", np.int64),  # the address of the copy of the data; 0 before it is made
        ("offsets", np.int64),
        ("n_offsets", np.int64),
        ("copy_data", np.int64),  # addresses of ``mj_copyData`` and of `FUNCTIONS`
        ("functions", np.int64, len(FUNCTIONS)),
    ]
)
"""The addresses that compiled code needs to compute the forces in joints in a copy of the data."""
JOINT_WRENCH = np.dtype(
    [
        ("mount", np.int64),  # the address of a record of `link_kernel.MOUNT`
        ("body", np.int64),  # the MuJoCo body ID of the link
        ("workspace", np.int64),  # the address of a record of `WORKSPACE`; 0 without dynamics
    ]
)
"""The parameters of `sample_joint`."""

Record = Any


class JointWrench:
    """The wrenches on the joints of vehicles with dynamics.

    The computation works on a copy of the engine's data, and does not change the data.

    Args:
        model: the engine's model.
        data: the engine's state.
        poses: the poses of all bodies.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._workspace = np.zeros(1, WORKSPACE)
        self._copy: mujoco.MjData | None = None

    def sampler(self, body: int, mount: Mount, *, has_dynamics: bool) -> Sampler:
        """Return a sampler of the force [N] and the torque [N m] in the frame of a mount, (6,).

        Args:
            body: the MuJoCo body ID of the link.
            mount: the frame on the link.
            has_dynamics: true if the vehicle of the link has dynamics; else all numbers are 0.
        """
        row, offsets = np.zeros(1, JOINT_WRENCH), callback.offsets()
        row["mount"], row["body"] = address_of(mount), body
        if has_dynamics:
            space = self._workspace
            row["workspace"] = address_of(space)
            space["model"], space["data"] = self._model._address, self._data._address
            space["offsets"], space["n_offsets"] = address_of(offsets), len(offsets)
            space["copy_data"] = callback.function_address("mj_copyData")
            space["functions"] = [callback.function_address(name) for name in FUNCTIONS]

        def prepare(time: float) -> None:
            self._poses.refresh()
            self._make_copy()

        def can_skip_prepare(end_time: float) -> bool:
            self._make_copy()
            return True

        return Sampler(
            function=function_address(sample_joint),
            parameters=row,
            n_values=6,
            prepare=prepare,
            can_skip_prepare=can_skip_prepare,
            memory_owners=(mount, offsets, self),
        )

    def _make_copy(self) -> None:
        """Make the copy of the data, which takes megabytes, at the first sample."""
        if self._copy is None:
            self._copy = mujoco.MjData(self._model)
            self._workspace["copy"] = self._copy._address


def sample_joint(record_address: int, values_address: int, time: float) -> None:
    """Compute a joint wrench; see `uwsim.base.numerics.calls`."""
    joint = carray(pointer(record_address), (1,), JOINT_WRENCH)[0]
    frame, wrench = np.empty(12), np.zeros(6)
    write_frame(carray(pointer(joint.mount), (1,), MOUNT)[0], frame)
    if joint.workspace != 0:
        space = carray(pointer(joint.workspace), (1,), WORKSPACE)[0]
        compute_wrench(space, joint.body, frame, wrench)
    rotate_wrench(frame, wrench, view_doubles(values_address, 6))


@njit
def compute_wrench(space: Record, body: int, point: Array, wrench: Array) -> None:
    """Compute the wrench of a body and its subtree on the body's parent joint, in W.

    Args:
        space: a record of `WORKSPACE`.
        body: the MuJoCo ID of the body.
        point: an array that begins with the point of the torque, in W, (3,) or longer [m].
        wrench: receives the force and the torque, (6,) [N, N m].
    """
    m, d, offsets = space.model, space.copy, view_int64s(space.offsets, space.n_offsets)
    call_three(space.copy_data, d, m, space.data)
    for function in space.functions:
        call_both(function, m, d)
    n = read_int64(m + offsets[f.NBODY])
    water = np.empty((n, 6))  # torque, then force
    water_wrenches(m, d, offsets, water)
    reaction = view_doubles(read_int64(d + offsets[f.SUBTREE_FORCE]) + 48 * body, 6)
    root = read_int32(read_int64(m + offsets[f.BODY_ROOT]) + 4 * body)
    centre = view_doubles(read_int64(d + offsets[f.COM]) + 24 * root, 3)
    lever = np.empty(3)
    for i in range(3):
        lever[i] = point[i] - centre[i]
        wrench[i] = water[body, 3 + i] - reaction[3 + i]
    moment = cross(lever, wrench[:3])
    for i in range(3):
        wrench[3 + i] = (water[body, i] - reaction[i]) - moment[i]
