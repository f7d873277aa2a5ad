r"""Sand over buried objects, and what dredging takes of it.

An object of the attribute ``buried`` = b lies in a heap over its box in W: as high as b times the
height h of the box, level over it, with a skirt around it of the length 3 b h that falls as

.. math:: b h \Bigl(1 - \bigl(\frac{d}{3 b h}\bigr)^2\Bigr)

with the distance d from the level part. It is a grid of columns `CELL` wide; larger heaps have
`MAX_COLUMNS` of them a side. Cameras and rays meet it. Places at which sand is taken are rounded to
`GRAIN`, so that replays dig the same sand from the places alone. Not modelled: forces of the sand
on bodies, slopes that slide, sand that settles elsewhere, particles in the water.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ...assets.mesh import Mesh, Model
from ...base.geometry import Array
from ...base.record import Record
from ...results.motion import GRAIN, Spot
from ...scene.spec import SceneSpec

CELL = 0.01
"""Width of a column, and what is taken of one at once [m]."""
MAX_COLUMNS = 256
"""Of a heap along a side."""
REACH = 0.1
"""Columns whose top is as near as this to a tool lose sand [m]."""
COLOUR = (0.72, 0.64, 0.46)
FAR = 2**31
"""Of a heap's lower corner: nothing is taken so far away [`GRAIN`]."""


@dataclass(slots=True)
class HeapState(Record):
    """The sand of a heap."""

    heights: Array
    """The heights of the columns above the bottom, (along x, along y) [m]."""
    version: int = 0
    """A number that changes whenever sand is taken or put back."""
    taken: list[Spot] = field(default_factory=list)
    """Where sand was taken so far, in order."""


class Heap:
    """The sand over one object.

    Args:
        name: of the object.
        lower: of its box, the smallest coordinates in W, (3,) [m].
        upper: the largest.
        buried: how much of its height is under sand [1].
    """

    def __init__(self, name: str, lower: Array, upper: Array, buried: float) -> None:
        self.name = name
        """Of the object."""
        top = float(upper[2] - lower[2]) * buried
        skirt = 3.0 * top
        low, high = lower[:2] - skirt, upper[:2] + skirt
        cell = max(CELL, float((high - low).max()) / MAX_COLUMNS)
        counts = np.maximum(2, np.ceil((high - low) / cell).astype(int) + 1)
        self._x, self._y = (low[i] + cell * np.arange(counts[i]) for i in (0, 1))
        away_x, away_y = (
            np.maximum(0.0, np.maximum(lower[i] - axis, axis - upper[i]))
            for i, axis in enumerate((self._x, self._y))
        )
        away = np.minimum(np.hypot(away_x[:, None], away_y[None, :]) / skirt, 1.0)
        self._bottom = float(lower[2])
        self._untouched: Array = top * (1.0 - away**2)
        self.state = HeapState(self._untouched.copy())
        """Its sand."""

    @property
    def version(self) -> int:
        """A number that changes whenever sand is taken or put back."""
        return self.state.version

    @property
    def corner(self) -> Array:
        """Its lower corner in W, (3,) [m]."""
        return np.array([self._x[0], self._y[0], self._bottom])

    @property
    def cell(self) -> float:
        """Width of a column [m]."""
        return float(self._x[1] - self._x[0])

    @property
    def heights(self) -> Array:
        """Heights of the columns above the bottom now, (along x, along y) [m]; a copy."""
        return self.state.heights.copy()

    def height(self, x: float, y: float) -> float:
        """Return the height of the nearest column, in W [m]; its bottom beside the heap."""
        i, j = np.abs(self._x - x).argmin(), np.abs(self._y - y).argmin()
        is_there = self._x[0] <= x <= self._x[-1] and self._y[0] <= y <= self._y[-1]
        return self._bottom + (float(self.state.heights[i, j]) if is_there else 0.0)

    def dig(self, point: Array) -> int:
        """Take sand around a point in W (3,) [m]; returns how many columns lost some."""
        steps = np.rint((point - self.corner) / GRAIN)
        if not (np.abs(steps) < FAR).all():
            return 0
        x, y, z = (int(step) for step in steps)
        return self._take((x, y, z))

    def show(self, spots: Sequence[Spot]) -> None:
        """Make it what it is when sand has been taken at some places, one after the other."""
        n = len(self.state.taken)
        if self.state.taken != list(spots[:n]):
            np.copyto(self.state.heights, self._untouched)
            self.state.taken, n = [], 0
            self.state.version += 1
        for spot in spots[n:]:
            self._take(spot)

    def _take(self, spot: Spot) -> int:
        x, y, z = (step * GRAIN for step in spot)
        across = (self._x[:, None] - self._x[0] - x) ** 2 + (self._y[None, :] - self._y[0] - y) ** 2
        lost = (across + (self.state.heights - z) ** 2 < REACH**2) & (self.state.heights > 0.0)
        if n := int(np.count_nonzero(lost)):
            self.state.heights[lost] = np.maximum(0.0, self.state.heights[lost] - CELL)
            self.state.taken.append(spot)
            self.state.version += 1
        return n

    def mesh(self) -> Mesh:
        """The surface as it is now, in W."""
        shape = self.state.heights.shape
        x, y = np.meshgrid(self._x, self._y, indexing="ij")
        points = np.stack([x, y, self._bottom + self.state.heights], axis=2).reshape(-1, 3)
        slope_x, slope_y = np.gradient(self.state.heights, self._x, self._y)
        normals = np.stack([-slope_x, -slope_y, np.ones(shape)], axis=2).reshape(-1, 3)
        normals /= np.sqrt((normals**2).sum(axis=1, keepdims=True))
        number = np.arange(x.size).reshape(shape)
        a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        triangles = np.concatenate(
            [np.stack(each, axis=2).reshape(-1, 3) for each in ((a, b, c), (a, c, d))]
        )
        return Mesh(
            vertices=points.astype(np.float32),
            normals=normals.astype(np.float32),
            uvs=np.zeros((len(points), 2), np.float32),
            triangles=triangles.astype(np.uint32),
            colour=COLOUR,
        )

    def model(self) -> Model:
        """The surface as it is now, as a model."""
        return Model(name=f"sand/{self.name}", meshes=(self.mesh(),), source="stand-in")


def heaps_of(scene: SceneSpec, corners: Sequence[tuple[int, Array]]) -> tuple[Heap, ...]:
    """The heaps of a scene, in the file's order.

    Args:
        scene: spec of the scene.
        corners: number of an object and corners of a part of it in W, (n, 3) [m].
    """
    heaps = []
    for index, thing in enumerate(scene.objects):
        own = [points for number, points in corners if number == index]
        if thing.buried > 0.0 and own:
            points = np.concatenate(own)
            lower, upper = points.min(axis=0), points.max(axis=0)
            if upper[2] > lower[2]:
                heaps.append(Heap(thing.name, lower, upper, min(thing.buried, 1.0)))
    return tuple(heaps)
