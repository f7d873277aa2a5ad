"""Velocities and accelerations of points on vehicles, for sensors."""
