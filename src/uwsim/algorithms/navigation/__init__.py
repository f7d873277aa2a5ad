"""Estimation of a vehicle's pose, and of the seabed below it, from DVL, IMU and depth sensor."""

from __future__ import annotations

from .bottom import BottomPlane
from .ekf import NavigationFilter, NavigationSpec
from .navigator import Navigator

__all__ = ["BottomPlane", "NavigationFilter", "NavigationSpec", "Navigator"]
