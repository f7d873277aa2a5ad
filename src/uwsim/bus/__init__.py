"""Topics and services inside the process, and the interface of an algorithm to them."""

from __future__ import annotations

from .bus import Bus
from .node import Algorithm, Node
from .services import Services
from .topic import OBSERVER, Remark, TopicEndpoints

__all__ = ["OBSERVER", "Algorithm", "Bus", "Node", "Remark", "Services", "TopicEndpoints"]
