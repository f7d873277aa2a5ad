"""The choice of the executor of a run: ``--workers`` and ``--callback-limit``."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING

from ...errors import BadSetting, did_you_mean

if TYPE_CHECKING:
    from .executor import Executor

RAY = "ray"
MAX_WORKERS = 1024
"""The greatest number of processes; a greater number is regarded as a typing error."""

CALLBACK_LIMIT = 600.0
"""The default limit on the duration of a call into an algorithm [s of wall time]."""


def n_parallel_levels(workers: str) -> int:
    """Return the number of levels that run in parallel; for Ray, the cores of this machine."""
    return max(1, int(workers)) if workers.isdigit() else os.cpu_count() or 1


def executor_of(workers: str, callback_limit: float) -> Executor:
    """Return the executor of the trials.

    Args:
        workers: the number of workers, or ``ray``.
        callback_limit: the longest call into an algorithm [s of wall time]; 0 for no limit.

    Raises:
        BadSetting: ``workers`` is neither a number nor ``ray``, or the limit is not a time.
        MissingExtra: Ray is not installed.
    """
    from .executor import SerialExecutor

    if not 0.0 <= callback_limit < math.inf:
        raise BadSetting(f"--callback-limit {callback_limit:g}: expected a time >= 0 [s].")
    if workers == RAY:
        from .ray import RayExecutor

        return RayExecutor()
    number = int(workers) if workers.isascii() and workers.isdigit() else -1
    if not 0 <= number <= MAX_WORKERS:
        raise BadSetting(
            f"--workers {workers}: expected a number from 0 to {MAX_WORKERS}, or {RAY!r}."
            f"{did_you_mean(workers, [RAY])}"
        )
    if number == 0:
        return SerialExecutor(callback_limit=callback_limit or None)
    from .processes import ProcessExecutor

    return ProcessExecutor(number, callback_limit=callback_limit or None)
