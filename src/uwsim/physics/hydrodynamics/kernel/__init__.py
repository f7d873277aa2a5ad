"""Compiled functions for the forces of the water on bodies, fins and thrusters.

Arguments with one letter are the same in all modules: ``m`` is the address of ``mjModel``, ``d``
the address of ``mjData``, and ``o`` the offsets of their fields (`fields`). ``table`` is the row of
a body or an actuator (`columns`), and ``work`` the kernel's own array (`fields`).
"""
