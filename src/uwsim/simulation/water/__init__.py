"""The motion of the water in a running scene."""
