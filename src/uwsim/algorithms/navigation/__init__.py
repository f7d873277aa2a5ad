"""The estimation of a vehicle's pose from its DVL, IMU and depth sensor."""

from __future__ import annotations

from .bottom import BottomPlane
from .ekf import NavigationFilter, NavigationSpec
from .navigator import Navigator

__all__ = ["BottomPlane", "NavigationFilter", "NavigationSpec", "Navigator"]
