"""The pose of a point of one body in the frame of another."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length, rotate, rotate_back
from ...world import Body


class RelativePose:
    """The present pose of a frame at a point of one body, in a frame at a point of another.

    The axes of the frames are those of the bodies.

    Args:
        from_body: the body in whose axes the pose is expressed.
        to_body: the body whose pose is expressed.
        from_point: the origin of the first frame in ``from_body``, (3,) [m].
        to_point: the origin of the second frame in ``to_body``, (3,) [m].
    """

    def __init__(
        self,
        from_body: Body,
        to_body: Body,
        from_point: Sequence[float],
        to_point: Sequence[float],
    ) -> None:
        self._from_body, self._to_body = from_body, to_body
        self._from_point, self._to_point = np.array(from_point), np.array(to_point)

    def position(self) -> Array:
        """Return the position of the second point in the axes of the first body, (3,) [m]."""
        frame = self._from_body.world_from_body
        return rotate_back(frame.rotation, self._vector())

    def distance(self) -> float:
        """Return the distance of the two points [m]."""
        return length(self._vector())

    def axes(self) -> Array:
        """Return the x and y axes of the second body in the axes of the first, (6,) [1]."""
        first, second = (
            self._from_body.world_from_body.rotation,
            self._to_body.world_from_body.rotation,
        )
        x_axis, y_axis = second[:, 0].copy(), second[:, 1].copy()
        return np.concatenate([rotate_back(first, x_axis), rotate_back(first, y_axis)])

    def _vector(self) -> Array:
        """Return the vector from the first point to the second, in W, (3,) [m]."""
        start, end = self._from_body.world_from_body, self._to_body.world_from_body
        vector: Array = (
            rotate(end.rotation, self._to_point)
            + end.position
            - rotate(start.rotation, self._from_point)
            - start.position
        )
        return vector
