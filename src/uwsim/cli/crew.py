"""Who plays a benchmark: ``--workers``."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Annotated

from ..errors import BadSetting, did_you_mean
from .taught import RUN, in_group

if TYPE_CHECKING:
    from ..benchmark.crew import Crew

RAY = "ray"
MOST_WORKERS = 1024
"""More processes than this on one machine are a slip of the pen."""

WorkersOption = Annotated[
    str,
    in_group(
        RUN,
        "--workers",
        metavar="N|ray",
        help="Processes to use on this machine; or ray, for the cluster that RAY_ADDRESS names, "
        "else all cores here.",
    ),
]


def n_at_once(workers: str) -> int:
    """Return how many levels are played at one time; of a cluster nobody knows: those of here."""
    return int(workers) if workers.isdigit() else os.cpu_count() or 1


def crew_of(workers: str) -> Crew:
    """Return who plays.

    Raises:
        BadSetting: neither a number nor ``ray``.
        MissingExtra: Ray is not installed.
    """
    from ..benchmark.crew import Here

    if workers == RAY:
        from ..benchmark.ray_cluster import RayCluster

        return RayCluster()
    number = int(workers) if workers.isascii() and workers.isdigit() else 0
    if not 1 <= number <= MOST_WORKERS:
        raise BadSetting(
            f"--workers {workers}: expected a number from 1 to {MOST_WORKERS}, or {RAY!r}."
            f"{did_you_mean(workers, [RAY])}"
        )
    if number == 1:
        return Here()
    from ..benchmark.processes import Processes

    return Processes(number)
