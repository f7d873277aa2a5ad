"""The commands of ``uwsim suite``."""
