"""Errors and warnings about the contents of a scene file."""
