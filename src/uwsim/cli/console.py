"""The terminal, as tables are drawn on it: what files say is shown there and never obeyed."""

from __future__ import annotations

import rich.console
from rich.console import ConsoleOptions, RenderableType
from rich.segment import Segment

from ..terminal import legible


class Console(rich.console.Console):
    """A console on which escapes in names and values are letters like any others."""

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> list[Segment]:
        """Turn something into pieces of text; those that are the console's own control it."""
        return [
            segment if segment.control else Segment(legible(segment.text), segment.style)
            for segment in super().render(renderable, options)
        ]
