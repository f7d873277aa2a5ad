"""Shapes of a scene for the physics, the floor among them, and contacts."""
