"""``nothing``: a control condition for tasks, which sends nothing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ...bus import Node


class SilentAlgorithm:
    """A control condition for tasks: it sends nothing, and must never succeed."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {}

    def start(self, node: Node) -> None:
        """Do nothing."""
