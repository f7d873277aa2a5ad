"""Contacts of dynamic and kinematic bodies, and the engine's tree of fixed shapes."""
