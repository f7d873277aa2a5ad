"""Replays stored results and compares them byte for byte."""
