"""Motion of points on vehicles for sensors, and bodies whose poses are set in jumps or lifted."""
