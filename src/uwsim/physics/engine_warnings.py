"""Checks after a step: a warning of the engine or an excessive speed ends the run with an error.

By default MuJoCo prints a warning, appends it to ``MUJOCO_LOG.TXT`` in the working folder, and
continues: without some contacts, or from the initial state if a number became too large. Here the
text is suppressed. MuJoCo also counts the warnings in its data; the counters are checked after each
step.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NoReturn

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..errors import SimulationFailed

MAX_SPEED = 100.0
"""The greatest speed [m/s] and angular speed [rad/s] of a body in water; see `RIM_SPEED` for thin
loose objects."""
RIM_SPEED = 1.0
"""The greatest surface speed of a rotating loose object [m/s]. Small heavy objects sink and roll at
this speed; the angular speed of a needle then exceeds `MAX_SPEED`."""
FIRST_UNSTABLE = int(mujoco.mjtWarning.mjWARN_BADQPOS)
"""The first of the warnings about a position, velocity, acceleration or control that is not finite.
"""
SINGULAR = int(mujoco.mjtWarning.mjWARN_INERTIA)


def suppress_warnings() -> None:
    """Suppress MuJoCo's warnings in this process, unless another handler is installed."""
    if mujoco.get_mju_user_warning() is None:
        mujoco.set_mju_user_warning(_ignore)


class StepCheck:
    """The checks after a step; the errors name the body and the time.

    Args:
        model: the engine's model.
        data: the engine's state.
        names: the scene's name of each body of the model.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str]) -> None:
        self._data, self._timestep = data, model.opt.timestep
        self._names = [names[body] for body in model.dof_bodyid]
        self.counters = data.warning.number
        """The engine's counters, one for each kind of warning."""
        self.speeds = speed_limits(model)
        """The speed limits, (n, 3); see `speed_limits`."""

    def end_if_warned(self, step: int) -> None:
        """Raise SimulationFailed if the engine has warned in a step."""
        if any(self.counters.tolist()):
            self.fail(step, -1)

    def fail(self, step: int, dof: int) -> NoReturn:
        """Raise SimulationFailed for a degree of freedom that is too fast.

        Args:
            step: the index of the step.
            dof: the index of the degree of freedom; below 0 if the engine has warned.
        """
        time = step * self._timestep
        if dof < 0:
            raise SimulationFailed(describe_warning(self._data, time, self._timestep, self._names))
        raise SimulationFailed(describe_speed(self._data.qvel, self.speeds, dof, time, self._names))


def describe_warning(data: mujoco.MjData, time: float, timestep: float, names: list[str]) -> str:
    """Return the message about a warning of the engine, after which results would be invalid.

    Args:
        data: the engine's state.
        time: the time of the step with the warning [s].
        timestep: the length of a step [s].
        names: the scene's name of the body of each degree of freedom.
    """
    counts = data.warning.number
    if counts[FIRST_UNSTABLE:].any():
        body_text = ""
        for kind in (mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC):
            if counts[kind]:
                body_text = f" of {names[data.warning[kind].lastinfo]!r}"
        return (
            f"The motion{body_text} grew beyond all bounds at {time:g} s: "
            f"forces, currents or damping are too strong for steps of {timestep:g} s."
        )
    if counts[SINGULAR]:
        return (
            f"The inertia of {names[data.warning[SINGULAR].lastinfo]!r} is next to nothing at "
            f"{time:g} s, and its motion is undefined. Is a mass or an inertia too small?"
        )
    return (
        f"There are more contacts at {time:g} s than the engine has memory for, and some would be "
        "left out. Do bodies overlap?"
    )


def speed_limits(model: mujoco.MjModel) -> npt.NDArray[np.int64]:
    """Return the limits of the n speeds of a model, (n, 3).

    Each row is a linear, angular or joint speed: its first degree of freedom, the number of its
    components, and its limit [m/s or rad/s].
    """
    parts = {mujoco.mjtJoint.mjJNT_FREE: (3, 3), mujoco.mjtJoint.mjJNT_BALL: (3,)}
    rows = []
    for joint in range(model.njnt):
        dof = int(model.jnt_dofadr[joint])
        limits = (int(MAX_SPEED), _max_angular_speed(model, int(model.jnt_bodyid[joint])))
        for i, n in enumerate(parts.get(mujoco.mjtJoint(model.jnt_type[joint]), (1,))):
            rows.append((dof, n, limits[i]))
            dof += n
    return np.array(rows, dtype=np.int64).reshape(-1, 3)


def _max_angular_speed(model: mujoco.MjModel, body: int) -> int:
    """Return the greatest angular speed of a body; `RIM_SPEED` limits it for a loose object.

    The radius of the object is half the second longest edge of its bounding box, of the thickest
    shape if there are several.
    """
    start, n = int(model.body_geomadr[body]), int(model.body_geomnum[body])
    if not model.body(body).name.startswith("object/") or n == 0:
        return int(MAX_SPEED)
    halves = np.sort(model.geom_aabb[start : start + n, 3:], axis=1)  # (n, 3) [m]
    return int(max(MAX_SPEED, RIM_SPEED / halves[:, 1].max()))


@njit
def find_excess_speed(velocities: Array, speeds: npt.NDArray[np.int64]) -> int:
    """Return the first degree of freedom of a speed that is above its limit or not finite; else -1.

    Args:
        velocities: the velocities of all degrees of freedom [m/s, rad/s].
        speeds: the rows of `speed_limits`.
    """
    for i in range(speeds.shape[0]):
        dof = speeds[i, 0]
        square = 0.0
        for k in range(dof, dof + speeds[i, 1]):
            square += velocities[k] * velocities[k]
        limit = float(speeds[i, 2])
        if not square <= limit * limit:
            return int(dof)
    return -1


def describe_speed(
    velocities: Array, speeds: npt.NDArray[np.int64], dof: int, time: float, names: list[str]
) -> str:
    """Return the message about a body that is too fast; see `describe_warning`."""
    row = next(i for i, first_dof in enumerate(speeds[:, 0]) if first_dof == dof)
    speed = math.hypot(*velocities[dof : dof + speeds[row, 1]].tolist())
    return (
        f"{names[dof]!r} moves at {speed:.4g} m/s or rad/s at {time:g} s, and nothing here is "
        f"made for more than {speeds[row, 2]}: a mass, an inertia, a force or a current is wrong, "
        "bodies were inside each other as they began, or it is so thin that it does turn as fast, "
        "or asks for shorter steps."
    )


def _ignore(message: str) -> None:
    """Ignore a warning, which the engine counts."""
