"""Rays against triangles: the same as looking at every triangle, and as the formulas of solids."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.rays import RayScene, Surface

HERE = Pose.identity()


def soup(n: int, seed: int, spread: float = 5.0) -> np.ndarray:
    """Triangles anywhere, (n, 3, 3) [m]."""
    random = np.random.default_rng(seed)
    centres = random.uniform(-spread, spread, (n, 1, 3))
    return centres + random.normal(scale=0.5, size=(n, 3, 3))


def all_around(n: int, seed: int = 1) -> np.ndarray:
    random = np.random.default_rng(seed)
    ways = random.normal(size=(n, 3))
    return ways / np.linalg.norm(ways, axis=1, keepdims=True)


def first_of_all(triangles: np.ndarray, ways: np.ndarray) -> np.ndarray:
    """Distances from the origin by linear equations, one for each ray and triangle."""
    a, b, c = triangles.transpose(1, 0, 2)
    found = np.full(len(ways), np.inf)
    for i, way in enumerate(ways):
        matrix = np.stack([b - a, c - a, np.broadcast_to(-way, a.shape)], axis=2)
        u, v, t = np.linalg.solve(matrix, -a[..., None])[..., 0].T
        met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
        found[i] = t[met].min(initial=np.inf)
    return found


def square(half: float, height: float = 0.0) -> np.ndarray:
    """A level square that looks up, (2, 3, 3) [m]."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float) * half
    corners[:, 2] = height
    return corners[[[0, 1, 2], [0, 2, 3]]]


def test_rays_find_what_a_look_at_every_triangle_finds() -> None:
    triangles, ways = soup(300, seed=0), all_around(400)
    hits = RayScene([[Surface(7, triangles, is_two_sided=True)]]).cast(HERE, ways, 100.0)
    expected = first_of_all(triangles, ways)
    assert np.isfinite(expected).sum() > 100
    np.testing.assert_allclose(hits.distance, expected, rtol=1e-9)
    assert set(hits.surface[np.isfinite(expected)]) == {7}
    assert set(hits.surface[~np.isfinite(expected)]) == {-1}


def test_a_ray_finds_the_same_among_its_neighbours_and_far_from_them() -> None:
    """Neighbours go down the tree together; rays that go apart each alone."""
    scene = RayScene([[Surface(1, soup(300, seed=3))], [Surface(2, soup(300, seed=4), True)]])
    angles = np.linspace(-math.pi, math.pi, 1001)
    ways = np.stack([np.sin(angles), 0.1 * np.cos(7 * angles), np.cos(angles)], axis=1)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    order = np.random.default_rng(5).permutation(len(ways))
    together, apart = scene.cast(HERE, ways, 100.0), scene.cast(HERE, ways[order], 100.0)
    assert np.isfinite(together.distance).sum() > 100
    for one, other in zip(together, apart, strict=True):
        np.testing.assert_array_equal(one[order], other)


def test_normals_are_those_of_the_face_and_point_back() -> None:
    pose = Pose(np.array([0.0, 0.0, 3.0]), np.eye(3))
    tilted = square(10.0) @ rotation_from_rpy(0.3, 0.2, 0.0).T
    hits = RayScene([[Surface(0, tilted)]]).cast(pose, np.array([[0.0, 0.0, -1.0]]), 100.0)
    np.testing.assert_allclose(hits.normal[0], rotation_from_rpy(0.3, 0.2, 0.0)[:, 2], atol=1e-12)


def test_faces_are_not_hit_from_behind_unless_both_sides_are_seen() -> None:
    up = np.array([[0.0, 0.0, 1.0]])
    below = Pose(np.array([0.0, 0.0, -2.0]), np.eye(3))
    assert RayScene([[Surface(0, square(1.0))]]).cast(below, up, 9.0).distance[0] == np.inf
    both = RayScene([[Surface(0, square(1.0), is_two_sided=True)]]).cast(below, up, 9.0)
    assert both.distance[0] == pytest.approx(2.0)
    assert both.normal[0, 2] == -1.0


