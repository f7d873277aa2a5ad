"""The compiled functions: forces of the water on bodies, fins and thrusters."""
