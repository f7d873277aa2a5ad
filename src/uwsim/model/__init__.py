"""What follows from a scene file and never changes while a simulation runs."""
