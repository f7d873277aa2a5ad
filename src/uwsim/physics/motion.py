"""Positions and velocities of all movable bodies as one row of numbers, for fingerprints."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

from ..base.geometry import Array


class Motion:
    """Generalised positions and velocities of every body that has joints, as a copy.

    Generalised coordinates: three and a quaternion (wxyz) for a body that is free, one for each
    joint; behind them the velocities. Bodies without a joint follow from these.

    Args:
        model: of MuJoCo.
        data: its state, looked at whenever `read` is called.
        names: how the scene calls each body of the model.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str]) -> None:
        self._data = data
        self._both = np.zeros(model.nq + model.nv)
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
        """Name of each body, and how many numbers are its own."""

    @property
    def size(self) -> int:
        """Length of the row of numbers."""
        return len(self._order)

    def read(self, into: Array) -> None:
        """Write the motion as it is now, body by body, into a row (size,) [m, rad, m/s, rad/s]."""
        self._both[: self._n_positions] = self._data.qpos
        self._both[self._n_positions :] = self._data.qvel
        np.take(self._both, self._order, out=into)
