"""Robot descriptions (URDF): specs, their reader, forward kinematics."""
