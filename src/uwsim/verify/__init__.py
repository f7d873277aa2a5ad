"""Executes a stored result again and compares what comes out."""
