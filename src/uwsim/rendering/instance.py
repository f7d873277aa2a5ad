"""Models that stand somewhere: their place, their bounds, and which of them a camera sees."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from ..geometry import Array, Pose
from .gpu_model import Batch
from .program import Block

INSTANCE = Block(
    "Instance", 1, {"camera_from_model": "mat4", "camera_normals": "mat4", "identity": "uvec4"}
)
STRIDE = 256
"""Bytes from slot to slot in the buffer of instances; every driver's alignment divides it."""


class Instance:
    """A model that stands somewhere in W."""

    def __init__(self, batches: tuple[Batch, ...], id: int) -> None:
        self.batches = batches
        """What is drawn."""
        self.id = id
        """Its number in the id picture, 1..65535."""
        self.world_from_model: Array = np.eye(4)
        """(4, 4); may carry scale, uneven or mirroring."""
        self.normals: Array = np.eye(3)
        """World normals from model normals, (3, 3)."""
        self.is_mirrored = False
        """Whether the matrix turns left into right."""
        self.spheres: Array = np.zeros((0, 4))
        """Bounding spheres of the batches in W: centre and radius, (n, 4) [m]."""
        self.corners: Array = np.zeros((0, 8, 3))
        """Corners of the batches' bounding boxes in W, (n, 8, 3) [m]."""
        self.place(self.world_from_model)

    def place(self, world_from_model: Array) -> None:
        """Stand it somewhere else."""
        self.world_from_model = np.array(world_from_model, dtype=np.float64)
        linear, origin = self.world_from_model[:3, :3], self.world_from_model[:3, 3]
        self.normals = np.linalg.inv(linear).T.astype(np.float64)
        self.is_mirrored = bool(np.linalg.det(linear) < 0.0)
        # The largest row sum of A'A bounds the square of the largest stretch; exact without shear.
        stretch = float(np.sqrt(np.abs(linear.T @ linear).sum(axis=1).max()))
        centres = np.array([batch.centre for batch in self.batches]).reshape(-1, 3)
        centres = centres @ linear.T + origin
        radii = np.array([batch.radius for batch in self.batches]) * stretch
        self.spheres = np.column_stack([centres, radii])
        boxes = np.array([batch.corners for batch in self.batches]).reshape(-1, 8, 3)
        self.corners = boxes @ linear.T + origin

    @property
    def radius(self) -> float:
        """Half the longest side of the box around its spheres [m]."""
        centres, radii = self.spheres[:, :3], self.spheres[:, 3:]
        return float(((centres + radii).max(axis=0) - (centres - radii).min(axis=0)).max()) / 2.0


class Slots:
    """The buffer that tells the shaders where each instance stands in the camera's frame."""

    _DTYPE = np.dtype(
        {
            "names": ["camera_from_model", "camera_normals", "identity"],
            "formats": [(np.float32, (4, 4)), (np.float32, (4, 4)), (np.uint32, (4,))],
            "offsets": [0, 64, 128],
            "itemsize": STRIDE,
        }
    )

    def __init__(self, context: moderngl.Context) -> None:
        self._values = np.zeros(64, dtype=self._DTYPE)
        self._buffer = context.buffer(reserve=self._values.nbytes, dynamic=True)

    def fill(self, instances: Sequence[Instance], camera_from_world: Array) -> None:
        """Give every instance its slot, in order."""
        if not instances:
            return
        if len(self._values) < len(instances):
            self._values = np.zeros(2 * len(instances), dtype=self._DTYPE)
            self._buffer.orphan(self._values.nbytes)
        models = camera_from_world @ np.array([i.world_from_model for i in instances])
        normals = camera_from_world[:3, :3] @ np.array([i.normals for i in instances])
        values = self._values[: len(instances)]
        values["camera_from_model"] = models.transpose(0, 2, 1)  # OpenGL counts columns first
        values["camera_normals"][:, :3, :3] = normals.transpose(0, 2, 1)
        values["identity"][:, 0] = [i.id for i in instances]
        self._buffer.write(values.tobytes())

    def bind(self, slot: int) -> None:
        """Let the next drawing stand where this slot says."""
        self._buffer.bind_to_uniform_block(
            INSTANCE.binding, offset=slot * STRIDE, size=INSTANCE.dtype.itemsize
        )


def in_view(
    instances: Sequence[Instance], world_from_camera: Pose, planes: Array
) -> list[tuple[int, Batch]]:
    """Slots and batches whose bounds reach into the frustum, near ones first.

    Bounds are the sphere and the box: of a wall, the sphere reaches far round it.

    Near is by the far side of the sphere, so small things come before the tank they float in and
    the tank's pixels behind them are never shaded.

    Args:
        instances: In the order of their slots.
        world_from_camera: Where the camera is.
        planes: Of the frustum, camera frame, (6, 4).
    """
    if not instances:
        return []
    spheres = np.concatenate([instance.spheres for instance in instances])  # (n, 4) [m]
    centres = (spheres[:, :3] - world_from_camera.position) @ world_from_camera.rotation
    beyond = centres @ planes[:, :3].T + planes[:, 3] + spheres[:, 3:]  # (n, 6) [m]
    nearness = np.linalg.norm(centres, axis=1) + spheres[:, 3]
    owners = [(slot, batch) for slot, i in enumerate(instances) for batch in i.batches]
    visible = (beyond > 0.0).all(axis=1)
    corners = np.concatenate([instance.corners for instance in instances])  # (n, 8, 3) [m]
    points = (corners - world_from_camera.position) @ world_from_camera.rotation
    inside = points @ planes[:, :3].T + planes[:, 3] > 0.0  # (n, 8, 6)
    visible &= np.all(inside.any(axis=1), axis=1)
    return [owners[n] for n in np.argsort(nearness, kind="stable") if visible[n]]
