"""The models of heaps of sand in a renderer, which are replaced when a heap has changed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...assets.mesh import Model
from .sand import Heap

if TYPE_CHECKING:
    from ...rendering.renderer import Renderer


class HeapModels:
    """The models of the heaps of a scene.

    Args:
        heaps: the heaps.
        first_id: the segmentation ID of the first heap; those of the others follow.
    """

    def __init__(self, heaps: Sequence[Heap], first_id: int) -> None:
        self._heaps, self._first_id = heaps, first_id
        self._drawn_heaps: dict[int, tuple[int, int, Model]] = {}  # version, handle, model

    @property
    def names(self) -> dict[int, str]:
        """The name of the object in each heap, by segmentation ID."""
        return {self._first_id + index: heap.name for index, heap in enumerate(self._heaps)}

    def update(self, renderer: Renderer) -> None:
        """Add the models of heaps that are new or have changed."""
        for index, heap in enumerate(self._heaps):
            drawing = self._drawn_heaps.get(index)
            if drawing is not None and drawing[0] == heap.version:
                continue
            if drawing is not None:
                renderer.remove(drawing[1])
                renderer.discard(drawing[2])
            model = heap.model()
            handle = renderer.add(model, self._first_id + index)
            self._drawn_heaps[index] = heap.version, handle, model

    def forget(self) -> None:
        """Forget what the renderer has, which is released."""
        self._drawn_heaps = {}
