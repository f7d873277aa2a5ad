"""The physics engine's library, imported so that it starts no process.

MuJoCo starts a process to find the library of its windows, which uwsim does not use. That process
prints a traceback when the run ends. A program that uses the windows imports mujoco first.
"""

from __future__ import annotations

import numpy as np

from .environment import set_environment
from .interrupts import block_interrupts

with set_environment({"MUJOCO_GL": "disable"}), block_interrupts():
    import mujoco as mujoco


def model_bytes(model: mujoco.MjModel) -> bytes:
    """Return a model of the engine as bytes, the same for the same numbers."""
    buffer = np.zeros(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()
