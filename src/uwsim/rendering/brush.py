"""Draw batches one after another, and set only the state that differs from one to the next."""

from __future__ import annotations

from typing import Literal

import moderngl

from .gpu_model import Batch
from .instance import Instances, Slots

Winding = Literal["cw", "ccw"]
"""The winding, in an image, of triangles whose outside is visible."""

OTHER: dict[Winding, Winding] = {"cw": "ccw", "ccw": "cw"}


class Brush:
    """A sequence of draw calls for the batches of one pass, with a depth test.

    A scene has dozens of batches, most of which have the same sides and instance as the previous
    one. To set all state for each of them takes as long as to issue the draw calls.

    Args:
        context: with the framebuffer in use.
        instances: all instances.
        slots: with the poses of the instances.
        winding: winding of the outside of instances that are not mirrored. It is clockwise
            in images, which are upside down for OpenGL.
    """

    def __init__(
        self, context: moderngl.Context, instances: Instances, slots: Slots, winding: Winding
    ) -> None:
        self._context, self._batches, self._slots = context, instances.numbered_batches, slots
        self._winding: Winding = winding
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
            front = OTHER[self._winding] if self._is_mirrored[row] else self._winding
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
