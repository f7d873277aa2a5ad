"""Results of tasks that succeed or fail: success rates, classes of failure, crossings of 50 %."""

from __future__ import annotations

from .cells import TaskCell, task_cells, task_measure
from .crossing import Crossing, along, crossings, sentence
from .figures import draw_task_figures
from .phases import phase_means

__all__ = [
    "Crossing",
    "TaskCell",
    "along",
    "crossings",
    "draw_task_figures",
    "phase_means",
    "sentence",
    "task_cells",
    "task_measure",
]
