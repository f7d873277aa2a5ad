"""Physics: MuJoCo with hydrodynamics, actuators and contacts."""

from __future__ import annotations

import os

from ..interrupts import ignoring_interrupts

# MuJoCo's own windows are not used here: to look for their library it would start a process, which
# shows a traceback at Ctrl-C. Whoever wants them in the same program imports mujoco first.
_has_choice = "MUJOCO_GL" in os.environ
os.environ.setdefault("MUJOCO_GL", "disable")
try:
    with ignoring_interrupts():
        import mujoco  # noqa: F401
finally:
    if not _has_choice:
        del os.environ["MUJOCO_GL"]
