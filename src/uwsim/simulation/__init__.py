"""The simulation of a scene: clock, commands, forces, sensors, messages, callbacks.

`simulation` has the step; `world` what measures and sensors see of the scene, `stage` also what
scene updaters set; `scenery` renders; `node` is an algorithm that runs in this process.
"""

from __future__ import annotations

from .nodes.calls import BEFORE, Calls, Counter, Cut, Stopped, open_call
from .nodes.node import STOPPED, InProcessNode, latency_of, what_broke
from .scenery.renderer_pool import RendererPool
from .simulation import Simulation

__all__ = [
    "BEFORE",
    "STOPPED",
    "Calls",
    "Counter",
    "Cut",
    "InProcessNode",
    "RendererPool",
    "Simulation",
    "Stopped",
    "latency_of",
    "open_call",
    "what_broke",
]
