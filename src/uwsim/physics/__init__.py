"""Physics: MuJoCo with hydrodynamics, actuators and contacts."""

from __future__ import annotations

from ..base.environment import environment
from ..base.interrupts import ignoring_interrupts

# MuJoCo's own windows are not used here: to look for their library it would start a process, which
# shows a traceback at Ctrl-C. Whoever wants them in the same program imports mujoco first.
with environment({"MUJOCO_GL": "disable"}), ignoring_interrupts():
    import mujoco  # noqa: F401
