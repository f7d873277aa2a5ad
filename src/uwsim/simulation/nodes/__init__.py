"""Nodes of algorithms that run in this process, and the counting of calls to the algorithms."""
