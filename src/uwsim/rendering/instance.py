"""Instances of models: their poses, their bounds, and which of them are in view."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.linear import determinants, inverse
from ..errors import UnknownName
from . import bounds
from .gpu_model import Batch
from .minification import needs_no_copies
from .program import Block

INSTANCE = Block(
    "Instance", 1, {"camera_from_model": "mat4", "camera_normals": "mat4", "identity": "uvec4"}
)
STRIDE = 256
"""Bytes from slot to slot in the buffer of instances; every driver's alignment divides it."""
Numbers = npt.NDArray[np.intp]


class Instances:
    """Instances of models in W; bounds and normals are computed for all of them at once.

    Each is identified by a handle; arrays have a row for each, in the order of adding.
    """

    def __init__(self) -> None:
        self.version = 0
        """Grows with every change of anything that may cast a shadow."""
        self.arrangement = 0
        """The version at which an instance last came or went: numbers of batches hold for one."""
        self._next_handle = 1
        self._followed = -1  # the version that normals and bounds are of
        self.clear()

    def clear(self) -> None:
        """Remove all instances."""
        self._rearrange()
        self._rows: dict[int, int] = {}
        self.ids: list[int] = []
        """Their numbers in the id image, 1..65535."""
        self.batches: list[tuple[Batch, ...]] = []
        """The batches of each instance."""
        self.world_from_model: Array = np.zeros((0, 4, 4))
        """(n, 4, 4); may carry scale, uneven or mirroring."""
        self.moved: npt.NDArray[np.int64] = np.zeros(0, dtype=np.int64)
        """The version at which each instance last moved, (n,)."""

    def add(self, batches: tuple[Batch, ...], id: int) -> int:
        """Put a model at the origin of W; returns its handle."""
        handle = self._next_handle
        self._next_handle += 1
        self._rearrange()
        self._rows[handle] = len(self.ids)
        self.ids.append(id)
        self.batches.append(batches)
        self.world_from_model = np.concatenate([self.world_from_model, np.eye(4)[None]])
        self.moved = np.append(self.moved, self.version)
        return handle

    def place(self, handles: Sequence[int], world_from_model: Array) -> None:
        """Set the poses of instances, (k, 4, 4); UnknownName if one is not there."""
        rows = np.array([self._row(handle) for handle in handles], dtype=np.intp)
        places = np.ascontiguousarray(world_from_model)
        if bounds.put(places, rows, self.version + 1, self.world_from_model, self.moved):
            self.version += 1

    def remove(self, handle: int) -> None:
        """Remove an instance; UnknownName if it is not there."""
        row = self._row(handle)
        self._rearrange()
        del self._rows[handle], self.ids[row], self.batches[row]
        self._rows = {h: r - (r > row) for h, r in self._rows.items()}
        self.world_from_model = np.delete(self.world_from_model, row, axis=0)
        self.moved = np.delete(self.moved, row)

    def without(self, hidden: frozenset[int]) -> Numbers:
        """Numbers of the batches of instances whose ids are not hidden, (m,)."""
        self._follow()
        if hidden not in self._shown:
            is_shown = np.array([id not in hidden for id in self.ids], dtype=bool)
            self._shown[hidden] = np.flatnonzero(is_shown[self._owners])
        return self._shown[hidden]

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
    def owners(self) -> Numbers:
        """Row of the instance that each batch belongs to, (m,)."""
        self._follow()
        return self._owners

    def casting(self, numbers: Numbers, max_radius: float) -> Numbers:
        """Return those of some batches that cast the sun's shadow.

        Transparent ones cast none, nor do those of instances with a larger bounding box.

        Args:
            numbers: of the batches.
            max_radius: half the longest side of the box, at most [m].
        """
        self._follow()
        is_small = self._radii[self._owners[numbers]] <= max_radius
        casting: Numbers = numbers[self._is_opaque[numbers] & is_small]
        return casting

    def are_opaque(self, numbers: Numbers) -> bool:
        """Whether none of some batches is seen through."""
        self._follow()
        return bool(self._is_opaque[numbers].all())

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
        self, numbers: Numbers, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> list[bool]:
        """Whether batches need no mipmaps of their textures (`minification`)."""
        self._follow()
        found: list[bool] = needs_no_copies(
            self._densities[numbers],
            self._flat_normals[numbers],
            self._corners[numbers],
            world_from_camera,
            intrinsics,
        ).tolist()
        return found

    @property
    def numbered(self) -> list[tuple[int, Batch]]:
        """All batches by their numbers: the row of the instance that it belongs to, and itself."""
        self._follow()
        return self._drawn

    def _row(self, handle: int) -> int:
        if handle not in self._rows:
            raise UnknownName("instance", str(handle), map(str, self._rows))
        return self._rows[handle]

    def _rearrange(self) -> None:
        """Note that an instance comes or goes."""
        self.version += 1
        self.arrangement = self.version
        self._is_known = False  # whether it is known which batches there are

    def _stand(self) -> None:
        """Take note of which batches there are."""
        self._shown: dict[frozenset[int], Numbers] = {}
        self._drawn = [
            (row, batch) for row, several in enumerate(self.batches) for batch in several
        ]
        self._owners = np.array([row for row, _ in self._drawn], dtype=np.intp)
        batches = [batch for _, batch in self._drawn]
        spheres = [[*batch.centre, batch.radius] for batch in batches]
        self._own_spheres = np.array(spheres, dtype=np.float64).reshape(-1, 4)
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
        linear = self.world_from_model[:, :3, :3]
        self._normals: Array = np.ascontiguousarray(inverse(linear).transpose(0, 2, 1))
        self._is_mirrored: list[bool] = (determinants(linear) < 0.0).tolist()
        n, m = len(self.ids), len(self._owners)
        world_from_model, owners = self.world_from_model, self._owners
        stretch, crowding = np.empty(n), np.empty(n)
        bounds.stretches(np.ascontiguousarray(linear), stretch)
        # The normals' matrix bounds how much a model shrinks, and its texels crowd.
        bounds.stretches(self._normals, crowding)
        self._densities: Array = self._own_densities * crowding[owners]
        self._spheres, self._corners = np.empty((m, 4)), np.empty((m, 8, 3))
        bounds.carry(world_from_model, stretch, owners, self._own_spheres, self._spheres)
        bounds.carry_corners(world_from_model, owners, self._own_corners, self._corners)
        self._flat_normals = np.empty((m, 3))
        bounds.carry_normals(self._normals, owners, self._own_normals, self._flat_normals)
        self._radii = np.empty(n)
        bounds.half_extents(owners, self._spheres, self._radii)


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
        values = self._values[:n]
        bounds.see(
            np.ascontiguousarray(camera_from_world),
            instances.world_from_model,
            instances.normals,
            values["camera_from_model"],
            values["camera_normals"],
        )
        values["identity"][:, 0] = instances.ids
        self._buffer.write(values)

    def bind(self, slot: int) -> None:
        """Bind the block of a slot for the next draw call."""
        self._buffer.bind_to_uniform_block(
            INSTANCE.binding, offset=slot * STRIDE, size=INSTANCE.dtype.itemsize
        )


def in_view(
    instances: Instances, numbers: Numbers, world_from_camera: Pose, planes: Array
) -> Numbers:
    """Numbers of the batches whose bounds reach into the frustum, near ones first.

    Bounds are the sphere and the box: of a wall, the sphere reaches far round it.

    Near is by the far side of the sphere, so small things come before the tank they float in and
    the tank's pixels behind them are never shaded.

    Args:
        instances: All there are.
        numbers: Of the batches that are looked at.
        world_from_camera: Where the camera is.
        planes: Of the frustum, camera frame, (6, 4).
    """
    nearness = np.empty(len(numbers))
    bounds.look(
        numbers,
        instances.spheres,
        instances.corners,
        world_from_camera.position,
        np.ascontiguousarray(world_from_camera.rotation),
        np.ascontiguousarray(planes),
        nearness,
    )
    order = np.argsort(nearness, kind="stable")[: np.count_nonzero(nearness < np.inf)]
    seen: Numbers = numbers[order]
    return seen
