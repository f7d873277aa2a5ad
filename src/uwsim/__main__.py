"""Entry point of ``uwsim`` and ``python -m uwsim``."""

from __future__ import annotations

import atexit
import sys

from .base.interrupts import exit_on_interrupt, ignore_interrupts


def run() -> int:
    """Run ``uwsim`` as a process of its own; returns its exit status."""
    exit_on_interrupt()
    atexit.register(ignore_interrupts)  # the first registered is the last called
    from .cli import main
    from .cli.app import say

    try:
        return main()
    except KeyboardInterrupt as error:  # a second one, while the first was handled
        return say(error)
    finally:
        exit_on_interrupt()  # the interpreter may take a moment to leave


if __name__ == "__main__":
    sys.exit(run())
