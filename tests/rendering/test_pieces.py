"""Models in pieces: nothing is lost, and what is known of a piece is true."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.base.geometry import Array, Intrinsics, Pose, rotation_from_rpy
from uwsim.rendering.minification import MAX_TEXELS, can_skip_mipmaps
from uwsim.rendering.pieces import (
    compute_normals,
    compute_texel_densities,
    flat_normal,
    split_triangles,
)

CAMERA = Intrinsics.from_fovy(64, 48, np.radians(50.0))


def grid(n: int, size: float) -> tuple[Array, np.ndarray]:
    """A square floor of 2 n^2 triangles about the origin."""
    steps = np.linspace(-size / 2.0, size / 2.0, n + 1)
    points = np.array([[x, y, 0.0] for x in steps for y in steps])
    corners = [i * (n + 1) + k for i in range(n) for k in range(n)]
    triangles = [[c, c + n + 1, c + 1] for c in corners]
    triangles += [[c + 1, c + n + 1, c + n + 2] for c in corners]
    return points, np.array(triangles, np.uint32)


def test_every_triangle_is_in_one_piece_and_pieces_are_small() -> None:
    points, triangles = grid(16, 7.9)
    parts = split_triangles(points, triangles, compute_normals(points, triangles))
    assert sorted(np.concatenate(parts).tolist()) == list(range(len(triangles)))
    assert len(parts) == 16
    for part in parts:
        assert np.ptp(points[triangles[part]].reshape(-1, 3), axis=0).max() < 2.5


def test_what_is_small_stays_whole() -> None:
    points, triangles = grid(16, 1.9)
    assert len(split_triangles(points, triangles, compute_normals(points, triangles))) == 1
    points, triangles = grid(2, 50.0)
    assert len(split_triangles(points, triangles, compute_normals(points, triangles))) == 1


def test_floor_and_wall_come_apart() -> None:
    points, triangles = grid(8, 3.0)
    wall = points @ rotation_from_rpy(np.pi / 2.0, 0.0, 0.0).T
    both = np.concatenate([points, wall])
    triangles = np.concatenate([triangles, triangles + len(points)])
    directions = compute_normals(both, triangles)
    parts = split_triangles(both, triangles, directions)
    normals = [flat_normal(directions[part]) for part in parts]
    assert {tuple(np.abs(normal).round(9).tolist()) for normal in normals} == {
        (0.0, 0.0, 1.0),
        (0.0, 1.0, 0.0),
    }


def test_a_bent_piece_has_no_normal() -> None:
    points, triangles = grid(4, 1.0)
    points[:, 2] = 0.1 * points[:, 0] ** 2
    assert (flat_normal(compute_normals(points, triangles)) == 0.0).all()
    points[:, 2] = 0.1 * points[:, 0]
    assert flat_normal(compute_normals(points, triangles)) == pytest.approx(
        np.array([-0.1, 0.0, 1.0]) / np.hypot(1.0, 0.1)
    )


def test_the_density_is_the_largest_stretch_of_the_texture() -> None:
    points, triangles = grid(4, 2.0)
    map_ = np.array([[30.0, 40.0], [5.0, -8.0]])  # texels per metre, sheared
    turned = points @ rotation_from_rpy(0.3, -0.4, 0.7).T
    largest = np.linalg.svd(map_, compute_uv=False)[0]
    found = compute_texel_densities(turned, triangles, points[:, :2] @ map_.T)
    assert found == pytest.approx(np.full(len(triangles), largest))
    assert compute_texel_densities(0.0 * turned, triangles, points[:, :2]) == pytest.approx(0.0)


def footprint(normal: Array, point: Array) -> float:
    """The longest way on a plane that a pixel covers, over the whole image [m], by rays."""
    u, v = np.meshgrid(np.linspace(-0.5, 63.5, 65), np.linspace(-0.5, 47.5, 49))
    rays = np.stack([(u - CAMERA.cx) / CAMERA.fx, (CAMERA.cy - v) / CAMERA.fy, -np.ones_like(u)], 2)
    hits = rays * ((normal @ point) / (rays @ normal))[..., None]
    across = np.linalg.norm(np.diff(hits, axis=1), axis=2).max()
    return float(max(across, np.linalg.norm(np.diff(hits, axis=0), axis=2).max()))


@pytest.mark.parametrize("tilt", [0.0, 0.1, 0.4, 0.8])
def test_no_pixel_covers_more_texels_than_was_promised(tilt: float) -> None:
    """The bound holds for every pixel, and is exact for a camera that looks straight down."""
    normal = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    centre = np.array([0.0, 0.0, -2.0])
    aside, up = np.array([np.cos(tilt), 0.0, -np.sin(tilt)]), np.array([0.0, 1.0, 0.0])
    rays = [(np.array([x, y, -1.0])) for x in (-0.622, 0.622) for y in (-0.4664, 0.4664)]
    seen = [ray * (normal @ centre) / (normal @ ray) for ray in rays]
    reach = max(np.abs([(p - centre) @ aside for p in seen])), max(abs(p[1]) for p in seen)
    corners = np.array([centre + a * reach[0] * aside + b * reach[1] * up
                        for a in (-1, 1) for b in (-1, 1)] * 2)  # fmt: skip
    largest = footprint(normal, centre)

    def is_close(texels: float) -> bool:
        chosen = can_skip_mipmaps(
            np.array([texels]), normal[None], corners[None], Pose.identity(), CAMERA
        )
        return bool(chosen[0])

    promised = next(t for t in np.geomspace(0.1, 1e4, 4000) if not is_close(float(t)))
    assert promised * largest <= MAX_TEXELS * 1.003
    if tilt == 0.0:
        assert promised * largest == pytest.approx(MAX_TEXELS, rel=0.01)


def test_what_is_bent_or_behind_or_bare_keeps_its_copies() -> None:
    corners = np.array([[x, y, -2.0] for x in (-1, 1) for y in (-1, 1)] * 2, float)
    up, none = np.array([0.0, 0.0, 1.0]), np.zeros(3)
    chosen = can_skip_mipmaps(
        np.array([1.0, 1.0, 1.0, 0.0]),
        np.array([up, none, up, up]),
        np.array([corners, corners, -corners, corners]),
        Pose.identity(),
        CAMERA,
    )
    assert chosen.tolist() == [True, False, False, False]
