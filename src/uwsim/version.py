"""The version of uwsim."""

__version__ = "0.2.0"
