"""Executes a plan: from a benchmark, a scene and an algorithm to the files of a result."""
