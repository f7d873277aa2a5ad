r"""How the links of vehicles move: velocities and accelerations of points on them.

Velocities of a simulated vehicle are those at the end of the last step; :math:`\ddot q` is what the
engine solved in that step, in which forces act at its middle: accelerations are half a step old.
`link_kernel` has the formulas.
"""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of
from ...base.sampling import Addresses, number_addresses
from ...model.body_names import vehicle_joint
from ...world import BodyMotion
from ..poses import Poses
from . import link_kernel
from .link_kernel import CHAIN, HINGE, SHIFT, SLIDE, TURN

Chain = npt.NDArray[np.void]
"""A record of `link_kernel.CHAIN`, (1,)."""


class LinkMotion:
    """The motion of points on links.

    Args:
        model: of the scene.
        data: its state.
        poses: where everything is.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._scratch = np.zeros(link_kernel.scratch_size(model.nbody, model.nv))
        self._led: dict[int, tuple[Array, Array]] = {}
        self._chains: dict[tuple[int, int | None], Chain] = {}
        self._kept: list[npt.NDArray[np.int64]] = []  # what chains have the addresses of

    def base_addresses(self, index: int) -> tuple[Addresses, Addresses]:
        """Return the addresses of the place and of the twist of a vehicle's base, (12,) and (6,).

        Position [m] and axes in W by rows, as `Poses.refresh` leaves them; velocity in W [m/s] and
        angular velocity in its own axes [rad/s].
        """
        poses, body = self._poses, self._poses.base(index)
        dof = int(self._model.body_dofadr[body])
        place = (
            number_addresses(poses.origins, np.arange(3 * body, 3 * body + 3)),
            number_addresses(poses.axes, np.arange(9 * body, 9 * body + 9)),
        )
        return np.concatenate(place), number_addresses(self._data.qvel, np.arange(dof, dof + 6))

    def joint_addresses(self, index: int, names: Sequence[str], *, with_motion: bool) -> Addresses:
        """Return the addresses of the positions of some joints of a vehicle [rad or m], (n,).

        With motion, (4 n,), those of velocities [rad/s or m/s] and of the two parts of the efforts
        [N m or N] follow: what drives the joints, and what is applied to them.
        """
        model, data = self._model, self._data
        joints = [model.joint(vehicle_joint(index, name)).id for name in names]
        places, dofs = model.jnt_qposadr[joints], model.jnt_dofadr[joints]
        found = [number_addresses(data.qpos, places)]
        if with_motion:
            moving = data.qvel, data.qfrc_actuator, data.qfrc_applied
            found += [number_addresses(array, dofs) for array in moving]
        return np.concatenate(found)

    def led(self, index: int) -> tuple[Array, Array]:
        """Return where the motion of a vehicle's joints is written that is not the engine's.

        Args:
            index: number of the vehicle.

        Returns:
            Speeds of all degrees of freedom of the scene, and the rates of these, (nv,) each.
        """
        if index not in self._led:
            self._led[index] = np.zeros(self._model.nv), np.zeros(self._model.nv)
        return self._led[index]

    def of(self, body: int, point: Array, *, led: int | None = None) -> BodyMotion:
        """Return the motion of a point of W, (3,) [m], on a body of the engine.

        Args:
            body: its number in the engine.
            point: in W, (3,) [m].
            led: number of the vehicle whose joints move as `led` has it; None: as the engine moves
                them.
        """
        self._poses.refresh()
        found = link_kernel.motion_of(self.chain(body, led), point)
        return BodyMotion(found[:3], found[3:6], found[6:])

    def chain(self, body: int, led: int | None) -> Chain:
        """Return the joints that move a body, as a record for compiled code.

        Args:
            body: its number in the engine.
            led: number of the vehicle whose joints move as `led` has it; None: as the engine moves
                them.
        """
        if (body, led) in self._chains:
            return self._chains[body, led]
        model, data = self._model, self._data
        speeds, rates = (data.qvel, data.qacc) if led is None else self.led(led)
        root, rows = int(model.body_rootid[body]), np.array(self._rows(body), np.int64)
        chain = self._chains[body, led] = np.zeros(1, CHAIN)
        chain["root"], chain["n_bodies"] = root, int((model.body_rootid == root).sum())
        chain["n_dofs"] = len(rows)
        self._kept.append(rows)
        for name, numbers in (
            ("dofs", rows),
            ("parents", model.body_parentid),
            ("masses", model.body_mass),
            ("tree_masses", model.body_subtreemass),
            ("centres", data.xipos),
            ("axes", data.xmat),
            ("anchors", data.xanchor),
            ("joint_axes", data.xaxis),
            ("speeds", speeds),
            ("rates", rates),
            ("scratch", self._scratch),
        ):
            chain[name] = address_of(numbers)
        return chain

    def _rows(self, body: int) -> list[tuple[int, int, int, int]]:
        """Return number, kind, body and joint of what moves a body, from root to link."""
        model, rows = self._model, []
        body = int(model.body_weldid[body])
        dof = int(model.body_dofadr[body] + model.body_dofnum[body] - 1) if body else -1
        while dof >= 0:
            joint = int(model.dof_jntid[dof])
            kind = {
                mujoco.mjtJoint.mjJNT_FREE: SHIFT if dof < model.jnt_dofadr[joint] + 3 else TURN,
                mujoco.mjtJoint.mjJNT_SLIDE: SLIDE,
                mujoco.mjtJoint.mjJNT_HINGE: HINGE,
            }[mujoco.mjtJoint(model.jnt_type[joint])]
            rows.append((dof, kind, int(model.dof_bodyid[dof]), joint))
            dof = int(model.dof_parentid[dof])
        return rows[::-1]
