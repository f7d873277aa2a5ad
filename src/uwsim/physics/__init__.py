"""The physics of a scene: MuJoCo with hydrodynamics, actuators and contacts.

A vehicle with ``u:dynamics`` has dynamics: forces move it. Any other vehicle is kinematic: commands
set its pose. W is the world frame (z up), and L the localized world frame of the scene. Base axes
are the axes of a vehicle's base link; body axes are the axes of an engine's body.
"""

from __future__ import annotations

from ..base import engine as engine
