"""The step: commands, forces, physics, clock, sensors, messages, callbacks."""

from __future__ import annotations

from .image_publisher import ImagePublisher, sample_step
from .node import InProcessNode, latency_of, what_broke
from .simulation import Simulation
from .studio import Studio

__all__ = [
    "ImagePublisher",
    "InProcessNode",
    "Simulation",
    "Studio",
    "latency_of",
    "sample_step",
    "what_broke",
]
