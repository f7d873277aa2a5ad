"""Rows of free vehicles with a task, stepped together by compiled code."""
