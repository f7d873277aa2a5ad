"""Robot files (URDF): their specs, the reader, and forward kinematics."""
