"""The motion of the water of a scene."""
