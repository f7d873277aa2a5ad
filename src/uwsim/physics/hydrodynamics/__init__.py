"""Hydrodynamics: added mass in the mass matrix, Coriolis, damping, buoyancy, current, thrust.

`table` prepares the numbers of bodies and thrusters (`uwsim.scene.hydrodynamics`). The water itself
is in `hydrodynamics.py`, which compiles a kernel when it is imported: scenes without a simulated
vehicle do not import it.
"""

from __future__ import annotations

from .table import prepare

__all__ = ["prepare"]
