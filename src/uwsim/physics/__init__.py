"""The physics of a scene: MuJoCo with hydrodynamics, actuators and contacts.

A vehicle with ``u:dynamics`` has dynamics: forces move it. Any other vehicle is kinematic: commands
set its pose. W is the world frame (z up), L the localized world frame of the scene, base axes are
those of a vehicle's base link.
"""

from __future__ import annotations

from ..base import engine as engine
