"""Contacts of simulated and kinematic bodies, and the engine's tree of fixed shapes."""
