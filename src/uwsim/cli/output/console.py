"""A console for tables, which escapes control characters from files."""

from __future__ import annotations

import sys

import rich.console
from rich.console import ConsoleOptions, RenderableType
from rich.segment import Segment

from ...base.terminal import escape_control_characters

UNWRAPPED_WIDTH = 1000
"""The width for a program that reads the output: no line is wrapped [characters]."""


class Console(rich.console.Console):
    """A console that prints escape sequences of names and values as text."""

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> list[Segment]:
        """Convert an object to segments of text; control segments of the console remain."""
        return [
            segment
            if segment.control
            else Segment(escape_control_characters(segment.text), segment.style)
            for segment in super().render(renderable, options)
        ]


def standard_output(columns: int = UNWRAPPED_WIDTH) -> Console:
    """Return the console of standard output, which is ``columns`` wide without a terminal."""
    return Console(width=None if sys.stdout.isatty() else columns, highlight=False)
