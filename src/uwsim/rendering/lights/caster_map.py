"""A depth image of what casts a shadow, in which only what moved is drawn again."""

from __future__ import annotations

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ..brush import Brush
from ..instance import Instances, Numbers, Slots

Versions = npt.NDArray[np.int64]


class CasterMap:
    """The depths of casters as a square view sees them, nearest first.

    Of two drawings of the same view, the second tells which casters stand still. Their depths are
    kept in an image of their own: to copy it takes less time than to clear the map, and only the
    others are drawn into the copy. The depths are those of a map that is drawn as a whole, because
    the least depth does not depend on the order of drawing.

    Args:
        context: of the renderer.
        program: that of shadows.
        size: edge of the map [texels].
    """

    def __init__(self, context: moderngl.Context, program: moderngl.Program, size: int) -> None:
        self._context, self._program, self._size = context, program, size
        self.texture = _depth_texture(context, size)
        """The map."""
        self._framebuffer = context.framebuffer(depth_attachment=self.texture)
        self._slots = Slots(context)
        self._view: object = None  # what the map shows, but for the poses
        self._moved: Versions = np.zeros(0, dtype=np.int64)  # when its casters had moved last
        self._still: _Still | None = None
        self.n_drawn = 0
        """Number of batches drawn so far."""

    def update(self, instances: Instances, casters: Numbers, clip_from_world: Array) -> None:
        """Draw what is out of date.

        Args:
            instances: All there are.
            casters: Numbers of the batches that cast shadows, (k,).
            clip_from_world: The view, (4, 4).
        """
        moved = instances.moved[instances.owners[casters]]
        view = instances.arrangement, casters.tobytes(), clip_from_world.tobytes()
        is_new, stood = view != self._view, self._moved
        if not is_new and np.array_equal(moved, stood):
            return
        self._view, self._moved = view, moved
        self._slots.fill(instances, clip_from_world)
        if is_new:
            self._framebuffer.use()
            self._framebuffer.clear(depth=1.0)
            self._draw(instances, casters)
            return
        if self._still is None:
            self._still = _Still(self._context, self._size, self.texture)
        if not self._still.serves(view, moved, stood):
            self._still.begin(view, moved, moved == stood)
            self._draw(instances, casters[self._still.members])
        self._still.copy()
        self._framebuffer.use()
        self._draw(instances, casters[~self._still.members])

    def _draw(self, instances: Instances, casters: Numbers) -> None:
        """Draw batches into the framebuffer in use."""
        context = self._context
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        context.polygon_offset = 1.5, 2.0
        brush = Brush(context, instances, self._slots, outside="ccw")
        for number in casters.tolist():
            brush.draw(number, self._program)
        context.polygon_offset = 0.0, 0.0
        self.n_drawn += len(casters)


class _Still:
    """The depths of casters that stand still, and how they get into a map.

    Args:
        context: of the renderer.
        size: edge of the map [texels].
        texture: the map.
    """

    def __init__(self, context: moderngl.Context, size: int, texture: moderngl.Texture) -> None:
        self._context = context
        depths = _depth_texture(context, size)
        self._framebuffer = context.framebuffer(depth_attachment=depths)
        # moderngl copies the depths of framebuffers that have colours, too.
        self._source, self._target = (
            context.framebuffer([context.texture((size, size), 1)], depth)
            for depth in (depths, texture)
        )
        self.members: npt.NDArray[np.bool_] = np.zeros(0, dtype=bool)
        """Which casters are drawn here, (k,)."""
        self._view: object = None
        self._moved: Versions = np.zeros(0, dtype=np.int64)

    def serves(self, view: object, moved: Versions, stood: Versions) -> bool:
        """Whether none of its casters has moved, and few others stand still.

        Args:
            view: what the map shows, but for the poses.
            moved: when each caster moved last, (k,).
            stood: the same at the last drawing of the map, (k,).
        """
        if view != self._view or (self._moved != moved)[self.members].any():
            return False
        n_still, n_others = (moved == stood).sum() - self.members.sum(), (~self.members).sum()
        return bool(2 * n_still <= n_others)

    def begin(self, view: object, moved: Versions, members: npt.NDArray[np.bool_]) -> None:
        """Empty it and bind it as the render target, for those casters that are members, (k,)."""
        self._view, self._moved, self.members = view, moved, members
        self._framebuffer.use()
        self._framebuffer.clear(depth=1.0)

    def copy(self) -> None:
        """Copy the depths into the map."""
        self._context.copy_framebuffer(self._target, self._source)


def _depth_texture(context: moderngl.Context, size: int) -> moderngl.Texture:
    texture = context.depth_texture((size, size))
    texture.compare_func = "<="
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture
