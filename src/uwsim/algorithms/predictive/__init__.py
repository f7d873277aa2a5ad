"""Model-predictive control of position, with and without an observer of disturbances."""

from __future__ import annotations

from .position_mpc import DobMpc, Mpc

__all__ = ["DobMpc", "Mpc"]
