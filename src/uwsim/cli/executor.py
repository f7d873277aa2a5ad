"""Who plays a benchmark: ``--workers``."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Annotated

from ..errors import BadSetting, did_you_mean
from .taught import RUN, in_group

if TYPE_CHECKING:
    from ..runs.executors.executor import Executor

RAY = "ray"
MAX_WORKERS = 1024
"""More processes than this on one machine are taken for a typing error."""

CALLBACK_LIMIT = 600.0
"""How long a call into an algorithm may take, unless the user says otherwise [s]."""

WorkersOption = Annotated[
    str,
    in_group(
        RUN,
        "--workers",
        metavar="N|ray",
        help="Processes to use on this machine; ray: the cluster that RAY_ADDRESS names, else all "
        "cores here; 0: this very process, as a debugger wants it, where an algorithm can do more "
        "harm.",
    ),
]
CallbackLimitOption = Annotated[
    float,
    in_group(
        RUN,
        "--callback-limit",
        metavar="SECONDS",
        help="How long the algorithm may take to return from one callback, in wall time; a row in "
        "which it takes longer ends in 'algorithm error'. 0: for ever. Not for ray.",
    ),
]


def n_at_once(workers: str) -> int:
    """Return how many levels are played at one time; of a cluster nobody knows: those of here."""
    return max(1, int(workers)) if workers.isdigit() else os.cpu_count() or 1


def executor_of(workers: str, callback_limit: float) -> Executor:
    """Return who executes the trials.

    Args:
        workers: how many, or ``ray``.
        callback_limit: how long a call into an algorithm may take [s]; 0 for ever.

    Raises:
        BadSetting: neither a number nor ``ray``, or no time.
        MissingExtra: Ray is not installed.
    """
    from ..runs.executors.executor import SerialExecutor

    if not 0.0 <= callback_limit < math.inf:
        raise BadSetting(f"--callback-limit {callback_limit:g}: expected a time >= 0 [s].")
    if workers == RAY:
        from ..runs.executors.ray import RayExecutor

        return RayExecutor()
    number = int(workers) if workers.isascii() and workers.isdigit() else -1
    if not 0 <= number <= MAX_WORKERS:
        raise BadSetting(
            f"--workers {workers}: expected a number from 0 to {MAX_WORKERS}, or {RAY!r}."
            f"{did_you_mean(workers, [RAY])}"
        )
    if number == 0:
        return SerialExecutor()
    from ..runs.executors.processes import ProcessExecutor

    return ProcessExecutor(number, callback_limit=callback_limit or None)
