"""Entry point of ``uwsim`` and ``python -m uwsim``."""

from __future__ import annotations

import atexit
import gc
import sys

from .base.interrupts import exit_on_interrupt, ignore_interrupts


def run() -> int:
    """Run ``uwsim`` in this process and return its exit status."""
    exit_on_interrupt()
    gc.set_threshold(50_000, 20, 20)  # libraries and scenes are many objects, which stay
    atexit.register(ignore_interrupts)  # the first registered is the last called
    from .cli import main
    from .cli.app import print_error

    try:
        return main()
    except KeyboardInterrupt as error:  # a second one, while the first was handled
        return print_error(error)
    finally:
        exit_on_interrupt()  # the interpreter may take some time to exit
        gc.freeze()  # its last collection would visit all objects, of which most stay


if __name__ == "__main__":
    sys.exit(run())
