"""What the engine warns of: it ends a run with one line, and never in a file of the user's folder.

MuJoCo's own way is to print, to append to ``MUJOCO_LOG.TXT`` in the working folder, and to go on:
with contacts left out, or from the beginning when a number grew beyond all bounds. Every warning
is also counted in the state, where `why_untrue` reads it after each step.
"""

from __future__ import annotations

import mujoco

FIRST_UNSTABLE = int(mujoco.mjtWarning.mjWARN_BADQPOS)
"""From this on: a position, velocity, acceleration or control is no number."""
SINGULAR = int(mujoco.mjtWarning.mjWARN_INERTIA)


def hush() -> None:
    """Keep warnings off screen and disk in this process, unless somebody else listens to them."""
    if mujoco.get_mju_user_warning() is None:
        mujoco.set_mju_user_warning(_pass_over)


def why_untrue(data: mujoco.MjData, time: float, timestep: float, names: list[str]) -> str:
    """Say why what follows would not be true, once the engine has warned.

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
            f"{time:g} s, and nothing can be told of its motion. Is a mass or an inertia too small?"
        )
    return (
        f"There are more contacts at {time:g} s than the engine has memory for, and some would be "
        "left out. Do things stand inside one another?"
    )


def _pass_over(message: str) -> None:
    """It is counted."""
