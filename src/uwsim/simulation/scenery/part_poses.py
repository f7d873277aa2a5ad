"""The poses of the visible parts of a scene: of one part, or of all parts for an image."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import multiply_matrices, product
from ...cameras.exposure import Displacement
from ...model.parts import Part
from ...physics.poses import Poses


class PartPoses:
    """The poses of the visible parts of a scene, as matrices that include their scale."""

    def __init__(self, parts: Sequence[Part], poses: Poses) -> None:
        self._parts, self._poses = parts, poses
        frames = [part.frame_from_mesh for part in parts]
        self._frame_from_mesh: Array = np.array(frames, dtype=np.float64).reshape(-1, 4, 4)
        self._carried_objects: list[int] | None = (
            None  # the carried objects for which `_bodies` is valid
        )
        self._bodies = np.zeros(0, dtype=np.int64)  # the engine's body of each part; -1: none
        self._unattached_parts: list[int] = []  # the parts without a body of the engine

    def world_from_mesh(self, part: Part) -> Array:
        """Return the present pose of a part in W with its scale, (4, 4) [m]."""
        if part.vehicle is None and part.object is None:
            frame = self._poses.segment(part.link).matrix
        elif part.vehicle is None:
            assert part.object is not None
            frame = self._poses.object(part.object).matrix
        else:
            frame = self._poses.link_frame(part.vehicle, part.link)
        return product(frame, part.frame_from_mesh)

    def compute_all(self) -> Array:
        """Return the present poses in W of all parts, in the order of the scene, (n, 4, 4) [m]."""
        poses, carried_objects = self._poses, list(self._poses.state.carriers)
        if self._carried_objects != carried_objects:
            bodies = [poses.engine_body(p.vehicle, p.link, p.object) for p in self._parts]
            self._bodies = np.array(bodies, dtype=np.int64)
            self._unattached_parts = np.flatnonzero(self._bodies < 0).tolist()
            self._carried_objects = carried_objects
        poses.refresh()
        poses_now = np.empty_like(self._frame_from_mesh)
        _write_poses(poses.origins, poses.axes, self._bodies, self._frame_from_mesh, poses_now)
        for index in self._unattached_parts:
            poses_now[index] = self.world_from_mesh(self._parts[index])
        return poses_now

    def compute_displaced(self, displacement: Displacement, vehicle_names: Sequence[str]) -> Array:
        """Return the poses of all parts, with a vehicle where it is at another time, (n, 4, 4)."""
        poses = self.compute_all()
        for index, part in enumerate(self._parts):
            if part.vehicle is not None and vehicle_names[part.vehicle] == displacement.vehicle:
                poses[index] = product(displacement.matrix, poses[index])
        return poses


@njit
def _write_poses(
    origins: Array,
    axes: Array,
    bodies: npt.NDArray[np.int64],
    frame_from_mesh: Array,
    world_from_mesh: Array,
) -> None:
    """Write the poses of the parts that move with bodies of the engine, (n, 4, 4) [m].

    Args:
        origins: the origins of the engine's bodies in W, (m, 3) [m].
        axes: the axes of the engine's bodies in W, as columns, (m, 3, 3).
        bodies: the number of the engine's body of each part, (n,); -1: none.
        frame_from_mesh: the poses of the parts on their bodies, (n, 4, 4) [m].
        world_from_mesh: the poses of the parts in W, which are written, (n, 4, 4) [m].
    """
    frame = np.eye(4)
    for n in range(len(bodies)):
        if bodies[n] >= 0:
            frame[:3, :3], frame[:3, 3] = axes[bodies[n]], origins[bodies[n]]
            world_from_mesh[n] = multiply_matrices(frame, frame_from_mesh[n])
