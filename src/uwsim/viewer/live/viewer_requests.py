"""The requests of viewers: inputs of pilots, views, images, pacing and resets."""

from __future__ import annotations

from enum import Flag, auto

from ...algorithms.pilot import AXES, SWITCH_AXES
from ...base.external_values import read_number
from .clock import Clock
from .mapping import PilotMapping, sum_inputs
from .server import LiveServer, Message

MAX_SIDE = 1280
"""The greatest width of an image, and the greatest height of an image of the view [px]."""


class Changes(Flag):
    """The kinds of changes that messages of viewers cause."""

    NONE = 0
    PACING = auto()
    """A pause, a single step, or a change of the real-time factor."""
    RESET = auto()
    """A request to reset vehicles and objects."""
    INPUT = auto()
    """A change of a pilot's input."""


class ViewerRequests:
    """The requests of all viewers, which remain valid in the next simulation.

    Args:
        server: the server that receives the viewers' messages.
        clock: the pacing that the viewers control.
        mapping: the mapping of keys and sticks; None: viewers cannot pilot.
    """

    def __init__(self, server: LiveServer, clock: Clock, mapping: PilotMapping | None) -> None:
        self._server, self._clock, self._mapping = server, clock, mapping
        self._views: dict[int, Message] = {}  # newest request for a view, by viewer
        self._widths: dict[int, int] = {}  # requested widths of images, by viewer [px]
        self._inputs: dict[int, tuple[float, ...]] = {}  # values of the pilot's axes, by viewer
        self._pulses: dict[int, float] = {}  # inputs of pressed switches, by index of the axis

    def take_inputs(self) -> tuple[float, ...] | None:
        """Return the sum of all viewers' inputs for each axis, -1..1; None before the first input.

        A switch that was pressed since the last call has its input, although it may be released.
        """
        inputs = sum_inputs(self._inputs)
        if inputs is None:
            return None
        pulses, self._pulses = self._pulses, {}
        return tuple(pulses.get(index, value) for index, value in enumerate(inputs))

    @property
    def view(self) -> Message | None:
        """The newest view that a page without WebGL requests; None if there is none."""
        return next(reversed(self._views.values()), None)

    @property
    def width(self) -> int:
        """The width of camera images: the greatest one that a viewer requests [px]."""
        return max(self._widths.values(), default=MAX_SIDE)

    def receive(self) -> Changes:
        """Apply the messages of viewers since the last call; return what they changed."""
        changes = Changes.NONE
        for viewer, message in self._server.pop_messages():
            try:
                changes |= self._handle(viewer, message)
            except Exception as error:  # no message of a viewer may end the run
                self._server.disconnect(viewer, f"{type(error).__name__} in a message")
        return changes

    def _handle(self, viewer: int, message: Message) -> Changes:
        kind = message["type"]
        if kind == "control" and self._clock.apply_control(message):
            return Changes.PACING
        if kind == "control" and message.get("action") == "reset":
            return Changes.RESET
        if kind == "view":
            self._views.pop(viewer, None)
            self._views[viewer] = message
        elif kind == "images":
            self._widths[viewer] = _width_of(message)
        elif kind == "input" and self._mapping is not None:
            return self._set_input(viewer, self._mapping.values(message))
        elif kind == "left":
            self._views.pop(viewer, None)
            self._widths.pop(viewer, None)
            if viewer in self._inputs:
                return self._set_input(viewer, (0.0,) * len(AXES))
        return Changes.NONE

    def _set_input(self, viewer: int, values: tuple[float, ...]) -> Changes:
        if self._inputs.get(viewer) == values:
            return Changes.NONE
        for axis in SWITCH_AXES:
            value = values[AXES.index(axis)]
            if abs(value) > 0.5:
                self._pulses[AXES.index(axis)] = value
        self._inputs[viewer] = values
        return Changes.INPUT


def _width_of(message: Message) -> int:
    """Return the width of images that a message requests [px]; by default the greatest."""
    width = read_number(message.get("width"))
    return MAX_SIDE if width is None else round(min(max(width, 16.0), MAX_SIDE))
