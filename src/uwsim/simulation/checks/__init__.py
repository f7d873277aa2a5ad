"""What of a scene cannot be meant: checks that need its bodies or its thrusters."""
