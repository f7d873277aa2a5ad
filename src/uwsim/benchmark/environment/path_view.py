r"""The path of a ``<pathFollowing>`` as a vehicle sees it.

With the point :math:`c(s)` at the length s of the path, the length :math:`s^*` of the point nearest
to the base's origin p, and the rotation R of the base, it is

===================  =========================================================================
pathError            :math:`R^T (c(s^*) - p)` (3) [m]
pathDirection        :math:`R^T t`, the direction t of the path at :math:`s^*` (3) [1]
pathAhead            :math:`R^T (c(s^* + a) - p)` for a = 0.5, 1 and 2 m (9) [m]
===================  =========================================================================

The nearest point is found as by the measure: on the current segment or the next one.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate_rows
from ...base.numerics.polyline import Polyline
from ...world import World
from ..measures import PathFollowingSpec

AHEAD_LENGTHS = (0.5, 1.0, 2.0)
"""The lengths of path from the nearest point to the observed points ahead [m]."""
SIZE = 6 + 3 * len(AHEAD_LENGTHS)
"""The number of numbers of a view."""


class PathView:
    """A reader of the path from a vehicle.

    Args:
        spec: the measure, with a ``<u:path>``.
        world: the scene.

    Raises:
        UnknownName: the scene lacks a name in the measure.
    """

    def __init__(self, spec: PathFollowingSpec, world: World) -> None:
        assert spec.reference is not None
        self._frame = None if spec.from_ is None else world.body(spec.from_)
        self._path = Polyline(spec.reference.read(spec.path, world))
        self._segment = 0

    def read(self, world_from_base: Pose) -> Array:
        """Return error, direction and points ahead, in base axes, (`SIZE`,) [m, 1]."""
        frame_from_base = world_from_base
        if self._frame is not None:
            frame_from_world = self._frame.world_from_body.inverse()
            frame_from_base = frame_from_world @ world_from_base
        place = frame_from_base.position
        segment = -1
        while segment != self._segment:  # the vehicle may have passed several
            segment = self._segment
            self._segment, _, path_length = self._path.follow(segment, place)
        points = [self._path.position(path_length + step) for step in (0.0, *AHEAD_LENGTHS)]
        vectors = [point - place for point in points]
        vectors.insert(1, self._path.direction(self._segment))
        view: Array = rotate_rows(frame_from_base.rotation.T.copy(), np.array(vectors)).ravel()
        return view
