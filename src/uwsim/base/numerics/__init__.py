"""Numerics: compiled code, and arithmetic with the same results on every processor."""
