"""The command ``uwsim``: one module for each command, imported only when that command runs."""

from __future__ import annotations

from .app import COMMANDS, main

__all__ = ["COMMANDS", "main"]
