"""Algorithms that run in this process, and the calls of their callbacks."""
