"""The overview of results of several tasks and algorithms: success rates, ranks, a heat map."""

from __future__ import annotations

from .ranks import TaskRanks, rank_algorithms
from .tasks import OverviewTask, overview_rows, read_tasks
from .write import overview_csv, overview_json, write_overview

__all__ = [
    "OverviewTask",
    "TaskRanks",
    "overview_csv",
    "overview_json",
    "overview_rows",
    "rank_algorithms",
    "read_tasks",
    "write_overview",
]
