"""Checks of a scene for likely mistakes that need its bodies or its thrusters."""
