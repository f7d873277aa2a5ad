"""Physics: MuJoCo with hydrodynamics, actuators and contacts."""

from __future__ import annotations

from ..interrupts import ignoring_interrupts

# MuJoCo's window library starts a process, which would show a traceback at Ctrl-C.
with ignoring_interrupts():
    import mujoco  # noqa: F401
