"""Scenarios made from the log of a mission: a scene, a benchmark and a recording."""
