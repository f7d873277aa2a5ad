"""Actuation of vehicles: thrusters, joint servos, autopilot, electric power."""
