"""The simulation of a scene: clock, commands, forces, sensors, messages, callbacks.

`simulation` is the Python interface and `scene_stepper` takes the steps. `live_scene` connects the
parts of a scene, and `world_views` restricts it for each kind of part: sensors, devices, measures.
`scenery` renders images; `nodes` runs algorithms in this process; `state` saves and restores.
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
