"""The console for tables: control characters from files are escaped."""

from __future__ import annotations

import rich.console
from rich.console import ConsoleOptions, RenderableType
from rich.segment import Segment

from ..terminal import legible


class Console(rich.console.Console):
    """A console that prints escape sequences of names and values as text."""

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> list[Segment]:
        """Turn something into pieces of text; those that are the console's own control it."""
        return [
            segment if segment.control else Segment(legible(segment.text), segment.style)
            for segment in super().render(renderable, options)
        ]
