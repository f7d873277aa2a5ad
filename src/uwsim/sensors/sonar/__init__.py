"""Echoes: what imaging, scanning and side-scan sonars have in common."""
