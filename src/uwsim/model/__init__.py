"""The parts of a scene that follow from its file and do not change during a simulation."""
