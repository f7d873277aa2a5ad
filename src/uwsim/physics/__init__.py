"""Physics: MuJoCo with hydrodynamics, actuators and contacts."""

from __future__ import annotations

from ..base import engine as engine
