"""What drives a vehicle: thrusters, servos of joints, the autopilot, and the power they take."""
