"""Rules that find likely mistakes from the robots, shapes and hydrodynamics of a scene."""
