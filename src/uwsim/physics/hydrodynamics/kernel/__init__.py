"""Compiled functions for the forces of the water on bodies, fins and thrusters."""
