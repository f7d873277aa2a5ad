"""Results of tasks that succeed or fail: success rates, failures, crossings of 50 %."""

from __future__ import annotations

from .cells import TaskCell, task_cells, task_measure
from .crossing import cells_along, crossing_sentence, find_crossings
from .figures import draw_success_curve, draw_task_figures
from .phases import phase_means
from .success_times import restricted_time, success_times, time_limit

__all__ = [
    "TaskCell",
    "cells_along",
    "crossing_sentence",
    "draw_success_curve",
    "draw_task_figures",
    "find_crossings",
    "phase_means",
    "restricted_time",
    "success_times",
    "task_cells",
    "task_measure",
    "time_limit",
]
