"""The uniform block of the lamps, and their shadow maps.

All shadow maps are tiles of one depth texture, so that the shaders need a single sampler. A tile is
drawn again only when its lamp or an instance has moved, and all cameras use it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import moderngl
import numpy as np

from ...base.geometry import Array, Intrinsics, Pose, image_centre
from ...base.numerics.linear import product
from ...devices.lamp import MAX_LAMPS
from ..batch_drawer import BatchDrawer
from ..instance import Indices, Instances, Slots, find_visible
from ..program import Block
from ..projection import projection
from .caster_programs import CasterPrograms
from .lamp import MAX_HALF_ANGLE, Lamp

TILE = 512
"""The edge of one lamp's shadow map [texels]."""

NEAR, FAR = 0.1, 20.0
"""The distances from the lamp between which bodies cast shadows [m]; the lamp's own housing is
nearer."""

MARGIN = 1.02
"""The ratio of a map's width to the cone's, so that no look-up reaches into the next tile."""

LAMPS = Block(
    "Lamps",
    2,
    {
        "lamp_from_camera": "mat4[4]",
        "lamp_position": "vec4[4]",
        "lamp_axis": "vec4[4]",
        "lamp_light": "vec4[4]",
    },
)


class Lamps:
    """The buffer of the uniform block ``Lamps``, and the shadow maps of all lamps."""

    def __init__(self, context: moderngl.Context, programs: CasterPrograms) -> None:
        self._context, self._programs = context, programs
        self._values = np.zeros((), dtype=LAMPS.dtype)
        self._buffer = context.buffer(reserve=LAMPS.dtype.itemsize, dynamic=True)
        self.texture = context.depth_texture((2 * TILE, 2 * TILE))
        """The shadow maps: two by two tiles."""
        self.texture.compare_func = "<="
        self.texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
        self.texture.repeat_x = self.texture.repeat_y = False
        self._framebuffer = context.framebuffer(depth_attachment=self.texture)
        self._slots = [Slots(context) for _ in range(MAX_LAMPS)]
        self._map_keys: list[object] = [None] * MAX_LAMPS
        self.n_drawn = 0
        """The number of shadow maps drawn so far."""

    def update(
        self,
        lamps: Sequence[Lamp],
        instances: Instances,
        casters: Indices,
        version: object,
    ) -> None:
        """Draw the shadow maps that are out of date.

        Args:
            lamps: the lamps, in the order of the tiles.
            instances: all instances.
            casters: the indices of the batches that may cast shadows; terrain is among them.
            version: a value that changes when a caster is moved, added or removed.
        """
        for tile, lamp in enumerate(lamps):
            pose = lamp.world_from_lamp
            key: object = lamp.casts_shadow and (
                version,
                lamp.half_angle,
                pose.position.tobytes(),
                pose.rotation.tobytes(),
            )
            if key != self._map_keys[tile]:
                self._map_keys[tile] = key
                self._draw(tile, lamp, instances, casters if lamp.casts_shadow else casters[:0])

    def fill(self, lamps: Sequence[Lamp], world_from_camera: Pose) -> None:
        """Fill the uniform block for a camera, and bind it."""
        values, camera_from_world = self._values, world_from_camera.inverse()
        for tile, lamp in enumerate(lamps):
            lamp_from_world = lamp.world_from_lamp.inverse()
            map_projection = projection(_map_camera(lamp))
            map_from_lamp = product(_tile_from_clip(tile), map_projection.clip_from_camera)
            map_from_camera = product(
                product(map_from_lamp, lamp_from_world.matrix), world_from_camera.matrix
            )
            camera_from_lamp = camera_from_world @ lamp.world_from_lamp
            outer_cosine, steepness = lamp.edge
            texel = 2.0 * MARGIN * math.tan(lamp.half_angle) / TILE  # at 1 m [m]
            values["lamp_from_camera"][tile] = map_from_camera.T  # OpenGL counts columns first
            values["lamp_position"][tile] = *camera_from_lamp.position, outer_cosine
            values["lamp_axis"][tile] = *camera_from_lamp.rotation[:, 2], steepness
            strength = [lamp.intensity * channel for channel in lamp.colour]
            values["lamp_light"][tile] = *strength, 1.5 * texel
        self._buffer.write(values.tobytes())
        self._buffer.bind_to_uniform_block(LAMPS.binding)

    def _draw(self, tile: int, lamp: Lamp, instances: Instances, casters: Indices) -> None:
        view = _map_camera(lamp)
        viewport = TILE * (tile % 2), TILE * (tile // 2), TILE, TILE
        self.n_drawn += 1
        self._framebuffer.viewport = viewport
        self._framebuffer.use()
        self._framebuffer.clear(depth=1.0, viewport=viewport)
        target = self._context, self._programs, self._slots[tile]
        draw_casters(*target, instances, casters, lamp.world_from_lamp, view)


def draw_casters(
    context: moderngl.Context,
    programs: CasterPrograms,
    slots: Slots,
    instances: Instances,
    casters: Indices,
    world_from_lamp: Pose,
    view: Intrinsics,
) -> None:
    """Draw the depths of shadow casters as seen from a lamp, into the framebuffer in use.

    Args:
        context: the context of the renderer.
        programs: the programs that draw shadow maps.
        slots: the buffer for the poses of the instances.
        instances: all instances.
        casters: the indices of the batches that may cast shadows.
        world_from_lamp: the pose of the lamp.
        view: the pinhole of the lamp's shadow map.
    """
    light_projection = projection(view)
    context.enable_only(moderngl.DEPTH_TEST)
    context.depth_func = "<="
    context.polygon_offset = 1.5, 2.0
    slots.fill(
        instances, product(light_projection.clip_from_camera, world_from_lamp.inverse().matrix)
    )
    drawer = BatchDrawer(context, instances, slots, winding="cw")
    visible_batches = find_visible(instances, casters, world_from_lamp, light_projection.planes)
    batches = instances.numbered_batches
    for index in visible_batches.tolist():
        if batches[index][1].opacity >= 1.0:  # glass casts no shadow
            drawer.draw(index, programs.select(batches[index][1]))
    programs.release()
    context.polygon_offset = 0.0, 0.0


def _map_camera(lamp: Lamp) -> Intrinsics:
    """Return the pinhole of a lamp's shadow map."""
    angle = min(lamp.half_angle, MAX_HALF_ANGLE)
    focal = TILE / 2.0 / (MARGIN * math.tan(angle))
    cx, cy = image_centre(TILE, TILE)
    return Intrinsics(width=TILE, height=TILE, fx=focal, fy=focal, cx=cx, cy=cy, near=NEAR, far=FAR)


def _tile_from_clip(tile: int) -> Array:
    """Return the matrix from a tile's clip space to texture coordinates and depth, (4, 4)."""
    matrix = np.diag([0.25, 0.25, 0.5, 1.0])
    matrix[:3, 3] = 0.25 + 0.5 * (tile % 2), 0.25 + 0.5 * (tile // 2), 0.5
    return matrix
