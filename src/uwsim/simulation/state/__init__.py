"""The state of a simulation, which can be copied, saved as bytes and restored."""
