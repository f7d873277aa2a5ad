"""Physics: MuJoCo with hydrodynamics, actuators and contacts."""

from __future__ import annotations

from ..interrupts import born_deaf

with born_deaf():  # its window library starts a process, which would show a traceback at Ctrl-C
    import mujoco  # noqa: F401
