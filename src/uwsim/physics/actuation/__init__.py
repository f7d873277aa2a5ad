"""Actuation of vehicles with dynamics: autopilot, thrust allocation, servos, electric power."""
