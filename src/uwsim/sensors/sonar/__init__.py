"""Echoes: the shared parts of imaging, scanning and side-scan sonars."""
