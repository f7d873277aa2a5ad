"""Draw calls for a sequence of batches, with as few changes of OpenGL's state as possible."""

from __future__ import annotations

from typing import Literal

import moderngl

from .gpu_model import Batch
from .instance import Instances, Slots

Winding = Literal["cw", "ccw"]
"""The order of a triangle's vertices in an image if its outside is visible: clockwise or not."""

OPPOSITE: dict[Winding, Winding] = {"cw": "ccw", "ccw": "cw"}


class BatchDrawer:
    """The drawer of the batches of one pass; it sets only the state that differs between batches.

    A scene has dozens of batches. Most of them belong to the same instance as the previous batch.
    To set all state for each batch takes as long as to issue the draw calls.

    Args:
        context: the context, with the framebuffer in use.
        instances: all instances.
        slots: the buffer with the poses of the instances.
        winding: the winding of instances that are not mirrored. It is clockwise in images, which
            are upside down for OpenGL.
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

    def draw(self, index: int, program: moderngl.Program) -> None:
        """Draw all triangles of a batch by its index; two-sided batches from both sides."""
        row, batch = self._batches[index]
        if row != self._row:
            self._row = row
            self._slots.bind(row)
            front = OPPOSITE[self._winding] if self._is_mirrored[row] else self._winding
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
