"""The simulation of a scene: clock, commands, forces, sensors, messages, callbacks.

`simulation` has the step; `world` what measures and sensors see of the scene, `stage` also what
scene updaters set; `scenery` renders; `node` is an algorithm that runs in this process.
"""

from __future__ import annotations

from .nodes.calls import NO_CALLS, Calls, CallStopped, Counter, Cut, unfinished_call
from .nodes.node import STOPPED_VERB, InProcessNode, describe_failure, latency_of
from .scenery.renderer_pool import RendererPool
from .simulation import Simulation

__all__ = [
    "NO_CALLS",
    "STOPPED_VERB",
    "CallStopped",
    "Calls",
    "Counter",
    "Cut",
    "InProcessNode",
    "RendererPool",
    "Simulation",
    "describe_failure",
    "latency_of",
    "unfinished_call",
]
