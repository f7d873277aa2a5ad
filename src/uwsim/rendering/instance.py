"""Instances of models: their poses and bounds, and the selection of batches in view."""

from __future__ import annotations

import math
from collections.abc import Sequence

import moderngl
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.linear import determinants, inverse
from ..errors import UnknownName
from . import bounds
from .gpu_model import Batch
from .minification import can_skip_mipmaps
from .program import Block

INSTANCE = Block(
    "Instance", 1, {"camera_from_model": "mat4", "camera_normals": "mat4", "identity": "uvec4"}
)
STRIDE = 256
"""The distance between the blocks of two instances in the buffer [bytes], a multiple of the
alignment of every driver."""
Indices = npt.NDArray[np.intp]


class Instances:
    """The instances of models in W; bounds and normals are computed for all of them at once.

    An instance is identified by its handle. Arrays have one row for each instance, in the order in
    which they were added. Batches are numbered through all instances in this order.
    """

    def __init__(self) -> None:
        self.version = 0
        """The number of times that an instance was added, moved or removed."""
        self.arrangement = 0
        """The version at which an instance was last added or removed; batch numbers change then."""
        self._next_handle = 1
        self._bounds_version = -1  # the version of normals and bounds
        self.clear()

    def clear(self) -> None:
        """Remove all instances."""
        self._change_arrangement()
        self._rows: dict[int, int] = {}
        self.ids: list[int] = []
        """The numbers of the instances in the id image, 1..65535."""
        self.batches: list[tuple[Batch, ...]] = []
        """The batches of each instance."""
        self.world_from_model: Array = np.zeros((0, 4, 4))
        """The poses, (n, 4, 4); they may include scale, also uneven or mirroring."""
        self.moved_versions: npt.NDArray[np.int64] = np.zeros(0, dtype=np.int64)
        """The version at which each instance last moved, (n,)."""

    def add(self, batches: tuple[Batch, ...], id: int) -> int:
        """Add a model at the origin of W; return its handle."""
        handle = self._next_handle
        self._next_handle += 1
        self._change_arrangement()
        self._rows[handle] = len(self.ids)
        self.ids.append(id)
        self.batches.append(batches)
        self.world_from_model = np.concatenate([self.world_from_model, np.eye(4)[None]])
        self.moved_versions = np.append(self.moved_versions, self.version)
        return handle

    def place(self, handles: Sequence[int], world_from_model: Array) -> None:
        """Set the poses of instances, (k, 4, 4); raise UnknownName for an unknown handle."""
        rows = np.array([self._row(handle) for handle in handles], dtype=np.intp)
        poses = np.ascontiguousarray(world_from_model)
        if bounds.set_poses(
            poses, rows, self.version + 1, self.world_from_model, self.moved_versions
        ):
            self.version += 1

    def remove(self, handle: int) -> None:
        """Remove an instance; raise UnknownName if the handle is unknown."""
        row = self._row(handle)
        self._change_arrangement()
        del self._rows[handle], self.ids[row], self.batches[row]
        self._rows = {h: r - (r > row) for h, r in self._rows.items()}
        self.world_from_model = np.delete(self.world_from_model, row, axis=0)
        self.moved_versions = np.delete(self.moved_versions, row)

    def find_shown(self, hidden_ids: frozenset[int]) -> Indices:
        """Return the indices of the batches of all instances whose id is not hidden, (m,)."""
        self._update_bounds()
        if hidden_ids not in self._shown_by_hidden:
            is_shown = np.array([id not in hidden_ids for id in self.ids], dtype=bool)
            self._shown_by_hidden[hidden_ids] = np.flatnonzero(is_shown[self._owners])
        return self._shown_by_hidden[hidden_ids]

    @property
    def normals(self) -> Array:
        """The matrices from model normals to world normals, (n, 3, 3)."""
        self._update_bounds()
        return self._normals

    @property
    def is_mirrored(self) -> list[bool]:
        """The flags of the instances: True if the matrix mirrors the model."""
        self._update_bounds()
        return self._is_mirrored

    @property
    def owners(self) -> Indices:
        """The row of the instance to which each batch belongs, (m,)."""
        self._update_bounds()
        return self._owners

    @property
    def has_holes(self) -> bool:
        """True if a surface has holes, so that depths depend on a texture."""
        self._update_bounds()
        return self._has_holes

    def find_casters(self, indices: Indices, max_radius: float) -> Indices:
        """Return the indices of the batches that cast the sun's shadow.

        Transparent batches cast no shadow, nor do batches of large instances.

        Args:
            indices: the indices of the batches to check.
            max_radius: half the longest side of the largest bounding box that casts a shadow [m].
        """
        self._update_bounds()
        is_small = self._radii[self._owners[indices]] <= max_radius
        casters: Indices = indices[self._is_opaque[indices] & is_small]
        return casters

    def find_hulls(
        self, indices: Indices, radii: tuple[float, float], max_height: float
    ) -> Indices:
        """Return the indices of the opaque batches of large instances that are no ground.

        They are below a height, and at least a fifth as high as they are long.

        Args:
            indices: the indices of the batches to check.
            radii: half the longest side of the box: the excluded least, and the greatest [m].
            max_height: the height in W of the highest top [m].
        """
        self._update_bounds()
        owners, heights = self._owners[indices], self._corners[indices, :, 2]
        low, high = np.full(len(self.ids), np.inf), np.full(len(self.ids), -np.inf)
        np.minimum.at(low, owners, heights.min(axis=1))
        np.maximum.at(high, owners, heights.max(axis=1))
        is_hull = (self._radii > radii[0]) & (self._radii <= radii[1]) & (high < max_height)
        is_hull &= high - low > 0.4 * self._radii
        hulls: Indices = indices[is_hull[owners] & self._is_opaque[indices]]
        return hulls

    def find_lowest_point(self, min_radius: float) -> float:
        """Return the height of the lowest corner of large instances; -infinity without any [m].

        Args:
            min_radius: half the longest side of the smallest bounding box that counts [m].
        """
        self._update_bounds()
        heights = self._corners[self._radii[self._owners] > min_radius, :, 2]
        return float(heights.min()) if heights.size > 0 else -math.inf

    def are_opaque(self, indices: Indices) -> bool:
        """Return True if all batches with these numbers are opaque."""
        self._update_bounds()
        return bool(self._is_opaque[indices].all())

    @property
    def spheres(self) -> Array:
        """The bounding spheres of the batches in W: centre and radius, (m, 4) [m]."""
        self._update_bounds()
        return self._spheres

    @property
    def corners(self) -> Array:
        """The corners of the bounding boxes of the batches in W, (m, 8, 3) [m]."""
        self._update_bounds()
        return self._corners

    def can_skip_mipmaps(
        self, indices: Indices, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> list[bool]:
        """Return for each batch True if it can be drawn without mipmaps (`minification`)."""
        self._update_bounds()
        flags: list[bool] = can_skip_mipmaps(
            self._densities[indices],
            self._flat_normals[indices],
            self._corners[indices],
            world_from_camera,
            intrinsics,
        ).tolist()
        return flags

    @property
    def numbered_batches(self) -> list[tuple[int, Batch]]:
        """The batches by index, each with the row of its instance."""
        self._update_bounds()
        return self._numbered_batches

    def _row(self, handle: int) -> int:
        if handle not in self._rows:
            raise UnknownName("instance", str(handle), map(str, self._rows))
        return self._rows[handle]

    def _change_arrangement(self) -> None:
        """Record that an instance is added or removed."""
        self.version += 1
        self.arrangement = self.version
        self._has_batches = False  # True if the batches are collected

    def _collect_batches(self) -> None:
        """Collect the batches of all instances."""
        self._shown_by_hidden: dict[frozenset[int], Indices] = {}
        self._numbered_batches = [
            (row, batch)
            for row, instance_batches in enumerate(self.batches)
            for batch in instance_batches
        ]
        self._owners = np.array([row for row, _ in self._numbered_batches], dtype=np.intp)
        batches = [batch for _, batch in self._numbered_batches]
        spheres = [[*batch.centre, batch.radius] for batch in batches]
        self._model_spheres = np.array(spheres, dtype=np.float64).reshape(-1, 4)
        self._model_corners = np.array([batch.corners for batch in batches]).reshape(-1, 8, 3)
        self._model_normals = np.array([batch.normal for batch in batches]).reshape(-1, 3)
        self._is_opaque = np.array([batch.opacity >= 1.0 for batch in batches], dtype=bool)
        self._model_densities = np.array([batch.density for batch in batches])
        self._has_holes = any(
            batch.material is not None and batch.material.alpha_cutoff is not None
            for batch in batches
        )
        self._has_batches = True

    def _update_bounds(self) -> None:
        """Update normals and bounds to the current version."""
        if self._bounds_version == self.version:
            return
        self._bounds_version = self.version
        if not self._has_batches:
            self._collect_batches()
        linear = self.world_from_model[:, :3, :3]
        self._normals: Array = np.ascontiguousarray(inverse(linear).transpose(0, 2, 1))
        self._is_mirrored: list[bool] = (determinants(linear) < 0.0).tolist()
        n, m = len(self.ids), len(self._owners)
        world_from_model, owners = self.world_from_model, self._owners
        stretch, shrinkage = np.empty(n), np.empty(n)
        bounds.compute_stretch_bounds(np.ascontiguousarray(linear), stretch)
        # The bound of the normals' matrix is the factor by which shrinking increases texel density.
        bounds.compute_stretch_bounds(self._normals, shrinkage)
        self._densities: Array = self._model_densities * shrinkage[owners]
        self._spheres, self._corners = np.empty((m, 4)), np.empty((m, 8, 3))
        bounds.transform_spheres(
            world_from_model, stretch, owners, self._model_spheres, self._spheres
        )
        bounds.transform_corners(world_from_model, owners, self._model_corners, self._corners)
        self._flat_normals = np.empty((m, 3))
        bounds.transform_normals(self._normals, owners, self._model_normals, self._flat_normals)
        self._radii = np.empty(n)
        bounds.compute_half_extents(owners, self._spheres, self._radii)


class Slots:
    """The buffer of the uniform blocks ``Instance``, one slot for each instance.

    A block has the instance's pose in the frame of the camera or light, and its id.
    """

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
        """Write the blocks of all instances; ``camera_from_world`` is as in `bounds`, (4, 4)."""
        n = len(instances.ids)
        if not n:
            return
        if len(self._values) < n:
            self._values = np.zeros(2 * n, dtype=self._DTYPE)
            self._buffer.orphan(self._values.nbytes)
        values = self._values[:n]
        bounds.transform_to_camera(
            np.ascontiguousarray(camera_from_world),
            instances.world_from_model,
            instances.normals,
            values["camera_from_model"],
            values["camera_normals"],
        )
        values["identity"][:, 0] = instances.ids
        self._buffer.write(values)

    def bind(self, slot: int) -> None:
        """Bind the block of an instance, by its row, for the next draw calls."""
        self._buffer.bind_to_uniform_block(
            INSTANCE.binding, offset=slot * STRIDE, size=INSTANCE.dtype.itemsize
        )


def find_visible(
    instances: Instances, indices: Indices, world_from_camera: Pose, planes: Array
) -> Indices:
    """Return the indices of the batches whose bounds reach into the frustum, near ones first.

    Both the bounding sphere and the box are checked: the sphere of a wall is much larger than the
    wall. Batches are sorted by the distance to the far side of their spheres: small objects precede
    the tank around them, so that the tank's pixels behind them are never shaded.

    Args:
        instances: all instances.
        indices: the indices of the batches to check.
        world_from_camera: the pose of the camera.
        planes: the planes of the frustum in the camera's frame, (6, 4).
    """
    distances = np.empty(len(indices))
    bounds.find_far_distances(
        indices,
        instances.spheres,
        instances.corners,
        world_from_camera.position,
        np.ascontiguousarray(world_from_camera.rotation),
        np.ascontiguousarray(planes),
        distances,
    )
    order = np.argsort(distances, kind="stable")[: np.count_nonzero(distances < np.inf)]
    visible_batches: Indices = indices[order]
    return visible_batches
