"""The import of MuJoCo, the physics engine, without its search for a window library.

On import, MuJoCo starts a process that searches for a window library, which uwsim does not use.
That process prints a traceback when the run ends. A program that opens windows of MuJoCo imports
``mujoco`` before uwsim.
"""

from __future__ import annotations

import numpy as np

from .environment import set_environment
from .interrupts import block_interrupts

with set_environment({"MUJOCO_GL": "disable"}), block_interrupts():
    import mujoco as mujoco


def model_bytes(model: mujoco.MjModel) -> bytes:
    """Return a compiled model as bytes; equal models give equal bytes."""
    buffer = np.zeros(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()
