"""The commands that make data for learning: ``uwsim dataset`` and ``uwsim export``."""
