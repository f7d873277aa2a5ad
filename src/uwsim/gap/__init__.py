"""The reality gap: a log compared with the simulation of the same commands, window by window.

.. code-block:: python

    gap = measure_gap(read_log("dive.mcap"), read_scene("pool.xml"))
    print(state_verdict(gap))
"""

from __future__ import annotations

from .attribution import Attribution, Cause
from .errors import AxisError, Estimate, HorizonError
from .measure import Gap, Progress, measure_gap
from .settings import GapSettings
from .verdict import state_verdict

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
    "state_verdict",
]
