"""A shadow map of the sun, in which only casters that moved are drawn again."""

from __future__ import annotations

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ..batch_drawer import BatchDrawer
from ..instance import Indices, Instances, Slots
from .caster_programs import CasterPrograms

Versions = npt.NDArray[np.int64]


class CasterMap:
    """The minimum depth of the casters in each texel of a square view.

    When a view is drawn for the second time, the casters that did not move are known. Their depths
    are stored in a separate image. To copy it into the map takes less time than to clear the map,
    and only the other casters are drawn into the copy. The depths equal those of a map in which all
    casters are drawn, because the minimum depth does not depend on the order of drawing.

    Args:
        context: the context of the renderer.
        programs: the programs that draw shadow maps.
        size: the edge of the map [texels].
    """

    def __init__(self, context: moderngl.Context, programs: CasterPrograms, size: int) -> None:
        self._context, self._programs, self._size = context, programs, size
        self.texture = _depth_texture(context, size)
        """The depth texture."""
        self._framebuffer = context.framebuffer(depth_attachment=self.texture)
        self._slots = Slots(context)
        self._view: object = None  # the content of the map, except poses
        self._moved_versions: Versions = np.zeros(0, dtype=np.int64)  # of the casters, when drawn
        self._static_depths: _StaticDepths | None = None
        self.n_drawn = 0
        """The number of batches drawn so far."""

    def update(self, instances: Instances, casters: Indices, clip_from_world: Array) -> None:
        """Draw the casters whose depths are out of date.

        Args:
            instances: all instances.
            casters: the indices of the batches that cast shadows, (k,).
            clip_from_world: the matrix from W to clip space of the view, (4, 4).
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

    def _draw(self, instances: Instances, casters: Indices) -> None:
        """Draw batches into the framebuffer in use."""
        context = self._context
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        context.polygon_offset = 1.5, 2.0
        drawer = BatchDrawer(context, instances, self._slots, winding="ccw")
        batches = instances.numbered_batches
        for index in casters.tolist():
            drawer.draw(index, self._programs.select(batches[index][1]))
        self._programs.release()
        context.polygon_offset = 0.0, 0.0
        self.n_drawn += len(casters)


class _StaticDepths:
    """The depths of casters at rest, which are copied into a map.

    Args:
        context: the context of the renderer.
        size: the edge of the map [texels].
        texture: the map.
    """

    def __init__(self, context: moderngl.Context, size: int, texture: moderngl.Texture) -> None:
        self._context = context
        depths = _depth_texture(context, size)
        self._framebuffer = context.framebuffer(depth_attachment=depths)
        # moderngl copies depths only between framebuffers that also have colours.
        self._source, self._target = (
            context.framebuffer([context.texture((size, size), 1)], depth)
            for depth in (depths, texture)
        )
        self.members: npt.NDArray[np.bool_] = np.zeros(0, dtype=bool)
        """The flags of the casters, (k,): True if a caster is in this image."""
        self._view: object = None
        self._moved_versions: Versions = np.zeros(0, dtype=np.int64)

    def is_usable(
        self, view: object, moved_versions: Versions, last_moved_versions: Versions
    ) -> bool:
        """Return True if no caster in this image has moved, and few other casters are at rest.

        Args:
            view: the content of the map, except poses.
            moved_versions: the version at which each caster last moved, (k,).
            last_moved_versions: ``moved_versions`` when the map was last drawn, (k,).
        """
        if view != self._view or (self._moved_versions != moved_versions)[self.members].any():
            return False
        n_at_rest = (moved_versions == last_moved_versions).sum()
        n_others = (~self.members).sum()
        return bool(2 * (n_at_rest - self.members.sum()) <= n_others)

    def begin(self, view: object, moved_versions: Versions, members: npt.NDArray[np.bool_]) -> None:
        """Clear this image and bind it as the target in which the members, (k,), are drawn."""
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
