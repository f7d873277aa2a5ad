"""Connections of a running simulation to programs outside: TCP and UDP, without threads that wait.

A stream that is a TCP client connects in a thread, so that a program may start later.
"""

from __future__ import annotations

from .connections import OpenConnections

__all__ = ["OpenConnections"]