def test_no_ray_passes_between_two_triangles() -> None:
    """Rays at the very edges and corners of a grid all hit it."""
    axis = np.linspace(-1.0, 1.0, 21)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    grid = np.stack([x, y, 0.05 * np.sin(7.0 * x + 3.0 * y)], axis=2)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    triangles = np.concatenate([np.stack(t, 2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))])
    eye = np.array([0.013, 0.007, 2.0])
    inner = grid[1:-1, 1:-1].reshape(-1, 3)
    middles = 0.5 * (grid[1:-2, 1:-1] + grid[2:-1, 1:-1]).reshape(-1, 3)
    ways = np.concatenate([inner, middles]) - eye
    far = np.linalg.norm(ways, axis=1)
    hits = RayScene([[Surface(0, triangles)]]).cast(
        Pose(eye, np.eye(3)), ways / far[:, None], 100.0
    )
    np.testing.assert_allclose(hits.distance, far, rtol=1e-8)


def test_a_body_is_hit_where_it_was_put() -> None:
    """Moved, turned and stretched: as if its triangles were moved."""
    own, ways = soup(80, seed=3, spread=1.0), all_around(300, seed=4)
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_from_rpy(0.4, -0.2, 1.0) @ np.diag([1.0, 2.0, 0.5])
    matrix[:3, 3] = 0.5, -0.3, 1.0
    scene = RayScene([[Surface(0, own, is_two_sided=True)]])
    scene.place(0, matrix)
    moved = own @ matrix[:3, :3].T + matrix[:3, 3]
    found = scene.cast(HERE, ways, 100.0)
    baked = RayScene([[Surface(0, moved, is_two_sided=True)]]).cast(HERE, ways, 100.0)
    np.testing.assert_allclose(found.distance, baked.distance, rtol=1e-9)
    np.testing.assert_allclose(found.normal, baked.normal, atol=1e-9)


def test_the_nearest_of_several_bodies_is_hit() -> None:
    scene = RayScene([[Surface(3, square(5.0))], [Surface(4, square(0.5))]])
    lifted = np.eye(4)
    lifted[2, 3] = 1.0
    scene.place(1, lifted)
    above = Pose(np.array([0.0, 0.0, 4.0]), np.eye(3))
    slant = np.array([0.6, 0.0, -0.8])
    hits = scene.cast(above, np.array([[0.0, 0.0, -1.0], slant]), 100.0)
    assert hits.distance.tolist() == pytest.approx([3.0, 5.0])
    assert hits.surface.tolist() == [4, 3]


def test_rays_end_at_their_reach() -> None:
    scene = RayScene([[Surface(0, square(5.0))]])
    above = Pose(np.array([0.0, 0.0, 4.0]), np.eye(3))
    down = np.array([[0.0, 0.0, -1.0]])
    assert scene.cast(above, down, 4.1).distance[0] == 4.0
    assert scene.cast(above, down, 3.9).distance[0] == np.inf


def test_what_is_before_the_beginning_of_a_ray_is_not_hit() -> None:
    scene = RayScene([[Surface(1, square(5.0, -1.0)), Surface(2, square(5.0, -3.0))]])
    down = np.array([[0.0, 0.0, -1.0]] * 2)
    hits = scene.cast(HERE, down, 10.0, np.array([0.5, 1.5]))
    assert hits.distance.tolist() == [1.0, 3.0]
    assert hits.surface.tolist() == [1, 2]


@pytest.mark.parametrize("bodies", [[], [[]], [[Surface(0, np.zeros((0, 3, 3)))]]])
def test_where_nothing_is_nothing_is_hit(bodies: list[list[Surface]]) -> None:
    hits = RayScene(bodies).cast(HERE, all_around(5), 100.0)
    assert (hits.distance == np.inf).all()


def test_triangles_in_one_place_make_a_tree_all_the_same() -> None:
    stacked = np.repeat(square(1.0), 40, axis=0)
    above = Pose(np.array([0.1, 0.2, 1.0]), np.eye(3))
    hits = RayScene([[Surface(0, stacked)]]).cast(above, np.array([[0.0, 0.0, -1.0]]), 5.0)
    assert hits.distance[0] == 1.0


def test_a_cone_of_rays_finds_a_body_at_its_rim() -> None:
    """What leaves out bodies beside all rays leaves out no other."""
    ways = all_around(400, seed=8)
    ways = ways[ways[:, 2] < -math.cos(0.5)]
    bodies = [[Surface(k, soup(6, seed=k, spread=3.0), is_two_sided=True)] for k in range(30)]
    apart = RayScene(bodies).cast(HERE, ways, 100.0)
    together = RayScene([[surface for body in bodies for surface in body]]).cast(HERE, ways, 100.0)
    np.testing.assert_array_equal(apart.distance, together.distance)
    np.testing.assert_array_equal(apart.surface, together.surface)


