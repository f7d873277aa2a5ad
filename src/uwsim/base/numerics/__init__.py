"""Compiled code, and arithmetic with the same bytes on every processor."""
