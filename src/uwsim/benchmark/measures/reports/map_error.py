r"""Map error: the error of the heights in a map of the bottom that the algorithm publishes.

.. code-block:: xml

    <u:mapError>
      <name>map</name> <target>bluerov2</target> <topic>/map</topic>
      <low> <x>0</x> <y>0</y> </low> <high> <x>20</x> <y>16</y> </high>
      <cell>0.5</cell> <tolerance>0.27</tolerance>
    </u:mapError>

The map is in the navigation frame of the vehicle: the axes of L, with the origin at the position of
the vehicle when the measure starts, but at the depth 0 of L.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ....base.geometry import Array, Pose
from ....base.numerics.linear import rotate_rows
from ....errors import BadSetting
from ....messages import PointCloud2, points
from ....schema import MAX_DISTANCE, Spec, element
from ....world import World
from ..measure import Measure, MeasureSpec

MAX_CELLS = 1_000_000
"""The greatest number of cells."""
MAX_POINTS = 100_000
"""The greatest number of points of a map that are read."""
CAST_HEIGHT = 1000.0
"""The height above the vehicle's start from which the bottom is sought, and half the reach [m]."""
MAX_LAYERS = 20
"""The greatest number of surfaces of vehicles that a vertical ray passes."""


@dataclass(frozen=True, kw_only=True)
class PlaceSpec(Spec):
    """A horizontal place in the navigation frame."""

    x: float = element(minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The coordinate along x [m]."""
    y: float = element(minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The coordinate along y [m]."""


@dataclass(frozen=True, kw_only=True)
class MapErrorSpec(MeasureSpec):
    """A ``<u:mapError>`` element of a benchmark file."""

    target: str = element(refers_to="body")
    """The vehicle whose start is the horizontal origin of the map."""
    topic: str
    """The topic of the maps (sensor_msgs/PointCloud2); a map replaces the one before."""
    low: PlaceSpec
    """The corner of the area with the least coordinates, in the navigation frame [m]."""
    high: PlaceSpec
    """The corner of the area with the greatest coordinates, in the navigation frame [m]."""
    cell: float = element(default=0.5, exclusive_minimum=0.0, maximum=MAX_DISTANCE)
    """The side of a cell of the area [m]."""
    tolerance: float = element(exclusive_minimum=0.0)
    """The greatest error of the height of an accurate cell [m]."""

    def errors(self) -> Sequence[str]:
        """Return the error of an area that is empty or has too many cells."""
        sizes = self.high.x - self.low.x, self.high.y - self.low.y
        if min(sizes) < self.cell:
            return [f"<high> is not a cell of {self.cell:g} m beyond <low>"]
        if sizes[0] / self.cell * (sizes[1] / self.cell) > MAX_CELLS:
            return [
                f"<cell> {self.cell:g} m makes more than {MAX_CELLS} cells; choose a larger one"
            ]
        return ()

    def bind(self, world: World) -> MapError:
        """Resolve the target; raises UnknownName if there is none."""
        return MapError(self, world)


class MapError(Measure):
    r"""The root mean square of the error of the newest map, over the cells that it covers.

    A point :math:`(x, y, z)` of the map belongs to the cell that contains it. Its error is the
    height of the map above the true surface at :math:`(x, y)`: the first surface of the scene below
    the sky that is not of a vehicle. The error :math:`e_i` of a cell is the mean of its points.

    .. math:: \text{rms} = \sqrt{\tfrac{1}{n} \sum_i e_i^2}

    Details: ``coverage``, the share of the cells of the area with a point [1]; ``accurate``, the
    share of all cells whose error is at most the tolerance [1]; ``bias``, the mean of the errors
    [m]; ``max``, the greatest magnitude [m]; and ``n_maps``. Points outside of the area, beyond
    the first 100 000, or with a coordinate that is not finite do not count. Without a map,
    ``coverage`` and ``accurate`` are 0. Not modelled: overhangs, of which the upper side counts.
    """

    unit = "m"
    detail_units: ClassVar[Mapping[str, str]] = {
        "coverage": "1", "accurate": "1", "bias": "m", "max": "m", "n_maps": "1",
    }  # fmt: skip
    fed_by_algorithm = True

    def __init__(self, spec: MapErrorSpec, world: World) -> None:
        self._spec, self._world = spec, world
        self._target, self._topic = world.body(spec.target), spec.topic
        self._inbox = world.bus.inbox(spec.topic, PointCloud2)
        sizes = np.array([spec.high.x - spec.low.x, spec.high.y - spec.low.y])
        self._n_cells = np.floor(sizes / spec.cell + 1e-9).astype(np.intp)
        self._origin: Array | None = None  # of the map, in L (3,) [m]
        self._map: Array | None = None  # the points in the area, navigation frame (n, 3) [m]
        self._errors: Array | None = None  # of the covered cells, (n,) [m]
        self._n_maps = 0
        self._note = ""

    def start(self) -> None:
        """Set the origin of the map; maps received before do not count."""
        localized_from_world = self._world.world_from_localized.inverse()
        position = (localized_from_world @ self._target.world_from_body).position
        self._origin = np.array([position[0], position[1], 0.0])
        self._inbox.clear()

    def update(self) -> None:
        """Take the newest map."""
        for message in self._inbox.take():
            try:
                cloud = points(message)[:MAX_POINTS]
            except BadSetting as error:
                self._note = f"a map on {self._topic!r} was not used: {error}"
                continue
            self._n_maps += 1
            self._map, self._errors = self._points_in_area(cloud), None

    @property
    def value(self) -> float | None:
        """The root mean square of the errors [m]; None without a covered cell."""
        errors = self._cell_errors()
        return math.sqrt(float(np.mean(errors * errors))) if len(errors) else None

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self.value is not None:
            return None
        if self._origin is None:
            return "it was never on"
        if not self._n_maps:
            return self._note or f"no map on {self._topic!r}"
        return f"no point of the map on {self._topic!r} lies in the area"

    @property
    def details(self) -> dict[str, float | None]:
        """The shares, the bias, the greatest error and the number of maps."""
        errors = self._cell_errors()
        n_cells = float(np.prod(self._n_cells))
        is_accurate = np.abs(errors) <= self._spec.tolerance
        return {
            "coverage": len(errors) / n_cells,
            "accurate": float(is_accurate.sum()) / n_cells,
            "bias": float(np.mean(errors)) if len(errors) else None,
            "max": float(np.max(np.abs(errors))) if len(errors) else None,
            "n_maps": float(self._n_maps),
        }

    @property
    def reasons(self) -> dict[str, str]:
        """The reason why there are no errors."""
        reason = self.missing_reason
        return {} if reason is None else {"bias": reason, "max": reason}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The value and the shares."""
        return ("rms", "coverage", "accurate")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values."""
        details = self.details
        return (self.value, details["coverage"], details["accurate"])

    @property
    def notes(self) -> tuple[str, ...]:
        """The error of an invalid map."""
        return (self._note,) if self._note else ()

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()

    def _points_in_area(self, cloud: Array) -> Array:
        cloud = cloud[np.isfinite(cloud).all(axis=1) & (np.abs(cloud) < MAX_DISTANCE).all(axis=1)]
        cells = self._cells_of(cloud)
        is_inside = ((cells >= 0) & (cells < self._n_cells)).all(axis=1)
        return cloud[is_inside]

    def _cells_of(self, cloud: Array) -> npt.NDArray[np.intp]:
        low = np.array([self._spec.low.x, self._spec.low.y])
        cells: npt.NDArray[np.intp] = np.floor((cloud[:, :2] - low) / self._spec.cell).astype(
            np.intp
        )
        return cells

    def _cell_errors(self) -> Array:
        """Return the error of each covered cell, (n,) [m], computed once for a map."""
        if self._map is None or self._origin is None:
            return np.zeros(0)
        if self._errors is None:
            errors = self._point_errors(self._map + self._origin)
            is_known = np.isfinite(errors)
            rows, columns = self._cells_of(self._map[is_known]).T
            index = rows * self._n_cells[1] + columns
            n = int(np.prod(self._n_cells))
            counts = np.bincount(index, minlength=n)
            sums = np.bincount(index, weights=errors[is_known], minlength=n)
            self._errors = sums[counts > 0] / counts[counts > 0]
        return self._errors

    def _point_errors(self, places: Array) -> Array:
        """Return the height of points in L (n, 3) [m] above the surface [m]; NaN without one."""
        frame = self._world.world_from_localized
        world_points = rotate_rows(frame.rotation, places) + frame.position
        return world_points[:, 2] - self._surface_heights(world_points)

    def _surface_heights(self, places: Array) -> Array:
        """Return the heights in W of the surface at points in W (n, 3) [m]; NaN without one."""
        rays, down = self._world.surroundings.rays, np.array([[0.0, 0.0, -1.0]])
        is_vehicle = np.array([name != "" for name in rays.vehicles], dtype=np.bool_)
        heights = np.full(len(places), np.nan)
        for i, (x, y, z) in enumerate(places.tolist()):
            top = z + CAST_HEIGHT
            pose, start = Pose(np.array([x, y, top]), np.eye(3)), 0.0
            for _ in range(MAX_LAYERS):
                hits = rays.cast(pose, down, 2.0 * CAST_HEIGHT, np.array([start]))
                if hits.surface[0] < 0:
                    break
                if not is_vehicle[hits.surface[0]]:
                    heights[i] = top - float(hits.distance[0])
                    break
                start = float(hits.distance[0]) + 1e-4
        return heights
