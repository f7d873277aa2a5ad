"""Instances of models: their poses, their bounds, and which of them are in view."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np
import numpy.typing as npt

from ..errors import UnknownName
from ..geometry import Array, Intrinsics, Pose
from ..numerics.linear import determinants, inverse, product
from .gpu_model import Batch
from .minification import needs_no_copies
from .program import Block

INSTANCE = Block(
    "Instance", 1, {"camera_from_model": "mat4", "camera_normals": "mat4", "identity": "uvec4"}
)
STRIDE = 256
"""Bytes from slot to slot in the buffer of instances; every driver's alignment divides it."""


class Instances:
    """Instances of models in W; bounds and normals are computed for all of them at once.

    Each is identified by a handle; arrays have a row for each, in the order of adding.
    """

    def __init__(self) -> None:
        self.version = 0
        """Grows with every change of anything that may cast a shadow."""
        self._next_handle = 1
        self._followed = -1  # the version that normals and bounds are of
        self.clear()

    def clear(self) -> None:
        """Remove all instances."""
        self.version += 1
        self._is_known = False  # whether it is known which batches there are
        self._rows: dict[int, int] = {}
        self.ids: list[int] = []
        """Their numbers in the id image, 1..65535."""
        self.batches: list[tuple[Batch, ...]] = []
        """The batches of each instance."""
        self.world_from_model: Array = np.zeros((0, 4, 4))
        """(n, 4, 4); may carry scale, uneven or mirroring."""

    def add(self, batches: tuple[Batch, ...], id: int) -> int:
        """Put a model at the origin of W; returns its handle."""
        handle = self._next_handle
        self._next_handle += 1
        self.version += 1
        self._rows[handle] = len(self.ids)
        self.ids.append(id)
        self.batches.append(batches)
        self.world_from_model = np.concatenate([self.world_from_model, np.eye(4)[None]])
        self._is_known = False
        return handle

    def place(self, handle: int, world_from_model: Array) -> None:
        """Set the pose of an instance; UnknownName if it is not there."""
        row = self._row(handle)
        if (self.world_from_model[row] != world_from_model).any():
            self.world_from_model[row] = world_from_model
            self.version += 1

    def remove(self, handle: int) -> None:
        """Remove an instance; UnknownName if it is not there."""
        row = self._row(handle)
        self.version += 1
        del self._rows[handle], self.ids[row], self.batches[row]
        self._rows = {h: r - (r > row) for h, r in self._rows.items()}
        self.world_from_model = np.delete(self.world_from_model, row, axis=0)
        self._is_known = False

    def without(self, hidden: frozenset[int]) -> list[int]:
        """Rows of the instances whose ids are not hidden."""
        return [row for row, id in enumerate(self.ids) if id not in hidden]

    @property
    def normals(self) -> Array:
        """World normals from model normals, (n, 3, 3)."""
        self._follow()
        return self._normals

    @property
    def is_mirrored(self) -> list[bool]:
        """Whether the matrix of each instance mirrors it."""
        self._follow()
        return self._is_mirrored

    @property
    def radii(self) -> Array:
        """Half the longest side of the bounding box of each instance, (n,) [m]."""
        self._follow()
        return self._radii

    def owned(self, rows: Sequence[int]) -> npt.NDArray[np.intp]:
        """Numbers of the batches that the rows have, in the order of `batches`, (m,)."""
        self._follow()
        if len(rows) == len(self.ids):
            return np.arange(len(self._owners))
        has = np.zeros(len(self.ids), dtype=bool)
        has[list(rows)] = True
        return np.flatnonzero(has[self._owners])

    def casting(self, rows: Sequence[int]) -> npt.NDArray[np.intp]:
        """Numbers of the batches of rows that cast shadows; transparent ones cast none."""
        numbers = self.owned(rows)
        casting: npt.NDArray[np.intp] = numbers[self._is_opaque[numbers]]
        return casting

    @property
    def spheres(self) -> Array:
        """Bounding spheres of the batches in W: centre and radius, (m, 4) [m]."""
        self._follow()
        return self._spheres

    @property
    def corners(self) -> Array:
        """Corners of the bounding boxes of the batches in W, (m, 8, 3) [m]."""
        self._follow()
        return self._corners

    def needs_no_copies(
        self, numbers: Sequence[int], world_from_camera: Pose, intrinsics: Intrinsics
    ) -> list[bool]:
        """Whether batches need no mipmaps of their textures (`minification`)."""
        self._follow()
        chosen = np.array(numbers, dtype=np.intp)
        found = needs_no_copies(
            self._densities[chosen],
            self._flat_normals[chosen],
            self._corners[chosen],
            world_from_camera,
            intrinsics,
        )
        return [bool(one) for one in found]

    def batch(self, number: int) -> tuple[int, Batch]:
        """Row of the instance that a batch belongs to, and the batch, by its number."""
        return self._drawn[number]

    def _row(self, handle: int) -> int:
        if handle not in self._rows:
            raise UnknownName("instance", str(handle), map(str, self._rows))
        return self._rows[handle]

    def _stand(self) -> None:
        """Take note of which batches there are."""
        self._drawn = [
            (row, batch) for row, several in enumerate(self.batches) for batch in several
        ]
        self._owners = np.array([row for row, _ in self._drawn], dtype=np.intp)
        batches = [batch for _, batch in self._drawn]
        self._own_centres = np.array([batch.centre for batch in batches]).reshape(-1, 3)
        self._own_radii = np.array([batch.radius for batch in batches])
        self._own_corners = np.array([batch.corners for batch in batches]).reshape(-1, 8, 3)
        self._own_normals = np.array([batch.normal for batch in batches]).reshape(-1, 3)
        self._is_opaque = np.array([batch.opacity >= 1.0 for batch in batches], dtype=bool)
        self._own_densities = np.array([batch.density for batch in batches])
        self._is_known = True

    def _follow(self) -> None:
        """Bring normals and bounds up to date."""
        if self._followed == self.version:
            return
        self._followed = self.version
        if not self._is_known:
            self._stand()
        linear, origin = self.world_from_model[:, :3, :3], self.world_from_model[:, :3, 3]
        self._normals: Array = inverse(linear).transpose(0, 2, 1)
        self._is_mirrored: list[bool] = (determinants(linear) < 0.0).tolist()
        # The largest row sum of A'A bounds the square of the largest stretch; exact without shear.
        squares = np.abs(product(linear.transpose(0, 2, 1), linear)).sum(axis=2).max(axis=1)
        stretch = np.sqrt(squares)[self._owners].astype(np.float64)
        turn, shift = linear[self._owners].transpose(0, 2, 1), origin[self._owners]
        centres = product(self._own_centres[:, None], turn)[:, 0] + shift
        radii = self._own_radii * stretch
        self._spheres: Array = np.column_stack([centres, radii])
        self._corners: Array = product(self._own_corners, turn) + shift[:, None]
        facing = self._normals[self._owners].transpose(0, 2, 1)
        turned = product(self._own_normals[:, None], facing)[:, 0]
        sizes = np.linalg.norm(turned, axis=1, keepdims=True)
        self._flat_normals: Array = np.divide(turned, sizes, out=turned, where=sizes > 0.0)
        # As above, the normals' matrix bounds how much a model shrinks, and its texels crowd.
        crowding = (
            np.abs(product(self._normals.transpose(0, 2, 1), self._normals)).sum(axis=2).max(axis=1)
        )
        self._densities: Array = self._own_densities * np.sqrt(crowding)[self._owners]
        high = np.full((len(self.ids), 3), -np.inf)
        low = np.full((len(self.ids), 3), np.inf)
        np.maximum.at(high, self._owners, centres + radii[:, None])
        np.minimum.at(low, self._owners, centres - radii[:, None])
        self._radii: Array = (high - low).max(axis=1, initial=-np.inf) / 2.0


