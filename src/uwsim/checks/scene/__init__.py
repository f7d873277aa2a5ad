"""Errors and warnings about what a scene file says."""
