"""The positions and velocities of all movable bodies as one array, for fingerprints of runs."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

from ..base.geometry import Array


class Motion:
    """The generalised positions and velocities of each body that has joints, as a copy.

    For each body the positions come first: the position in W and the quaternion (wxyz) of a free
    body, or the position of each joint; then the velocities, as in ``qvel``. A body without joints
    moves with its parent.

    Args:
        model: the engine's model.
        data: the engine's state, from which `read` copies.
        names: the scene's name of each body of the model.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str]) -> None:
        self._data = data
        self._numbers = np.zeros(model.nq + model.nv)
        self._n_positions = model.nq
        owners = [int(body) for body in model.jnt_bodyid]
        starts = [int(a) for a in model.jnt_qposadr], [model.nq + int(a) for a in model.jnt_dofadr]
        ends = [*starts[0][1:], model.nq], [*starts[1][1:], model.nq + model.nv]
        order: list[int] = []
        parts: list[tuple[str, int]] = []
        for body in dict.fromkeys(owners):
            joints = [joint for joint, owner in enumerate(owners) if owner == body]
            numbers = [
                number
                for kind in (0, 1)
                for joint in joints
                for number in range(starts[kind][joint], ends[kind][joint])
            ]
            order += numbers
            parts.append((names[body], len(numbers)))
        self._order = np.array(order, dtype=np.intp)
        self.parts = tuple(parts)
        """The name of each body, and the number of its positions and velocities."""

    @property
    def size(self) -> int:
        """The number of positions and velocities of all bodies."""
        return len(self._order)

    def read(self, row: Array) -> None:
        """Write the present positions and velocities, body by body, into an array (size,)."""
        self._numbers[: self._n_positions] = self._data.qpos
        self._numbers[self._n_positions :] = self._data.qvel
        np.take(self._numbers, self._order, out=row)