def engine_at(n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Places of an engine's bodies: origins (n, 3) [m], axes (n, 3, 3)."""
    random = np.random.default_rng(seed)
    axes = [rotation_from_rpy(*random.uniform(-3.0, 3.0, 3)) for _ in range(n)]
    return random.uniform(-6.0, 6.0, (n, 3)), np.array(axes)


def frame_of(origin: np.ndarray, axes: np.ndarray) -> np.ndarray:
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = axes, origin
    return frame


@pytest.mark.parametrize("n", [1, 5, 60])
def test_bodies_that_follow_an_engine_are_met_where_it_has_them_now(n: int) -> None:
    """Moved a little, far, not at all, one of them or all: as a scene whose bodies are placed."""
    random = np.random.default_rng(n)
    bodies = [[Surface(i, soup(40, seed=i, spread=1.5), True)] for i in range(n + 1)]
    origins, axes = engine_at(n, seed=8)
    # body 0 is placed; the others follow, in another order
    number = np.array([-1, *random.permutation(n)], np.int32)
    moving = RayScene(bodies).with_engine(number, origins, axes)
    fan = np.stack(
        [np.zeros(64), np.sin(np.linspace(-1, 1, 64)), np.cos(np.linspace(-1, 1, 64))], 1
    )
    narrow = np.array([1.0, 0.0, 0.0]) + 0.02 * all_around(40)
    narrow /= np.linalg.norm(narrow, axis=1, keepdims=True)
    n_met = 0
    for step in range(24):
        chosen = random.permutation(n)[: [0, 1, n][step % 3]]
        origins[chosen] += random.normal(scale=[1e-6, 1e-2, 3.0][step % 3], size=(len(chosen), 3))
        axes[chosen] = engine_at(n, seed=step)[1][chosen]
        placed = RayScene(bodies)
        for body in range(1, n + 1):
            placed.place(body, frame_of(origins[number[body]], axes[number[body]]))
        here = Pose(random.uniform(-7.0, 7.0, 3), rotation_from_rpy(*random.uniform(-3, 3, 3)))
        for ways in (fan, narrow, all_around(50, seed=step)):
            found, expected = (each.cast(here, ways, 9.0) for each in (moving, placed))
            n_met += int((found.surface >= 0).sum())
            for part in ("distance", "normal", "surface"):
                assert getattr(found, part).tobytes() == getattr(expected, part).tobytes()
        assert moving.balls().centre.tobytes() == placed.balls().centre.tobytes()
    assert n_met > 20


def test_of_many_bodies_each_ray_meets_what_it_meets_of_them_in_one() -> None:
    bodies = [soup(8, seed=i, spread=0.5) for i in range(200)]
    apart = RayScene([[Surface(i, each, True)] for i, each in enumerate(bodies)])
    moved = []
    for i, (origin, axes) in enumerate(zip(*engine_at(200, seed=1), strict=True)):
        apart.place(i, frame_of(origin, axes))
        moved.append(bodies[i] @ axes.T + origin)
    ways = all_around(3000)
    whole = RayScene([[Surface(i, each, True) for i, each in enumerate(moved)]])
    found, expected = apart.cast(HERE, ways, 20.0), whole.cast(HERE, ways, 20.0)
    assert (found.surface >= 0).sum() > 300
    assert found.surface.tolist() == expected.surface.tolist()
    np.testing.assert_allclose(found.distance, expected.distance, rtol=1e-9)


def test_a_body_that_is_taken_up_is_placed_and_follows_again_when_it_is_let_go() -> None:
    origins, axes = np.array([[0.0, 0.0, 1.0]]), np.eye(3)[None].copy()
    follows, is_placed = np.array([-1, 0], np.int32), np.array([-1, -1], np.int32)
    scene = RayScene([[], [Surface(4, square(0.5))]]).with_engine(follows, origins, axes)
    above, down = Pose(np.array([0.0, 0.0, 4.0]), np.eye(3)), np.array([[0.0, 0.0, -1.0]])
    assert scene.cast(above, down, 9.0).distance[0] == 3.0
    scene = scene.with_engine(is_placed, origins, axes)
    lifted = np.eye(4)
    lifted[2, 3] = 2.5
    scene.place(1, lifted)
    assert scene.cast(above, down, 9.0).distance[0] == 1.5
    scene = scene.with_engine(follows, origins, axes)
    assert scene.cast(above, down, 9.0).distance[0] == 3.0
    origins[0, 0] = 2.0
    assert scene.cast(above, down, 9.0).distance[0] == np.inf
