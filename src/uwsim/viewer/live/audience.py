"""What viewers have said: inputs of pilots, the views and images that they want, and the pace."""

from __future__ import annotations

from enum import Flag, auto

from ...algorithms.pilot import AXES
from ...base.external_values import read_number
from .clock import Clock
from .mapping import PilotMapping, merged
from .server import LiveServer, Message

MAX_SIDE = 1280
"""Of a view that is drawn for a page without WebGL [px]."""


class News(Flag):
    """What is new after viewers were heard."""

    NONE = 0
    PACE = auto()
    """The pace is another."""
    RESET = auto()
    """Everything is to go back where it began."""
    INPUT = auto()
    """A pilot does something else."""


class Audience:
    """Everybody who looks; what was said stays from one simulation to the next.

    Args:
        server: with whom they speak.
        clock: they pause and pace it.
        mapping: what keys and sticks do; None: nobody pilots.
    """

    def __init__(self, server: LiveServer, clock: Clock, mapping: PilotMapping | None) -> None:
        self._server, self._clock, self._mapping = server, clock, mapping
        self._views: dict[int, Message] = {}
        self._widths: dict[int, int] = {}  # of images, of viewers who have said one [px]
        self._inputs: dict[int, tuple[float, ...]] = {}  # of each viewer

    @property
    def inputs(self) -> tuple[float, ...] | None:
        """What all pilots do together, -1..1; None before the first has done anything."""
        return merged(self._inputs)

    @property
    def view(self) -> Message | None:
        """The newest view that a page without WebGL asks for; None if there is none."""
        return next(reversed(self._views.values()), None)

    @property
    def width(self) -> int:
        """Width of the images for the widest viewer [px]."""
        return max(self._widths.values(), default=MAX_SIDE)

    def hear(self) -> News:
        """Take in what viewers have said since the last call; returns what is new."""
        news = News.NONE
        for viewer, message in self._server.messages():
            try:
                news |= self._take(viewer, message)
            except Exception as error:  # no message of a viewer may end the run
                self._server.drop(viewer, f"{type(error).__name__} in a message")
        return news

    def _take(self, viewer: int, message: Message) -> News:
        """Take in one message of a viewer."""
        kind = message["type"]
        if kind == "control" and self._clock.control(message):
            return News.PACE
        if kind == "control" and message.get("action") == "reset":
            return News.RESET
        if kind == "view":
            self._views.pop(viewer, None)
            self._views[viewer] = message
        elif kind == "images":
            self._widths[viewer] = _width_of(message)
        elif kind == "input" and self._mapping is not None:
            return self._steer(viewer, self._mapping.values(message))
        elif kind == "left":
            self._views.pop(viewer, None)
            self._widths.pop(viewer, None)
            if viewer in self._inputs:
                return self._steer(viewer, (0.0,) * len(AXES))
        return News.NONE

    def _steer(self, viewer: int, values: tuple[float, ...]) -> News:
        """Keep what a viewer's pilot does now."""
        if self._inputs.get(viewer) == values:
            return News.NONE
        self._inputs[viewer] = values
        return News.INPUT


def _width_of(message: Message) -> int:
    """Width of the images that a viewer wants [px]; as they are where it says none."""
    width = read_number(message.get("width"))
    return MAX_SIDE if width is None else round(min(max(width, 16.0), MAX_SIDE))
