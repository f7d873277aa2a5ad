r"""Heaps of sand over buried objects, and the removal of sand by dredging.

A heap of sand covers each object with the attribute ``buried`` = b. The heap is level above the
object's bounding box in W, at b times the height h of the box. Around the box it falls to the
bottom within the length 3 b h; at the distance d from the box its height is

.. math:: b h \Bigl(1 - \bigl(\frac{d}{3 b h}\bigr)^2\Bigr)

A heap is a grid of columns, each `CELL_WIDTH` wide; the columns of large heaps are wider, at most
`MAX_COLUMNS` along a side. In physical water a heap has a texture and ends where no sand is; with
the fog law, as in UWSim, it is a square of one colour. Cameras and rays see the sand. The positions
at which sand is removed are rounded to `GRAIN`, so that replays remove the same sand. Not modelled:
forces of the sand on bodies, slopes that slide, sand that settles elsewhere, particles in the
water.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...assets.mesh import Mesh, Model, Texture
from ...assets.procedural.sand_texture import MEAN, TILE, make_sand_texture
from ...base.geometry import Array
from ...base.record import Record
from ...results.motion import GRAIN, Spot
from ...scene.spec import SceneSpec

CELL_WIDTH = 0.01
"""The width of a column, and the height that a tool removes from a column at once [m]."""
MAX_COLUMNS = 256
"""The maximum number of columns of a heap along a side."""
TOOL_REACH = 0.1
"""The distance from a tool within which the top of a column loses sand [m]."""
COLOUR = (0.72, 0.64, 0.46)
"""The colour of sand without a texture, RGB [0..1]."""
TEXTURED_COLOUR = (0.69, 0.65, 0.52)
"""The mean colour of sand with a texture, RGB [0..1]."""
MAX_OFFSET = 2**31
"""The distance from a heap's lower corner beyond which no sand is removed, in units of `GRAIN`."""


@dataclass(slots=True)
class HeapState(Record):
    """The state of a heap: the sand that is left in it."""

    heights: Array
    """The heights of the columns above the lower corner, (n columns along x, m along y) [m]."""
    version: int = 0
    """A number that changes whenever sand is removed or put back."""
    spots: list[Spot] = field(default_factory=list)
    """The positions at which sand was removed, in order, in `GRAIN` from the lower corner."""


