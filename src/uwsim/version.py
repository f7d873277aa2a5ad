"""The version of uwsim."""

__version__ = "0.4.0"
