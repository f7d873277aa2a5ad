"""The command ``uwsim``: one file a command, loaded only when that command runs."""

from __future__ import annotations

from .app import COMMANDS, main

__all__ = ["COMMANDS", "main"]
