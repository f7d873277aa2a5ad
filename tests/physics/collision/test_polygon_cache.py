"""Polygons that were kept on disk are the polygons that were found."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from uwsim.model.collision import convex_faces, polygon_cache

SQUARE = np.array(
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
     [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]]
)  # fmt: skip
ROOF = np.concatenate([SQUARE, SQUARE[:1] * 0.5 + np.array([0.0, 0.0, 1.0])])


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "uwsim" / "polygons"


def assert_equal(found: list[np.ndarray], expected: list[np.ndarray]) -> None:
    assert [each.tobytes() for each in found] == [each.tobytes() for each in expected]


@pytest.mark.parametrize("triangles", [SQUARE, ROOF, np.zeros((0, 3, 3))])
def test_read_back_as_found(
    cache: Path, triangles: np.ndarray, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = polygon_cache.cached_faces(triangles)
    assert_equal(found, convex_faces.convex_faces(triangles))
    monkeypatch.setattr(convex_faces, "convex_faces", lambda _: pytest.fail("was found again"))
    assert_equal(polygon_cache.cached_faces(triangles), found)


def test_other_triangles_are_others(cache: Path) -> None:
    polygon_cache.cached_faces(SQUARE)
    assert_equal(polygon_cache.cached_faces(ROOF), convex_faces.convex_faces(ROOF))
    assert len(list(cache.glob("*.npz"))) == 2


def test_a_damaged_file_is_found_again(cache: Path) -> None:
    found = polygon_cache.cached_faces(ROOF)
    (file,) = cache.glob("*.npz")
    file.write_bytes(file.read_bytes()[:-7])
    assert_equal(polygon_cache.cached_faces(ROOF), found)