class Slots:
    """The buffer of the uniform blocks of all instances: poses in the camera's frame."""

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

    def fill(self, instances: Instances, camera_from_world: Array) -> None:
        """Write the block of every instance into the slot of its row."""
        n = len(instances.ids)
        if not n:
            return
        if len(self._values) < n:
            self._values = np.zeros(2 * n, dtype=self._DTYPE)
            self._buffer.orphan(self._values.nbytes)
        models = product(camera_from_world, instances.world_from_model)
        normals = product(camera_from_world[:3, :3], instances.normals)
        values = self._values[:n]
        values["camera_from_model"] = models.transpose(0, 2, 1)  # OpenGL counts columns first
        values["camera_normals"][:, :3, :3] = normals.transpose(0, 2, 1)
        values["identity"][:, 0] = instances.ids
        self._buffer.write(values.tobytes())

    def bind(self, slot: int) -> None:
        """Bind the block of a slot for the next draw call."""
        self._buffer.bind_to_uniform_block(
            INSTANCE.binding, offset=slot * STRIDE, size=INSTANCE.dtype.itemsize
        )


def in_view(
    instances: Instances, rows: Sequence[int], world_from_camera: Pose, planes: Array
) -> list[int]:
    """Numbers of the batches whose bounds reach into the frustum, near ones first.

    Bounds are the sphere and the box: of a wall, the sphere reaches far round it.

    Near is by the far side of the sphere, so small things come before the tank they float in and
    the tank's pixels behind them are never shaded.

    Args:
        instances: All there are.
        rows: Of those that are looked at.
        world_from_camera: Where the camera is.
        planes: Of the frustum, camera frame, (6, 4).
    """
    numbers = instances.owned(rows)
    if not len(numbers):
        return []
    spheres = instances.spheres[numbers]
    centres = product(spheres[:, :3] - world_from_camera.position, world_from_camera.rotation)
    beyond = product(centres, planes[:, :3].T) + planes[:, 3] + spheres[:, 3:]  # (n, 6) [m]
    near = np.flatnonzero(np.all(beyond > 0.0, axis=1))
    numbers, spheres, centres = numbers[near], spheres[near], centres[near]
    corners = instances.corners[numbers]
    points = product(corners - world_from_camera.position, world_from_camera.rotation)
    inside = product(points, planes[:, :3].T) + planes[:, 3] > 0.0  # (n, 8, 6)
    visible = np.all(np.any(inside, axis=1), axis=1)
    nearness = np.linalg.norm(centres, axis=1) + spheres[:, 3]
    order = np.argsort(nearness, kind="stable")
    seen: list[int] = numbers[order[visible[order]]].tolist()
    return seen
