"""Robot descriptions (URDF): what a file says, its reader, forward kinematics."""
