"""Lights and their shadow maps: lamps, projectors, the sun."""
