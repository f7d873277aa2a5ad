"""A depth image of shadow casters, in which only casters that moved are drawn again."""

from __future__ import annotations

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ..brush import Brush
from ..instance import Instances, Numbers, Slots

Versions = npt.NDArray[np.int64]


class CasterMap:
    """The depths of casters in a square view, nearest first.

    The second drawing of a view shows which casters are at rest. Their depths are stored in a
    separate image: to copy it takes less time than to clear the map, and only the other casters
    are drawn into the copy. The depths equal those of a map that is drawn as a whole, because the
    least depth does not depend on the order of drawing.

    Args:
        context: of the renderer.
        program: that of shadows.
        size: edge of the map [texels].
    """

    def __init__(self, context: moderngl.Context, program: moderngl.Program, size: int) -> None:
        self._context, self._program, self._size = context, program, size
        self.texture = _depth_texture(context, size)
        """The depth texture."""
        self._framebuffer = context.framebuffer(depth_attachment=self.texture)
        self._slots = Slots(context)
        self._view: object = None  # the content of the map, except poses
        self._moved_versions: Versions = np.zeros(0, dtype=np.int64)  # of its casters
        self._static_depths: _StaticDepths | None = None
        self.n_drawn = 0
        """The number of batches drawn so far."""

    def update(self, instances: Instances, casters: Numbers, clip_from_world: Array) -> None:
        """Draw the casters that are out of date.

        Args:
            instances: All instances.
            casters: Numbers of the batches that cast shadows, (k,).
            clip_from_world: The view, (4, 4).
        """
        moved_versions = instances.moved_versions[instances.owners[casters]]
        view = instances.arrangement, casters.tobytes(), clip_from_world.tobytes()
        is_new, last_moved_versions = view != self._view, self._moved_versions
        if not is_new and np.array_equal(moved_versions, last_moved_versions):
            return
        self._view, self._moved_versions = view, moved_versions
        self._slots.fill(instances, clip_from_world)
        if is_new:
            self._framebuffer.use()
            self._framebuffer.clear(depth=1.0)
            self._draw(instances, casters)
            return
        if self._static_depths is None:
            self._static_depths = _StaticDepths(self._context, self._size, self.texture)
        if not self._static_depths.is_usable(view, moved_versions, last_moved_versions):
            self._static_depths.begin(view, moved_versions, moved_versions == last_moved_versions)
            self._draw(instances, casters[self._static_depths.members])
        self._static_depths.copy()
        self._framebuffer.use()
        self._draw(instances, casters[~self._static_depths.members])

    def _draw(self, instances: Instances, casters: Numbers) -> None:
        """Draw batches into the framebuffer in use."""
        context = self._context
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        context.polygon_offset = 1.5, 2.0
        brush = Brush(context, instances, self._slots, winding="ccw")
        for number in casters.tolist():
            brush.draw(number, self._program)
        context.polygon_offset = 0.0, 0.0
        self.n_drawn += len(casters)


class _StaticDepths:
    """The depths of casters at rest, which are copied into a map.

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
        """The flags of the casters, (k,): True if it is drawn here."""
        self._view: object = None
        self._moved_versions: Versions = np.zeros(0, dtype=np.int64)

    def is_usable(
        self, view: object, moved_versions: Versions, last_moved_versions: Versions
    ) -> bool:
        """Return True if none of its casters has moved, and few others are at rest.

        Args:
            view: the content of the map, except poses.
            moved_versions: version at which each caster last moved, (k,).
            last_moved_versions: the same at the last drawing of the map, (k,).
        """
        if view != self._view or (self._moved_versions != moved_versions)[self.members].any():
            return False
        n_still, n_moving = (
            (moved_versions == last_moved_versions).sum() - self.members.sum(),
            (~self.members).sum(),
        )
        return bool(2 * n_still <= n_moving)

    def begin(self, view: object, moved_versions: Versions, members: npt.NDArray[np.bool_]) -> None:
        """Clear it and bind it as the render target, for the casters that are members, (k,)."""
        self._view, self._moved_versions, self.members = view, moved_versions, members
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
