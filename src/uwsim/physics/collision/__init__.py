"""Shapes that collide, and what touches what."""
