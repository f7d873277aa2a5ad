"""Estimation of a vehicle's pose, and of the seabed below it, from DVL, IMU and depth sensor.

The navigation frame has the axes north, east and down, with the origin at the water surface. The
base is the frame of the vehicle, with x forward, y to starboard and z down.
"""

from __future__ import annotations

from .bottom import BottomPlane
from .ekf import NavigationFilter, NavigationSpec
from .navigator import Navigator

__all__ = ["BottomPlane", "NavigationFilter", "NavigationSpec", "Navigator"]
