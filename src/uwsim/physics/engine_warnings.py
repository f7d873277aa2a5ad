"""Warnings of the engine: each ends the run with a one-line error, and no log file is written.

MuJoCo's own way is to print, to append to ``MUJOCO_LOG.TXT`` in the working folder, and to go on:
with contacts left out, or from the beginning when a number grew beyond all bounds. Every warning
is also counted in the state, where `why_untrue` reads it after each step.
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
"""Of a body in water: no thing that a simulation of this kind is for goes faster, or turns more
quickly [m/s, rad/s]; but for loose things that are thin, see `RIM_SPEED`."""
RIM_SPEED = 1.0
"""Of the surface of a loose thing that turns: as fast as small heavy things sink, and roll; a
needle does so at more than `MAX_SPEED` [m/s]."""
FIRST_UNSTABLE = int(mujoco.mjtWarning.mjWARN_BADQPOS)
"""From this on: a position, velocity, acceleration or control is no number."""
SINGULAR = int(mujoco.mjtWarning.mjWARN_INERTIA)


def hush() -> None:
    """Suppress MuJoCo's warnings in this process, unless another handler is installed."""
    if mujoco.get_mju_user_warning() is None:
        mujoco.set_mju_user_warning(_pass_over)


class StepCheck:
    """Checks of a step: SimulationFailed names the body and the time.

    Args:
        model: the engine's.
        data: its state.
        names: what the scene calls each body of the model.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str]) -> None:
        self._data, self._timestep = data, model.opt.timestep
        self._names = [names[body] for body in model.dof_bodyid]
        self.counters = data.warning.number
        """The engine's, one for each kind of warning."""
        self.speeds = speeds_of(model)
        """Which velocities make a speed together, and how fast that may be, (n, 3): `speeds_of`."""

    def end_if_warned(self, step: int) -> None:
        """Raise SimulationFailed if the engine has warned in a step."""
        if any(self.counters.tolist()):
            self.fail(step, -1)

    def fail(self, step: int, dof: int) -> NoReturn:
        """Raise SimulationFailed: the engine has warned, or a degree of freedom is too fast."""
        time = step * self._timestep
        if dof < 0:
            raise SimulationFailed(why_untrue(self._data, time, self._timestep, self._names))
        raise SimulationFailed(say_too_fast(self._data.qvel, self.speeds, dof, time, self._names))


def why_untrue(data: mujoco.MjData, time: float, timestep: float, names: list[str]) -> str:
    """Return why results would be invalid after a warning of the engine.

    Args:
        data: the engine's state.
        time: of the step that it warned in [s].
        timestep: length of a step [s].
        names: what the scene calls the body of each degree of freedom.
    """
    counts = data.warning.number
    if counts[FIRST_UNSTABLE:].any():
        where = ""
        for kind in (mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC):
            if counts[kind]:
                where = f" of {names[data.warning[kind].lastinfo]!r}"
        return (
            f"The motion{where} grew beyond all bounds at {time:g} s: "
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


def speeds_of(model: mujoco.MjModel) -> npt.NDArray[np.int64]:
    """Degrees of freedom that form one speed: the first, how many, and the limit, (n, 3)."""
    parts = {mujoco.mjtJoint.mjJNT_FREE: (3, 3), mujoco.mjtJoint.mjJNT_BALL: (3,)}
    found = []
    for joint in range(model.njnt):
        first = int(model.jnt_dofadr[joint])
        limits = (int(MAX_SPEED), _fastest_turn(model, int(model.jnt_bodyid[joint])))
        for i, n in enumerate(parts.get(mujoco.mjtJoint(model.jnt_type[joint]), (1,))):
            found.append((first, n, limits[i]))
            first += n
    return np.array(found, dtype=np.int64).reshape(-1, 3)


def _fastest_turn(model: mujoco.MjModel, body: int) -> int:
    """How fast a body may turn: a loose object about its longest axis as `RIM_SPEED` says [rad/s].

    Its radius is half the middle one of the edges of the box around it; of several shapes the
    thickest counts.
    """
    start, n = int(model.body_geomadr[body]), int(model.body_geomnum[body])
    if not model.body(body).name.startswith("object/") or n == 0:
        return int(MAX_SPEED)
    halves = np.sort(model.geom_aabb[start : start + n, 3:], axis=1)  # (n, 3) [m]
    return int(max(MAX_SPEED, RIM_SPEED / halves[:, 1].max()))


@njit
def too_fast(velocities: Array, speeds: npt.NDArray[np.int64]) -> int:
    """The first degree of freedom with a speed above its limit or not finite; else -1.

    Args:
        velocities: of all degrees of freedom [m/s, rad/s].
        speeds: see `speeds_of`.
    """
    for i in range(speeds.shape[0]):
        first = speeds[i, 0]
        square = 0.0
        for k in range(first, first + speeds[i, 1]):
            square += velocities[k] * velocities[k]
        limit = float(speeds[i, 2])
        if not square <= limit * limit:
            return int(first)
    return -1


def say_too_fast(
    velocities: Array, speeds: npt.NDArray[np.int64], dof: int, time: float, names: list[str]
) -> str:
    """Report which body is too fast, as `why_untrue` does."""
    row = next(i for i, first in enumerate(speeds[:, 0]) if first == dof)
    speed = math.hypot(*velocities[dof : dof + speeds[row, 1]].tolist())
    return (
        f"{names[dof]!r} moves at {speed:.4g} m/s or rad/s at {time:g} s, and nothing here is "
        f"made for more than {speeds[row, 2]}: a mass, an inertia, a force or a current is wrong, "
        "bodies were inside each other as they began, or it is so thin that it does turn as fast, "
        "or asks for shorter steps."
    )


def _pass_over(message: str) -> None:
    """It is counted."""
