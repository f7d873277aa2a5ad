"""A scene for ray casting: moving bodies, each with a bounding volume tree of triangles."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.linear import inverse, product
from .bodies import NO_ENGINE_FRAMES, EngineFrames, make_bodies, update_all_frames
from .cover import Balls, covering_balls
from .height_rays import HeightRays
from .kernel import Hits
from .scene_record import cast_all, rays_record, scene_record
from .tree import build_tree
from .triangle import Trees


@dataclass(frozen=True, eq=False)
class Surface:
    """A set of triangles that rays report with one number."""

    number: int
    """The value of `Hits.surface` for rays that hit the triangles."""
    triangles: Array
    """The triangles in the frame of their body, counter-clockwise from outside, (n, 3, 3) [m]."""
    is_two_sided: bool = False
    """True if rays also hit the triangles from behind."""


class RayScene:
    """A scene for ray casting, in which rays hit triangles from outside and grids from above.

    Args:
        bodies: the surfaces of each body, in the body's frame. All initial poses are the identity.
        grids: the fixed height grids.
    """

    def __init__(
        self, bodies: Sequence[Sequence[Surface]], grids: Sequence[HeightRays] = ()
    ) -> None:
        self._grids = tuple(grids)
        records = [grid.record for grid in grids]
        self.grid_records = np.concatenate(records) if records else None
        """The records of the height grids for compiled code, (n,); None without grids."""
        trees = [_make_tree(surfaces) for surfaces in bodies]
        nodes = np.cumsum([0, *(len(tree.boxes) for tree in trees)])
        triangle_starts = np.cumsum([0, *(len(tree.triangles) for tree in trees)])
        for tree, node, triangle in zip(trees, nodes[:-1], triangle_starts[:-1], strict=True):
            is_leaf = tree.links[:, 1::2] > 0
            tree.links[:, ::2] += np.where(is_leaf, triangle, node).astype(np.int32)
        self._trees = Trees(
            boxes=np.concatenate([np.zeros((0, 12)), *(tree.boxes for tree in trees)]),
            links=np.concatenate([np.zeros((0, 4), np.int32), *(tree.links for tree in trees)]),
            triangles=np.concatenate([np.zeros((0, 9)), *(tree.triangles for tree in trees)]),
            surfaces=np.concatenate(
                [np.zeros((0, 2), np.int32), *(tree.surfaces for tree in trees)]
            ),
            roots=nodes[:-1].astype(np.int32),
            balls=np.concatenate([np.zeros((0, 4)), *(tree.balls for tree in trees)]),
        )
        self._engine_frames = NO_ENGINE_FRAMES
        self._bodies = make_bodies(
            self._trees.balls, np.full(len(trees), -1, np.int32), NO_ENGINE_FRAMES
        )
        self._write_records()
        covers = [
            cover
            for body, surfaces in enumerate(bodies)
            for cover in _surface_covers(body, surfaces)
        ]
        self._cover_balls = np.concatenate([np.zeros((0, 4)), *(balls for balls, _, _ in covers)])
        sizes = [len(balls) for balls, _, _ in covers]
        self._cover_bodies = np.repeat([body for _, body, _ in covers], sizes).astype(np.int32)
        self._cover_surfaces = np.repeat([n for _, _, n in covers], sizes).astype(np.int32)

    def with_engine(
        self, engine_body: npt.NDArray[np.int32], origins: Array, axes: Array
    ) -> RayScene:
        """Return a scene that shares the triangles of this scene and follows a physics engine.

        Args:
            engine_body: the index of the engine's body that each body follows, (b,). Below 0, the
                pose is set by `place`, and initially the identity.
            origins: the origins of the engine's bodies in W, read at each cast, (m, 3) [m].
            axes: the rotation matrices ``world_from_body``, read at each cast, (m, 3, 3).
        """
        scene = copy.copy(self)
        scene._engine_frames = EngineFrames(origins, axes)
        scene._bodies = make_bodies(self._trees.balls, engine_body, scene._engine_frames)
        scene._write_records()
        return scene

    def _write_records(self) -> None:
        """Write the addresses of the arrays into records."""
        self.record = scene_record(self._trees, self._bodies, self._engine_frames)
        """The addresses of the arrays for compiled code, a record of `scene_record.SCENE`, (1,)."""
        self.__dict__.pop("functions", None)

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """The functions for compiled code, a record of `scene_record.RAYS`, (1,)."""
        return rays_record(self.record, self.grid_records)

    @property
    def is_compiled(self) -> bool:
        """True if compiled code reads the present poses; it always does."""
        return True

    def prepare(self) -> None:
        """Do nothing, as the inputs of compiled code are always up to date."""

    def place(self, body: int, world_from_body: npt.NDArray[np.float64]) -> None:
        """Set the transform (4, 4) of a body that does not follow the engine; it may scale."""
        frame = self._bodies.world_from_body[body]
        if not np.array_equal(frame, world_from_body):
            self._bodies.body_from_world[body] = inverse(world_from_body)
            frame[:] = world_from_body

    def frames(self) -> Array:
        """Return the present ``world_from_body`` of each body, not to be changed, (b, 4, 4)."""
        update_all_frames(self._bodies, self._engine_frames)
        return self._bodies.world_from_body

    def balls(self) -> Balls:
        """Return balls that cover the surfaces at their present poses."""
        frames = self.frames()[self._cover_bodies]
        centre = (frames[:, :3, :3] * self._cover_balls[:, None, :3]).sum(axis=2) + frames[:, :3, 3]
        scale = np.sqrt((frames[:, :3, :3] ** 2).sum(axis=1).max(axis=1))  # of the longest column
        return Balls(centre, self._cover_balls[:, 3] * scale, self._cover_surfaces)

    def cast(
        self,
        world_from_sensor: Pose,
        directions: Array,
        reach: float,
        starts: Array | None = None,
    ) -> Hits:
        """Cast rays from the origin of a sensor.

        Args:
            world_from_sensor: the pose of the sensor.
            directions: unit vectors in the frame of the sensor, (n, 3).
            reach: the length of the rays [m].
            starts: the distance at which each ray begins, (n,) [m]; by default 0.
        """
        return cast(self.functions, world_from_sensor, directions, reach, starts)


def cast(
    functions: npt.NDArray[np.void],
    world_from_sensor: Pose,
    directions: Array,
    reach: float,
    starts: Array | None,
) -> Hits:
    """Cast rays with a record of `scene_record.RAYS`, (1,); see `RayScene.cast`."""
    n = len(directions)
    hits = Hits(np.empty(n), np.empty((n, 3)), np.empty(n, dtype=np.int32))
    world_directions = product(directions, world_from_sensor.rotation.T)
    all_starts = np.zeros(n) if starts is None else starts
    cast_all(
        functions, world_from_sensor.position, world_directions, all_starts, float(reach), hits
    )
    return hits


def _surface_covers(body: int, surfaces: Sequence[Surface]) -> list[tuple[Array, int, int]]:
    """Return, for each surface of a body, the covering balls, the body and the surface number."""
    covers = []
    for number in sorted({surface.number for surface in surfaces}):
        parts = [
            surface.triangles.reshape(-1, 3) for surface in surfaces if surface.number == number
        ]
        covers.append((covering_balls(np.concatenate(parts)), body, number))
    return covers


def _make_tree(surfaces: Sequence[Surface]) -> Trees:
    """Return the tree of a single body."""
    corners = np.concatenate([np.zeros((0, 3, 3)), *(surface.triangles for surface in surfaces)])
    kinds = [(surface.number, surface.is_two_sided) for surface in surfaces]
    sizes = [len(surface.triangles) for surface in surfaces]
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
    """Return the centre and radius of a ball around points (n, 3) [m], (4,)."""
    if not len(corners):
        return np.array([0.0, 0.0, 0.0, 0.0])
    centre = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    return np.array([*centre, np.linalg.norm(corners - centre, axis=1).max() * (1.0 + 1e-9)])
