"""Lights: lamps, projectors, the sun's shadow."""
