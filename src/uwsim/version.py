"""The version of uwsim."""

__version__ = "0.5.0"
