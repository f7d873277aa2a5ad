"""The reality gap: a log compared with the simulation of the same commands, window by window.

.. code-block:: python

    gap = measure_gap(read_log("dive.mcap"), compile_scene(read_scene("pool.xml")))
    print(gap.verdict)
"""

from __future__ import annotations

from .attribution import Attribution, Cause
from .errors import AxisError, Estimate, HorizonError
from .gap import Gap
from .measure import Progress, measure_gap
from .open_water import remove_objects
from .settings import GapSettings

__all__ = [
    "Attribution",
    "AxisError",
    "Cause",
    "Estimate",
    "Gap",
    "GapSettings",
    "HorizonError",
    "Progress",
    "measure_gap",
    "remove_objects",
]
