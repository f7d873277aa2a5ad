"""How points on vehicles move: velocities and accelerations for sensors."""
