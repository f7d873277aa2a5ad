"""The version of uwsim."""

__version__ = "0.3.0"
