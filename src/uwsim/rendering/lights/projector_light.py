"""The uniform block of the projector, its pattern and its shadow map."""

from __future__ import annotations

import moderngl
import numpy as np

from ...base.geometry import Pose
from ...base.numerics.linear import product
from ..instance import Indices, Instances, Slots
from ..program import Block
from ..projection import projection
from .caster_programs import CasterPrograms
from .lamps import draw_casters
from .projector import Projector

PROJECTOR = Block(
    "Projector",
    3,
    {"projector_from_camera": "mat4", "projector_position": "vec4", "projector_axis": "vec4"},
)

TEXTURE_FROM_CLIP = np.array(
    [[0.5, 0.0, 0.0, 0.5], [0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5], [0.0, 0.0, 0.0, 1.0]]
)
"""The matrix from clip space to texture coordinates and depth."""


class ProjectorLight:
    """The buffer of the uniform block ``Projector``, the pattern's texture and the shadow map."""

    def __init__(self, context: moderngl.Context, programs: CasterPrograms) -> None:
        self._context, self._programs = context, programs
        self._values = np.zeros((), dtype=PROJECTOR.dtype)
        self._buffer = context.buffer(reserve=PROJECTOR.dtype.itemsize, dynamic=True)
        self._slots = Slots(context)
        self._pattern: object = None
        self._map_key: object = None
        self._textures: list[moderngl.Texture] = []
        self._framebuffer: moderngl.Framebuffer | None = None

    def update(
        self,
        projector: Projector,
        instances: Instances,
        casters: Indices,
        version: object,
    ) -> None:
        """Draw the shadow map if it is out of date.

        Args:
            projector: the projector.
            instances: all instances.
            casters: the indices of the batches that may cast shadows; terrain is among them.
            version: a value that changes when a caster is moved, added or removed.
        """
        if self._pattern is not projector.pattern:
            self._load(projector)
        pose = projector.world_from_projector
        key = version, projector.fovy, pose.position.tobytes(), pose.rotation.tobytes()
        if key != self._map_key:
            self._map_key = key
            assert self._framebuffer is not None
            self._framebuffer.use()
            self._framebuffer.clear(depth=1.0)
            target = self._context, self._programs, self._slots
            draw_casters(*target, instances, casters, pose, projector.pinhole)

    def fill(self, projector: Projector, world_from_camera: Pose) -> None:
        """Fill the uniform block for a camera, and bind it."""
        values, intrinsics = self._values, projector.pinhole
        projector_from_camera = projector.world_from_projector.inverse() @ world_from_camera
        map_from_projector = product(TEXTURE_FROM_CLIP, projection(intrinsics).clip_from_camera)
        values["projector_from_camera"] = product(
            map_from_projector, projector_from_camera.matrix
        ).T  # OpenGL counts columns first
        camera_from_projector = projector_from_camera.inverse()
        values["projector_position"] = *camera_from_projector.position, float(projector.is_laser)
        values["projector_axis"] = (
            *camera_from_projector.rotation[:, 2],
            1.5 / min(intrinsics.fx, intrinsics.fy),
        )
        self._buffer.write(values.tobytes())
        self._buffer.bind_to_uniform_block(PROJECTOR.binding)

    def use(self, *, shadow_map: int, pattern: int) -> None:
        """Bind the shadow map and the pattern to texture units."""
        for texture, unit in zip(self._textures, (shadow_map, pattern), strict=True):
            texture.use(unit)

    def _load(self, projector: Projector) -> None:
        """Create the texture of the pattern, and an empty shadow map."""
        for texture in self._textures:
            texture.release()
        intrinsics, (rows, columns) = projector.pinhole, projector.pattern.shape[:2]
        depth = self._context.depth_texture((intrinsics.width, intrinsics.height))
        depth.compare_func = "<="
        depth.filter = (moderngl.LINEAR, moderngl.LINEAR)
        image = self._context.texture((columns, rows), 4, projector.pattern.tobytes(), alignment=1)
        image.filter = (moderngl.LINEAR, moderngl.LINEAR)
        for texture in (depth, image):
            texture.repeat_x = texture.repeat_y = False
        self._textures = [depth, image]
        self._framebuffer = self._context.framebuffer(depth_attachment=depth)
        self._pattern, self._map_key = projector.pattern, None
