"""Hydrodynamics: added mass, Coriolis forces, damping, buoyancy, currents, thrusters and fins.

`table` writes the parameters of bodies and actuators (`uwsim.scene.hydrodynamics`) into a model
before it is compiled. `hydrodynamics.py` adds the forces of the water to the steps of the compiled
model. It compiles a kernel when it is imported, so that scenes without dynamics do not import it.
"""

from __future__ import annotations

from .table import prepare

__all__ = ["prepare"]
