"""The triangles of a scene for ray casting: moving bodies, each with a bounding volume tree."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.linear import inverse, product
from .bodies import NO_ENGINE, Engine, bodies_of, renew_all_frames
from .cover import Balls, covering_balls
from .kernel import Hits
from .scene_record import cast_all, rays_record, scene_record
from .tree import build_tree
from .triangle import Trees


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles with one surface number."""

    number: int
    """What `Hits.surface` says of a ray that hits them."""
    triangles: Array
    """In the frame of their body, counter-clockwise from outside, (n, 3, 3) [m]."""
    is_two_sided: bool = False
    """Whether rays also hit them from behind."""


class RayScene:
    """A scene for ray casting. A triangle is hit on its outside, as a camera sees it.

    Args:
        bodies: surfaces of each body, in the body's frame. Bodies begin in the place of W.
    """

    def __init__(self, bodies: Sequence[Sequence[Surface]]) -> None:
        built = [_tree(surfaces) for surfaces in bodies]
        nodes = np.cumsum([0, *(len(each.boxes) for each in built)])
        first = np.cumsum([0, *(len(each.triangles) for each in built)])
        for each, node, triangle in zip(built, nodes[:-1], first[:-1], strict=True):
            is_leaf = each.links[:, 1::2] > 0
            each.links[:, ::2] += np.where(is_leaf, triangle, node).astype(np.int32)
        self._trees = Trees(
            boxes=np.concatenate([np.zeros((0, 12)), *(each.boxes for each in built)]),
            links=np.concatenate([np.zeros((0, 4), np.int32), *(each.links for each in built)]),
            triangles=np.concatenate([np.zeros((0, 9)), *(each.triangles for each in built)]),
            surfaces=np.concatenate(
                [np.zeros((0, 2), np.int32), *(each.surfaces for each in built)]
            ),
            roots=nodes[:-1].astype(np.int32),
            balls=np.concatenate([np.zeros((0, 4)), *(each.balls for each in built)]),
        )
        self._engine = NO_ENGINE
        self._bodies = bodies_of(self._trees.balls, np.full(len(built), -1, np.int32), NO_ENGINE)
        self._note()
        covers = [
            cover for body, surfaces in enumerate(bodies) for cover in _covers(body, surfaces)
        ]
        self._cover = np.concatenate([np.zeros((0, 4)), *(balls for balls, _, _ in covers)])
        sizes = [len(balls) for balls, _, _ in covers]
        self._cover_bodies = np.repeat([body for _, body, _ in covers], sizes).astype(np.int32)
        self._cover_surfaces = np.repeat([n for _, _, n in covers], sizes).astype(np.int32)

    def following(self, engine: npt.NDArray[np.int32], origins: Array, axes: Array) -> RayScene:
        """Return a scene of the same bodies that shares their triangles, and follows an engine.

        Args:
            engine: number of the engine's body that each body is on, or below 0 for one that is
                placed, which begins in the place of W, (b,).
            origins: of the engine's bodies, read at each cast, (m, 3) [m].
            axes: of them, read at each cast, (m, 3, 3).
        """
        other = copy.copy(self)
        other._engine = Engine(origins, axes)
        other._bodies = bodies_of(self._trees.balls, engine, other._engine)
        other._note()
        return other

    def _note(self) -> None:
        """Write down where its arrays are."""
        self.record = scene_record(self._trees, self._bodies, self._engine)
        """Its arrays for compiled code, a record of `scene_record.SCENE`, (1,)."""
        self.__dict__.pop("functions", None)

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """What casts rays in it from compiled code, a record of `scene_record.RAYS`, (1,)."""
        return rays_record(self.record)

    @property
    def is_compiled(self) -> bool:
        """Whether compiled code finds all bodies where they are: yes."""
        return True

    def prepare(self) -> None:
        """Bring what compiled code reads up to date: it is."""

    def place(self, body: int, world_from_body: npt.NDArray[np.float64]) -> None:
        """Set the pose of a body that follows nothing; the matrix (4, 4) may scale [m]."""
        frame = self._bodies.world_from_body[body]
        if not np.array_equal(frame, world_from_body):
            self._bodies.body_from_world[body] = inverse(world_from_body)
            frame[:] = world_from_body

    def frames(self) -> Array:
        """Return ``world_from_body`` of each body now, (b, 4, 4) [m]; not to be written to."""
        renew_all_frames(self._bodies, self._engine)
        return self._bodies.world_from_body

    def balls(self) -> Balls:
        """Balls that cover each surface, where they are now."""
        frames = self.frames()[self._cover_bodies]
        centre = (frames[:, :3, :3] * self._cover[:, None, :3]).sum(axis=2) + frames[:, :3, 3]
        scale = np.sqrt((frames[:, :3, :3] ** 2).sum(axis=1).max(axis=1))  # of the longest column
        return Balls(centre, self._cover[:, 3] * scale, self._cover_surfaces)

    def cast(
        self,
        world_from_sensor: Pose,
        directions: Array,
        reach: float,
        begins: Array | None = None,
    ) -> Hits:
        """Cast rays from the origin of a sensor.

        Args:
            world_from_sensor: where the sensor is.
            directions: unit vectors in its frame, (n, 3).
            reach: how far the rays go [m].
            begins: from where on each ray hits, (n,) [m]; without it from the origin.
        """
        return cast(self.functions, world_from_sensor, directions, reach, begins)


def cast(
    functions: npt.NDArray[np.void],
    world_from_sensor: Pose,
    directions: Array,
    reach: float,
    begins: Array | None,
) -> Hits:
    """Cast rays by the first of some records of `scene_record.RAYS`; see `RayScene.cast`."""
    n = len(directions)
    hits = Hits(np.empty(n), np.empty((n, 3)), np.empty(n, dtype=np.int32))
    along = product(directions, world_from_sensor.rotation.T)
    starts = np.zeros(n) if begins is None else begins
    cast_all(functions, world_from_sensor.position, along, starts, float(reach), hits)
    return hits


def _covers(body: int, surfaces: Sequence[Surface]) -> list[tuple[Array, int, int]]:
    """Balls around each numbered surface of a body, with the numbers of body and surface."""
    found = []
    for number in sorted({each.number for each in surfaces}):
        parts = [each.triangles.reshape(-1, 3) for each in surfaces if each.number == number]
        found.append((covering_balls(np.concatenate(parts)), body, number))
    return found


def _tree(surfaces: Sequence[Surface]) -> Trees:
    """The tree of one body."""
    corners = np.concatenate([np.zeros((0, 3, 3)), *(each.triangles for each in surfaces)])
    kinds = [(each.number, each.is_two_sided) for each in surfaces]
    sizes = [len(each.triangles) for each in surfaces]
    numbers = np.repeat(np.array(kinds, dtype=np.int32).reshape(-1, 2), sizes, axis=0)
    boxes, links, order = build_tree(np.ascontiguousarray(corners, dtype=np.float64))
    a, b, c = corners[order].transpose(1, 0, 2)
    return Trees(
        boxes=boxes,
        links=links,
        triangles=np.concatenate([a, b - a, c - a], axis=1),
        surfaces=numbers[order],
        roots=np.zeros(1, dtype=np.int32),
        balls=_ball(corners.reshape(-1, 3))[None],
    )


def _ball(corners: Array) -> Array:
    """Centre and radius of a ball around points (n, 3) [m], (4,)."""
    if not len(corners):
        return np.array([0.0, 0.0, 0.0, 0.0])
    centre = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    return np.array([*centre, np.linalg.norm(corners - centre, axis=1).max() * (1.0 + 1e-9)])
