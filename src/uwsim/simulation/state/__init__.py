"""The state of a simulation: one record of all that changes while it runs."""
