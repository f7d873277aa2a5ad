"""The drawing of charts of the sea floor in a running scene."""
