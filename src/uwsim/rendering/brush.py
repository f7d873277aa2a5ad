"""Draws batches one after another, and sets only what differs from one to the next."""

from __future__ import annotations

from typing import Literal

import moderngl

from .gpu_model import Batch
from .instance import Instances, Slots

Winding = Literal["cw", "ccw"]
"""The winding of the triangles that are seen from outside, in an image."""

OTHER: dict[Winding, Winding] = {"cw": "ccw", "ccw": "cw"}


class Brush:
    """What draws the batches of one pass, with a depth test.

    A scene has dozens of batches, most of which share their faces and their instance with the one
    before: to set all of it for each took as long as to issue the draw calls.

    Args:
        context: into whose framebuffer it draws.
        instances: all there are.
        slots: with the places of the instances.
        outside: winding of the outside of instances that are not mirrored. Images are upside down
            for OpenGL, so that it is clockwise in theirs.
    """

    def __init__(
        self, context: moderngl.Context, instances: Instances, slots: Slots, outside: Winding
    ) -> None:
        self._context, self._batches, self._slots = context, instances.numbered, slots
        self._outside: Winding = outside
        self._is_mirrored = instances.is_mirrored
        self._row: int | None = None
        self._front: Winding | None = None
        self._two_sided: bool | None = None

    def draw(self, number: int, program: moderngl.Program) -> None:
        """Draw all triangles of a batch by its number, from one side or both."""
        row, batch = self._batches[number]
        if row != self._row:
            self._row = row
            self._slots.bind(row)
            front = OTHER[self._outside] if self._is_mirrored[row] else self._outside
            if front != self._front:
                self._context.front_face = self._front = front
        if batch.two_sided != self._two_sided:
            self._show_sides(batch)
        batch.draw(program)

    def _show_sides(self, batch: Batch) -> None:
        self._two_sided = batch.two_sided
        if batch.two_sided:
            self._context.disable(moderngl.CULL_FACE)
        else:
            self._context.enable(moderngl.CULL_FACE)