class Heap:
    """The heap of sand over one object.

    Args:
        name: the name of the object.
        lower: the lower corner of the object's bounding box in W, (3,) [m].
        upper: the upper corner of the bounding box in W, (3,) [m].
        buried_share: the fraction of the object's height that is under sand [1].
        texture: the texture of the sand, by whose mean its colour is divided; None: it has one
            colour.
    """

    def __init__(
        self,
        name: str,
        lower: Array,
        upper: Array,
        buried_share: float,
        texture: Texture | None = None,
    ) -> None:
        self._texture = texture
        self.name = name
        """The name of the object."""
        top = float(upper[2] - lower[2]) * buried_share
        skirt = 3.0 * top
        low, high = lower[:2] - skirt, upper[:2] + skirt
        cell = max(CELL_WIDTH, float((high - low).max()) / MAX_COLUMNS)
        counts = np.maximum(2, np.ceil((high - low) / cell).astype(int) + 1)
        self._x, self._y = (low[i] + cell * np.arange(counts[i]) for i in (0, 1))
        distance_x, distance_y = (
            np.maximum(0.0, np.maximum(lower[i] - axis, axis - upper[i]))
            for i, axis in enumerate((self._x, self._y))
        )
        distance = np.minimum(np.hypot(distance_x[:, None], distance_y[None, :]) / skirt, 1.0)
        self._bottom = float(lower[2])
        self._initial_heights: Array = top * (1.0 - distance**2)
        self.state = HeapState(self._initial_heights.copy())
        """The state: the sand that is left."""

    @property
    def version(self) -> int:
        """A number that changes whenever sand is removed or put back."""
        return self.state.version

    @property
    def corner(self) -> Array:
        """The lower corner of the heap in W, (3,) [m]."""
        return np.array([self._x[0], self._y[0], self._bottom])

    @property
    def cell(self) -> float:
        """The width of a column [m]."""
        return float(self._x[1] - self._x[0])

    @property
    def heights(self) -> Array:
        """The heights of the columns above the lower corner, (n along x, m along y) [m]; a copy."""
        return self.state.heights.copy()

    def height(self, x: float, y: float) -> float:
        """Return z in W of the sand's surface at (x, y) [m]; beside the heap z of its bottom."""
        i, j = np.abs(self._x - x).argmin(), np.abs(self._y - y).argmin()
        is_inside = self._x[0] <= x <= self._x[-1] and self._y[0] <= y <= self._y[-1]
        return self._bottom + (float(self.state.heights[i, j]) if is_inside else 0.0)

    def dig(self, point: Array) -> int:
        """Remove sand around a point in W (3,) [m]; return the number of columns that lost some."""
        steps = np.rint((point - self.corner) / GRAIN)
        if not (np.abs(steps) < MAX_OFFSET).all():
            return 0
        x, y, z = (int(step) for step in steps)
        return self._remove_sand((x, y, z))

    def restore(self, spots: Sequence[Spot]) -> None:
        """Restore the heap from which sand was removed at these positions, in this order."""
        n = len(self.state.spots)
        if self.state.spots != list(spots[:n]):
            np.copyto(self.state.heights, self._initial_heights)
            self.state.spots, n = [], 0
            self.state.version += 1
        for spot in spots[n:]:
            self._remove_sand(spot)

    def _remove_sand(self, spot: Spot) -> int:
        x, y, z = (step * GRAIN for step in spot)
        squares = (self._x[:, None] - self._x[0] - x) ** 2 + (
            self._y[None, :] - self._y[0] - y
        ) ** 2
        is_lower = (squares + (self.state.heights - z) ** 2 < TOOL_REACH**2) & (
            self.state.heights > 0.0
        )
        if n := int(np.count_nonzero(is_lower)):
            self.state.heights[is_lower] = np.maximum(
                0.0, self.state.heights[is_lower] - CELL_WIDTH
            )
            self.state.spots.append(spot)
            self.state.version += 1
        return n

    def mesh(self) -> Mesh:
        """Return the present surface as a mesh in W."""
        shape = self.state.heights.shape
        x, y = np.meshgrid(self._x, self._y, indexing="ij")
        points = np.stack([x, y, self._bottom + self.state.heights], axis=2).reshape(-1, 3)
        slope_x, slope_y = np.gradient(self.state.heights, self._x, self._y)
        normals = np.stack([-slope_x, -slope_y, np.ones(shape)], axis=2).reshape(-1, 3)
        normals /= np.sqrt((normals**2).sum(axis=1, keepdims=True))
        number = np.arange(x.size).reshape(shape)
        a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        triangles = np.concatenate(
            [np.stack(corners, axis=2).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
        )
        plain_mesh = Mesh(
            vertices=points.astype(np.float32),
            normals=normals.astype(np.float32),
            uvs=np.zeros((len(points), 2), np.float32),
            triangles=triangles.astype(np.uint32),
            colour=COLOUR,
        )
        if self._texture is None:
            return plain_mesh
        is_sand = self._initial_heights.reshape(-1)[triangles].max(axis=1) > 0.0
        red, green, blue = (value * 255.0 / MEAN for value in TEXTURED_COLOUR)
        return replace(
            plain_mesh,
            uvs=(points[:, :2] / TILE).astype(np.float32),
            triangles=plain_mesh.triangles[is_sand],
            colour=(red, green, blue),
            texture=self._texture,
        )

    def model(self) -> Model:
        """Return the present surface as a model in W."""
        return Model(name=f"sand/{self.name}", meshes=(self.mesh(),), source="stand-in")


def make_heaps(scene: SceneSpec, corners: Sequence[tuple[int, Array]]) -> tuple[Heap, ...]:
    """Return the heaps over the buried objects of a scene, in the file's order.

    Args:
        scene: the spec of the scene.
        corners: for each visible part of an object, the index of the object and the corners of
            the part's bounding box in W, (n, 3) [m].
    """
    heaps = []
    is_textured = scene.ocean_state.water is not None and any(o.buried > 0 for o in scene.objects)
    texture = make_sand_texture() if is_textured else None
    for index, spec in enumerate(scene.objects):
        clouds = [points for object_index, points in corners if object_index == index]
        if spec.buried > 0.0 and clouds:
            points = np.concatenate(clouds)
            lower, upper = points.min(axis=0), points.max(axis=0)
            if upper[2] > lower[2]:
                heaps.append(Heap(spec.name, lower, upper, min(spec.buried, 1.0), texture))
    return tuple(heaps)
