"""Entry point of ``uwsim`` and ``python -m uwsim``."""

from __future__ import annotations

import atexit
import gc
import sys

from .base.interrupts import exit_on_interrupt, ignore_interrupts


def run() -> int:
    """Run ``uwsim`` in this process and return its exit status."""
    exit_on_interrupt()
    gc.set_threshold(50_000, 20, 20)  # most of the many objects stay until the exit
    atexit.register(ignore_interrupts)  # what is registered first is called last
    from .cli import main
    from .cli.app import print_error

    try:
        return main()
    except KeyboardInterrupt as error:  # a second Ctrl+C, during the first one's handling
        return print_error(error)
    finally:
        exit_on_interrupt()  # the interpreter may take some time to exit
        gc.freeze()  # spare the last collection a visit of all objects


if __name__ == "__main__":
    sys.exit(run())
