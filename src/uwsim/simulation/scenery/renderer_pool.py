"""A pool of renderers, which several simulations use one after another.

A new OpenGL context has to compile its shaders and load every texture again, which costs as
much as dozens of images. A pool is shared by several simulations of one process.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ...rendering.renderer import Renderer


class RendererPool:
    """A pool of renderers, each used by one simulation at a time.

    Images do not depend on the earlier use of a renderer. Use the pool from one thread only.
    """

    def __init__(self) -> None:
        self._idle_renderers: list[Renderer] = []

    def acquire(self) -> Renderer:
        """Return an idle renderer without models, or a new renderer.

        Raises:
            NoGraphics: no OpenGL context can be created.
        """
        from ...rendering.renderer import Renderer

        return self._idle_renderers.pop() if self._idle_renderers else Renderer()

    def release(self, renderer: Renderer) -> None:
        """Take a renderer back; its models stay on the GPU."""
        renderer.clear()
        self._idle_renderers.append(renderer)

    def close(self) -> None:
        """Release the graphics contexts of all idle renderers."""
        while self._idle_renderers:
            self._idle_renderers.pop().close()
