"""Where the models of a scene are: of one, and of all at once for an image."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import multiply_matrices, product
from ...model.parts import Part
from ...physics.poses import Poses


class PartPoses:
    """The poses of the models of a scene, with their scale.

    Args:
        parts: the models.
        poses: the frames of their links and objects.
    """

    def __init__(self, parts: Sequence[Part], poses: Poses) -> None:
        self._parts, self._poses = parts, poses
        frames = [part.frame_from_mesh for part in parts]
        self._frame_from_mesh: Array = np.array(frames, dtype=np.float64).reshape(-1, 4, 4)
        self._carried: list[int] | None = None  # the objects that followed links when it was found
        self._bodies = np.zeros(0, dtype=np.int64)  # of the engine; -1: the part follows none
        self._others: list[int] = []  # the parts that follow none

    def world_from_mesh(self, part: Part) -> Array:
        """Return where a part is now, (4, 4) [m]."""
        if part.vehicle is None:
            assert part.object is not None
            frame = self._poses.object(part.object).matrix
        else:
            frame = self._poses.link_frame(part.vehicle, part.link)
        return product(frame, part.frame_from_mesh)

    def of_all(self) -> Array:
        """Return where the parts are now, in their order, (n, 4, 4) [m]."""
        poses, carried = self._poses, list(self._poses.state.carriers)
        if self._carried != carried:
            bodies = [poses.engine_body(p.vehicle, p.link, p.object) for p in self._parts]
            self._bodies = np.array(bodies, dtype=np.int64)
            self._others = np.flatnonzero(self._bodies < 0).tolist()
            self._carried = carried
        poses.refresh()
        found = np.empty_like(self._frame_from_mesh)
        _place(poses.origins, poses.axes, self._bodies, self._frame_from_mesh, found)
        for number in self._others:
            found[number] = self.world_from_mesh(self._parts[number])
        return found


@njit
def _place(
    origins: Array,
    axes: Array,
    bodies: npt.NDArray[np.int64],
    frame_from_mesh: Array,
    world_from_mesh: Array,
) -> None:
    """Write where parts on bodies of the engine are, (n, 4, 4) [m], those with a body alone.

    Args:
        origins: of the engine's bodies, (m, 3) [m].
        axes: of these, (m, 3, 3).
        bodies: of the parts, (n,); -1: none.
        frame_from_mesh: the parts on their bodies, (n, 4, 4) [m].
        world_from_mesh: which is written.
    """
    frame = np.eye(4)
    for n in range(len(bodies)):
        if bodies[n] >= 0:
            frame[:3, :3], frame[:3, 3] = axes[bodies[n]], origins[bodies[n]]
            world_from_mesh[n] = multiply_matrices(frame, frame_from_mesh[n])
